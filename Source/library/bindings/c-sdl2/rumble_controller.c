/* Plays a haptic clip on the first game controller.
 *
 *     rumble_controller CLIP
 *
 * SPDX-License-Identifier: MIT
 */
#include "rumble.h"

#include <stdio.h>

static int failed(const char* what, const char* why)
{
    fprintf(stderr, "rumble_controller: %s: %s\n", what, why);
    return 1;
}

static int failed_in_pacini(const char* what)
{
    char why[256];
    pacini_last_error(why, sizeof why);
    return failed(what, why);
}

int main(int argc, char** argv)
{
    SDL_GameController* controller = NULL;
    pacini_clip clip = PACINI_NONE;
    pacini_play play = PACINI_NONE;
    pacini_play_info info;
    rumble r;
    int i;

    if (argc != 2)
        return failed("usage", "rumble_controller CLIP");
    if (SDL_Init(SDL_INIT_GAMECONTROLLER) != 0)
        return failed("SDL", SDL_GetError());
    for (i = 0; i < SDL_NumJoysticks() && controller == NULL; ++i)
        controller = SDL_GameControllerOpen(i);
    if (controller == NULL)
        return failed("game controller", "none is connected");
    if (rumble_open(&r, controller) || pacini_clip_load_file(argv[1], &clip) ||
        pacini_play_start(r.engine, clip, NULL, &play))
        return failed_in_pacini(argv[1]);
    pacini_play_info_init(&info);
    do
    {
        SDL_Event event;
        while (SDL_PollEvent(&event))
            if (event.type == SDL_QUIT)
                pacini_play_stop(play, 0.0, 0);
        SDL_Delay(10);
        rumble_update(&r, 0.01);
    } while (pacini_play_get_info(play, &info) == PACINI_OK && info.state != PACINI_ENDED);
    rumble_close(&r);
    pacini_clip_release(clip);
    SDL_GameControllerClose(controller);
    SDL_Quit();
    return 0;
}
