/* Sound and touch through one sound device of four channels: a WAV file on 1 and 2, a haptic clip on 3 and 4, where the
 * actuators of a DualSense are, or an amplifier.
 *
 *     sound_and_touch CLIP [SOUND.wav]      plays both once
 *
 * SPDX-License-Identifier: MIT
 */
#include <SDL.h>
#include <pacini.h>
#include <stdio.h>

enum
{
    RATE = 48000,
    CHANNELS = 4,
    BLOCK = 256
};

typedef struct game
{
    pacini_engine engine;
    const float* sound; /* stereo, frame by frame */
    Uint32 sound_frames, next;
    float touch[2 * BLOCK];
} game;

/* On SDL's audio thread: neither allocates nor waits. */
static void SDLCALL fill(void* user, Uint8* stream, int bytes)
{
    game* g = (game*)user;
    float* out = (float*)(void*)stream;
    Uint32 frames = (Uint32)bytes / (CHANNELS * sizeof(float));
    while (frames > 0)
    {
        const Uint32 n = frames < BLOCK ? frames : BLOCK;
        Uint32 i;
        pacini_render_interleaved(g->engine, g->touch, 2, n);
        for (i = 0; i < n; ++i, out += CHANNELS)
        {
            const int sounds = g->next < g->sound_frames;
            out[0] = sounds ? g->sound[2 * g->next] : 0.0f;
            out[1] = sounds ? g->sound[2 * g->next + 1] : 0.0f;
            out[2] = g->touch[2 * i];
            out[3] = g->touch[2 * i + 1];
            g->next += (Uint32)sounds;
        }
        frames -= n;
    }
}

/* A WAV file as stereo floats at RATE; NULL, with the reason in SDL_GetError(). SDL_free() it. */
static float* load_sound(const char* path, Uint32* frames)
{
    SDL_AudioSpec spec;
    SDL_AudioCVT convert;
    Uint8* bytes;
    Uint32 length;
    if (SDL_LoadWAV(path, &spec, &bytes, &length) == NULL)
        return NULL;
    if (SDL_BuildAudioCVT(&convert, spec.format, spec.channels, spec.freq, AUDIO_F32SYS, 2, RATE) < 0 ||
        (convert.buf = (Uint8*)SDL_malloc((size_t)length * (size_t)convert.len_mult)) == NULL)
    {
        SDL_FreeWAV(bytes);
        return NULL;
    }
    SDL_memcpy(convert.buf, bytes, length);
    SDL_FreeWAV(bytes);
    convert.len = (int)length;
    convert.len_cvt = (int)length;
    if (convert.needed && SDL_ConvertAudio(&convert) != 0)
    {
        SDL_free(convert.buf);
        return NULL;
    }
    *frames = (Uint32)convert.len_cvt / (2 * sizeof(float));
    return (float*)(void*)convert.buf;
}

static int failed(const char* what, const char* why)
{
    fprintf(stderr, "sound_and_touch: %s: %s\n", what, why);
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
    static game g;
    pacini_engine_config config;
    pacini_clip clip = PACINI_NONE;
    pacini_play play = PACINI_NONE;
    pacini_play_info info;
    int sounds = 0;
    SDL_AudioSpec wanted;
    SDL_AudioDeviceID device;
    float* sound = NULL;

    if (argc < 2 || argc > 3)
        return failed("usage", "sound_and_touch CLIP [SOUND.wav]");
    if (SDL_Init(SDL_INIT_AUDIO) != 0)
        return failed("SDL", SDL_GetError());
    if (argc == 3 && (sound = load_sound(argv[2], &g.sound_frames)) == NULL)
        return failed(argv[2], SDL_GetError());
    g.sound = sound;

    pacini_engine_config_init(&config);
    config.sample_rate = RATE;
    config.actuator_count = 2; /* left and right */
    if (pacini_engine_create(&config, &g.engine) || pacini_clip_load_file(argv[1], &clip) ||
        pacini_play_start(g.engine, clip, NULL, &play))
        return failed_in_pacini(argv[1]);

    SDL_zero(wanted);
    wanted.freq = RATE;
    wanted.format = AUDIO_F32SYS;
    wanted.channels = CHANNELS;
    wanted.samples = 512;
    wanted.callback = fill;
    wanted.userdata = &g;
    device = SDL_OpenAudioDevice(NULL, 0, &wanted, NULL, 0); /* NULL: SDL converts, so that it is as wanted */
    if (device == 0)
        return failed("sound device", SDL_GetError());
    SDL_PauseAudioDevice(device, 0);
    pacini_play_info_init(&info);
    do
    {
        SDL_Delay(10);
        SDL_LockAudioDevice(device);
        sounds = g.next < g.sound_frames;
        SDL_UnlockAudioDevice(device);
    } while (sounds || (pacini_play_get_info(play, &info) == PACINI_OK && info.state != PACINI_ENDED));
    SDL_CloseAudioDevice(device);
    pacini_engine_destroy(g.engine);
    pacini_clip_release(clip);
    SDL_free(sound);
    SDL_Quit();
    return 0;
}
