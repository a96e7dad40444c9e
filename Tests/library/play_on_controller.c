/* A game that plays a clip on the first controller that is there.
 *
 *     play_on_controller CLIP HOW
 *
 * HOW: play to the end of the clip and detach; destroy or exit in its middle; unplug: wait until the controller is
 * gone; two: a second engine. Prints what happened, a line for each step; exits with 1 when something is not as
 * pacini.h says.
 */
#include <pacini.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static void check(int holds, const char* what)
{
    char why[256];
    if (holds)
        return;
    pacini_last_error(why, sizeof why);
    fprintf(stderr, "%s: %s\n", what, why);
    exit(1);
}

static void pause_for(double seconds)
{
    struct timespec time;
    time.tv_sec = (time_t)seconds;
    time.tv_nsec = (long)(1e9 * (seconds - (double)time.tv_sec));
    nanosleep(&time, NULL);
}

static int state_of(pacini_play play)
{
    pacini_play_info info;
    pacini_play_info_init(&info);
    check(pacini_play_get_info(play, &info) == PACINI_OK, "play");
    return info.state;
}

static pacini_attachment_info attachment(pacini_engine engine)
{
    pacini_attachment_info info;
    pacini_attachment_info_init(&info);
    check(pacini_engine_get_attachment(engine, &info) == PACINI_OK, "attachment");
    return info;
}

int main(int argc, char** argv)
{
    pacini_controller controllers[4];
    pacini_controller_info is;
    pacini_engine_config config;
    pacini_engine engine, second;
    pacini_clip clip;
    pacini_play play;
    uint32_t count = 0;
    float samples[2] = {1.0f, 1.0f};
    float* channels[2];
    int waited = 0;
    check(argc == 3, "arguments");
    channels[0] = samples;
    channels[1] = samples + 1;

    check(pacini_controllers_find(controllers, 4, &count) == PACINI_OK, "find");
    check(count == 1, "one controller");
    pacini_controller_info_init(&is);
    check(pacini_controller_get_info(controllers[0], &is) == PACINI_OK, "controller");
    printf("%s haptics %d connection %d\n", is.name, (int)is.haptics, (int)is.connection);

    pacini_engine_config_init(&config);
    config.actuator_count = 2;
    check(pacini_engine_create(&config, &engine) == PACINI_OK, "engine");
    check(pacini_clip_load_file(argv[1], &clip) == PACINI_OK, "clip");
    check(pacini_engine_attach(engine, controllers[0], NULL) == PACINI_OK, "attach");
    check(pacini_engine_attach(engine, controllers[0], NULL) == PACINI_BUSY, "attached twice");
    check(pacini_render(engine, channels, 2, 1) == PACINI_BUSY && samples[0] == 0.0f, "render what is pulled");
    check(pacini_render_interleaved(engine, samples, 2, 1) == PACINI_BUSY, "render what is pulled");
    check(pacini_play_start(engine, clip, NULL, &play) == PACINI_OK, "start");

    if (strcmp(argv[2], "two") == 0)
    {
        check(pacini_engine_create(&config, &second) == PACINI_OK, "second engine");
        check(pacini_engine_attach(second, controllers[0], NULL) == PACINI_BUSY, "two engines on one controller");
        check(pacini_render(second, channels, 2, 1) == PACINI_OK, "the second is still the caller's");
    }
    if (strcmp(argv[2], "destroy") == 0 || strcmp(argv[2], "exit") == 0)
    {
        pause_for(0.3);
        check(attachment(engine).state == PACINI_ATTACHED && attachment(engine).sent > 10, "it plays");
        if (argv[2][0] == 'd')
            check(pacini_engine_destroy(engine) == PACINI_OK, "destroy");
        puts("ended");
        return 0;
    }
    if (strcmp(argv[2], "unplug") == 0)
    {
        puts("unplug");
        fflush(stdout);
        for (; attachment(engine).state != PACINI_GONE && waited < 1000; ++waited)
            pause_for(0.01);
        check(attachment(engine).state == PACINI_GONE, "it is gone");
        printf("gone: %s\n", attachment(engine).failure);
    }
    for (waited = 0; state_of(play) != PACINI_ENDED && waited < 2000; ++waited)
        pause_for(0.01);
    check(state_of(play) == PACINI_ENDED, "the play has ended");
    check(pacini_engine_detach(engine) == PACINI_OK, "detach");
    check(pacini_engine_detach(engine) == PACINI_INVALID, "detach twice");
    check(attachment(engine).state == PACINI_DETACHED, "detached");
    check(pacini_render(engine, channels, 2, 1) == PACINI_OK, "the engine is the caller's again");
    if (strcmp(argv[2], "play") == 0)
        check(pacini_engine_attach(engine, controllers[0], NULL) == PACINI_OK, "attach anew");
    check(pacini_engine_destroy(engine) == PACINI_OK, "destroy");
    puts("ended");
    return 0;
}
