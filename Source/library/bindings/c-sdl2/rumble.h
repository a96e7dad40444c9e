/* Rumble of a game controller from haptic clips: an engine for each controller, whose drive signal is not heard but
 * becomes the levels of the two motors.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef PACINI_SDL_RUMBLE_H
#define PACINI_SDL_RUMBLE_H

#include <SDL.h>
#include <pacini.h>

typedef struct rumble
{
    SDL_GameController* controller;
    pacini_engine engine; /* start plays on it, as on any other; its id is 0 when it could not be made */
    double time, low;     /* s that are still to be rendered; state of the low-pass filter */
} rumble;

/* PACINI_OK, or why not: pacini_last_error(). */
pacini_result rumble_open(rumble* r, SDL_GameController* controller);

/* Once for each frame of the game, on its main thread: what plays goes on by so many seconds, and the motors follow. */
void rumble_update(rumble* r, double seconds);

/* Stops the motors. */
void rumble_close(rumble* r);

#endif
