/* The first vibration: loads a clip, plays it and writes what drives the actuator as raw 32-bit floats. */
#include <pacini.h>
#include <stdio.h>

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#endif

int main(int argc, char** argv)
{
    pacini_engine_config config;
    pacini_engine engine = PACINI_NONE;
    pacini_clip clip = PACINI_NONE;
    float drive[256];
    float* channels[1] = {drive};
    int block;

    if (argc != 2)
        return 2;
#if defined(_WIN32)
    _setmode(_fileno(stdout), _O_BINARY); /* samples, not lines */
#endif
    pacini_engine_config_init(&config);
    config.actuators[0].profile = "lra-175";
    if (pacini_engine_create(&config, &engine) || pacini_clip_load_file(argv[1], &clip) ||
        pacini_play_start(engine, clip, NULL, NULL))
    {
        char why[256];
        pacini_last_error(why, sizeof why);
        fprintf(stderr, "first_vibration: %s\n", why);
        return 1;
    }
    for (block = 0; block < 188; ++block) /* a second at 48 kHz */
    {
        pacini_render(engine, channels, 1, 256);
        fwrite(drive, sizeof(float), 256, stdout);
    }
    return 0;
}
