/* A controller that does not exist: prints what rumble.c asks of its motors, a line for each call of the game.
 *
 *     virtual_pad CLIP        lines "update heavy light"; the last, after it is closed, is "closed heavy light"
 */
#include "rumble.h"

#include <math.h>
#include <stdio.h>

static Uint16 heavy, light;

static int SDLCALL on_rumble(void* user, Uint16 low, Uint16 high)
{
    (void)user;
    heavy = low;
    light = high;
    return 0;
}

int main(int argc, char** argv)
{
    SDL_VirtualJoystickDesc pad;
    SDL_GameController* controller;
    pacini_clip clip = PACINI_NONE;
    rumble r;
    int index, update;

    if (argc != 2)
        return 2;
    SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
    if (SDL_Init(SDL_INIT_GAMECONTROLLER) != 0)
        return 3;
    SDL_zero(pad);
    pad.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
    pad.type = SDL_JOYSTICK_TYPE_GAMECONTROLLER;
    pad.naxes = 6;
    pad.nbuttons = 15;
    pad.vendor_id = 0x045e;
    pad.product_id = 0x028e;
    pad.Rumble = on_rumble;
    index = SDL_JoystickAttachVirtualEx(&pad);
    controller = index < 0 ? NULL : SDL_GameControllerOpen(index);
    if (controller == NULL || !SDL_GameControllerHasRumble(controller))
        return 4;
    if (rumble_open(&r, controller) || pacini_clip_load_file(argv[1], &clip) ||
        pacini_play_start(r.engine, clip, NULL, NULL))
        return 5;
    for (update = 0; update < 100; ++update)
    {
        rumble_update(&r, 0.01);
        SDL_JoystickUpdate();
        printf("update %d %d\n", heavy, light);
    }
    pacini_play_start(r.engine, clip, NULL, NULL);
    rumble_update(&r, (double)NAN); /* a clock that went wrong: nothing passes */
    rumble_update(&r, -3600.0);
    rumble_update(&r, 0.1);
    printf("again %d %d\n", heavy, light);
    rumble_close(&r);
    SDL_JoystickUpdate();
    printf("closed %d %d\n", heavy, light);
    SDL_Quit();
    return 0;
}
