/* Drive signals to the levels of two motors.
 *
 * SPDX-License-Identifier: MIT
 */
#include "rumble.h"

/* Motors follow levels, not samples, and take about 20 ms to turn: this rate holds all that vibrates. */
enum
{
    RATE = 4000,
    BLOCK = 64
};

/* Below this the heavy motor turns, above it the light one: between their usual speeds. First order, at RATE. */
static const double corner = 100.0;

pacini_result rumble_open(rumble* r, SDL_GameController* controller)
{
    pacini_engine_config config;
    SDL_zerop(r);
    r->controller = controller;
    pacini_engine_config_init(&config);
    config.sample_rate = RATE;
    return pacini_engine_create(&config, &r->engine);
}

static Uint16 level_of(double peak)
{
    return (Uint16)(65535.0 * SDL_min(1.0, peak));
}

void rumble_update(rumble* r, double seconds)
{
    const double step = 1.0 - SDL_exp(-2.0 * 3.14159265358979 * corner / RATE);
    double heavy = 0.0, light = 0.0;
    int frames;
    if (seconds > 0.0)
        r->time = SDL_min(0.25, r->time + seconds); /* behind a long pause it does not catch up */
    frames = (int)(r->time * RATE);
    r->time -= (double)frames / RATE;
    while (frames > 0)
    {
        float drive[BLOCK];
        const int n = SDL_min(frames, BLOCK);
        int i;
        pacini_render_interleaved(r->engine, drive, 1, (Uint32)n);
        for (i = 0; i < n; ++i)
        {
            r->low += step * ((double)drive[i] - r->low);
            heavy = SDL_max(heavy, SDL_fabs(r->low));
            light = SDL_max(light, SDL_fabs((double)drive[i] - r->low));
        }
        frames -= n;
    }
    /* It stops by itself if the game stands still. */
    SDL_GameControllerRumble(r->controller, level_of(heavy), level_of(light), 250);
}

void rumble_close(rumble* r)
{
    SDL_GameControllerRumble(r->controller, 0, 0, 0);
    pacini_engine_destroy(r->engine);
    r->engine.id = 0;
}
