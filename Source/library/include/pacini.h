/* pacini.h: Pacini's runtime for C and everything that calls C. Haptic clips that play at once on several actuators,
 * started, moved and changed while they play.
 *
 * SPDX-License-Identifier: MIT
 *
 *     pacini_engine_config config;
 *     pacini_engine engine;
 *     pacini_clip clip;
 *     pacini_play play;
 *     pacini_engine_config_init(&config);
 *     pacini_engine_create(&config, &engine);
 *     pacini_clip_load_file("knock.pacb", &clip);
 *     pacini_play_start(engine, clip, NULL, &play);
 *     float drive[256];
 *     float* channels[1] = {drive};
 *     pacini_render(engine, channels, 1, 256);   // in the audio callback, again and again
 *
 * THREADS. pacini_render() and pacini_render_interleaved() are for the audio thread, one at a time for each engine:
 * they never allocate, lock, wait or throw. An engine that plays on a game controller needs no audio thread. Everything
 * else may be called from any other thread at any time; calls for one engine wait for each other there. Commands reach
 * the audio thread through a queue without locks.
 *
 * TIME. A command counts from a frame of the output on; frame 0 is the first that the engine renders. Frames that have
 * passed, such as 0, mean now. To be exact, a command must come pacini_engine_info.latency frames ahead.
 *
 * HANDLES are numbers, and 0 is none. One that is stale or was never given is an error (PACINI_STALE), never a crash.
 *
 * STRUCTS begin with their size, which their init function sets. They never grow within a major version: what is added
 * comes as functions and structs of its own, so that programs built against an older pacini.h go on.
 *
 * ERRORS: every function that returns pacini_result changes nothing when it fails, neither here nor what it was given
 * to write to; pacini_last_error() then says why in words, for the thread that called. pacini_render() and
 * pacini_render_interleaved() say no words, and write silence as it is told there. A number that is out of its range,
 * infinite or NaN is PACINI_INVALID. Fades and glides are 0 to 3600 s.
 */
#ifndef PACINI_H
#define PACINI_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(PACINI_SHARED)
#if defined(PACINI_BUILDING)
#define PACINI_API __declspec(dllexport)
#else
#define PACINI_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define PACINI_API __attribute__((visibility("default")))
#else
#define PACINI_API
#endif

/* NOLINTBEGIN(modernize-use-using): this is C. */
#ifdef __cplusplus
extern "C"
{
#endif

/* Version of this header. A library of the same major version and at least this minor one can be used with it. */
#define PACINI_API_MAJOR 1
#define PACINI_API_MINOR 2

    /* The library's: major * 1000 + minor. [any thread] */
    PACINI_API uint32_t pacini_api_version(void);

    typedef enum pacini_result
    {
        PACINI_OK = 0,
        PACINI_INVALID = 1,  /* an argument is out of its range */
        PACINI_STALE = 2,    /* a handle is not in use (any more) */
        PACINI_BAD_DATA = 3, /* bytes are no clip, scene or profile */
        PACINI_NEWER = 4,    /* they were written by a newer version */
        PACINI_TOO_MANY = 5, /* of plays, commands, clips or engines; or too large */
        PACINI_IO = 6,       /* a file cannot be read */
        PACINI_NO_MEMORY = 7,
        PACINI_INTERNAL = 8, /* a defect of Pacini: please report it */
        PACINI_BUSY = 9      /* plays on a controller; since 1.1 */
    } pacini_result;

    /* A few words; never NULL. [any thread] */
    PACINI_API const char* pacini_result_text(pacini_result result);

    /* What the last call of this thread that failed said, such as "loop: is longer than the clip". Writes at most
     * `size` bytes with a 0 at the end and returns how many the whole text needs. [any thread] */
    PACINI_API size_t pacini_last_error(char* text, size_t size);

    typedef uint64_t pacini_clip;
    typedef uint64_t pacini_engine;
    typedef uint64_t pacini_play;
    typedef uint64_t pacini_controller;

    /* ---- Clips
     * ------------------------------------------------------------------------------------------------------- */

    typedef struct pacini_clip_info
    {
        uint32_t struct_size;
        uint32_t events; /* transients */
        double duration; /* s */
        uint64_t bytes;  /* that it takes in memory */
        char name[64];   /* cut if it is longer */
    } pacini_clip_info;

    /* Loads a clip of any format that Pacini reads (.pacb, .json, .haptic, .ahap, .hjif, ...) from memory, which it
     * copies. A clip can play as often as one likes, on any engine. [any thread but audio] */
    PACINI_API pacini_result pacini_clip_load(const void* bytes, size_t size, pacini_clip* clip);

    /* The same from a file; the path is UTF-8. [any thread but audio] */
    PACINI_API pacini_result pacini_clip_load_file(const char* path, pacini_clip* clip);

    /* Puts other content in the place of a clip. What plays of it goes on with the new content, faded over. [any thread
     * but audio] */
    PACINI_API pacini_result pacini_clip_reload(pacini_clip clip, const void* bytes, size_t size);

    PACINI_API void pacini_clip_info_init(pacini_clip_info* info);
    PACINI_API pacini_result pacini_clip_get_info(pacini_clip clip, pacini_clip_info* info);

    /* What plays of it goes on to its end. [any thread but audio] */
    PACINI_API pacini_result pacini_clip_release(pacini_clip clip);

    /* ---- Engines
     * ----------------------------------------------------------------------------------------------------- */

    enum
    {
        PACINI_MAX_ACTUATORS = 16,
        PACINI_GROUPS = 32
    };

    typedef enum pacini_pan_law
    {
        PACINI_PAN_POWER = 0, /* by level between the two nearest actuators; the power stays */
        PACINI_PAN_DELAY = 1, /* by time: the farther an actuator the later */
        PACINI_PAN_BOTH = 2
    } pacini_pan_law;

    typedef struct pacini_actuator
    {
        const char* profile; /* name of one that comes with Pacini ("lra-175"), or the text of a profile in JSON;
                                NULL: the drive signal as it is, within full drive */
        double gain;         /* linear, 0 to 1, behind the protection */
        double delay;        /* s, 0 to 1, to line actuators up */
    } pacini_actuator;

    typedef struct pacini_engine_config
    {
        uint32_t struct_size;
        uint32_t actuator_count; /* 1 to 16, in a row from pan 0 to pan 1 */
        double sample_rate;      /* Hz, 2000 to 768000 */
        pacini_actuator actuators[PACINI_MAX_ACTUATORS];
        int32_t pan_law;        /* pacini_pan_law */
        int32_t protect;        /* 1: keep within full drive and the limits of the profile */
        double pan_delay;       /* s for the whole row, 0 to 0.1 */
        double longest_delay;   /* s that a play may be delayed by, 0 to 1 */
        double strength;        /* 0 (as flat as can be) to 1 (as strong as can be) */
        uint32_t max_plays;     /* at a time, 1 to 10000 */
        uint32_t max_commands;  /* that wait, 16 to 1000000 */
        double budget;          /* microseconds, 0 to 1e6, that a block may take, by prediction; 0: all */
        uint32_t budget_frames; /* frames of that block, 1 or more */
        uint32_t budget_voices; /* plays that sound at a time; 0: all */
    } pacini_engine_config;

    /* One plain actuator at 48 kHz, protected, 256 plays. */
    PACINI_API void pacini_engine_config_init(pacini_engine_config* config);

    /* [any thread but audio] */
    PACINI_API pacini_result pacini_engine_create(const pacini_engine_config* config, pacini_engine* engine);

    /* An engine that plays a scene file by itself from frame 0 on, sample for sample as `pacini render` renders it, and
     * whatever is started beside it. The scene must be made for as many actuators. [any thread but audio] */
    PACINI_API pacini_result pacini_engine_create_scene(const pacini_engine_config* config, const char* scene_path,
                                                        pacini_engine* engine);

    /* Ends the engine and all its plays; waits for a block that is being rendered. [any thread but audio] */
    PACINI_API pacini_result pacini_engine_destroy(pacini_engine engine);

    /* The next `frames` frames of each actuator, into `channels[actuator]`; channels that an engine does not have are
     * silent. A stale engine is silence and PACINI_STALE, one that plays on a controller silence and PACINI_BUSY.
     * [audio] */
    PACINI_API pacini_result pacini_render(pacini_engine engine, float* const* channels, uint32_t channel_count,
                                           uint32_t frames);

    /* The same, frame by frame: samples[frame * channel_count + channel]. [audio] */
    PACINI_API pacini_result pacini_render_interleaved(pacini_engine engine, float* samples, uint32_t channel_count,
                                                       uint32_t frames);

    typedef struct pacini_engine_info
    {
        uint32_t struct_size;
        uint32_t latency;      /* frames that a command must come ahead to be exact */
        int64_t frame;         /* frames rendered so far */
        uint32_t playing;      /* plays that sound */
        uint32_t left_out;     /* plays for which there is no time or voice */
        double cost;           /* microseconds that a block of `budget_frames` is predicted to take */
        double left_out_error; /* dB: energy left out so far, below all that was to play; -1000 for none */
        double gain_reduction; /* dB that the protection of any actuator took in the last block */
    } pacini_engine_info;

    PACINI_API void pacini_engine_info_init(pacini_engine_info* info);
    PACINI_API pacini_result pacini_engine_get_info(pacini_engine engine, pacini_engine_info* info);

    /* What may play at a time from the next block on: see pacini_engine_config. [any thread but audio] */
    PACINI_API pacini_result pacini_engine_set_budget(pacini_engine engine, double microseconds, uint32_t frames,
                                                      uint32_t voices);

    /* Gain of an actuator behind its protection, 0 to 1. [any thread but audio] */
    PACINI_API pacini_result pacini_engine_set_actuator_gain(pacini_engine engine, uint32_t actuator, double gain,
                                                             double glide, int64_t frame);

    /* ---- Plays
     * ------------------------------------------------------------------------------------------------------- */

    typedef enum pacini_control
    {
        PACINI_GAIN = 0,          /* linear, 0 to 1000 */
        PACINI_INTENSITY = 1,     /* 0 to 1, beside the gain */
        PACINI_PAN = 2,           /* 0 = first actuator, 1 = last */
        PACINI_DELAY = 3,         /* s, 0 to pacini_engine_config.longest_delay */
        PACINI_TRANSPOSITION = 4, /* semitones, -96 to 96; steps */
        PACINI_SPEED = 5,         /* 0.01 to 100, pitches stay; steps */
        PACINI_PRIORITY = 6,      /* whole numbers, -1e9 to 1e9, usually from 0 on: the least is kept longest; steps */

        /* Levels of the roles of the clip, linear, 0 to 1000; a play begins with 1. Since 1.2. */
        PACINI_TONES = 7,  /* the bands */
        PACINI_EVENTS = 8, /* the transients */
        PACINI_NOISE = 9   /* the bands of noise */
    } pacini_control;

    typedef struct pacini_play_settings
    {
        uint32_t struct_size;
        uint32_t group;                                           /* 0 to 31 */
        int64_t frame;                                            /* at which it begins */
        double gain, intensity, pan, delay, transposition, speed; /* as the controls */
        double from;                                              /* s of the clip at which it begins, 0 to 86400 */
        double loop;      /* s of the clip that are repeated, 0.005 or more; 0: play once; -1: the whole clip */
        uint32_t passes;  /* of a loop; 0: until it is stopped */
        int32_t priority; /* as the control */
        double headroom;  /* semitones by which it may be transposed up later without loss, 0 to 48 */
        double fade_in;   /* s */
        double variation; /* 0 to 1: amplitudes vary at random, from pass to pass */
        uint64_t seed;    /* of the variation */
    } pacini_play_settings;

    /* Once, now, in the middle, as it is. */
    PACINI_API void pacini_play_settings_init(pacini_play_settings* settings);

    /* NULL settings: as pacini_play_settings_init(). `play` may be NULL. [any thread but audio] */
    PACINI_API pacini_result pacini_play_start(pacini_engine engine, pacini_clip clip,
                                               const pacini_play_settings* settings, pacini_play* play);

    /* `control`: a pacini_control. Glides (s) in a straight line, from `frame` on. What a play is to begin with and
     * pacini_play_settings does not have, is set right after pacini_play_start() for the same frame. [any thread but
     * audio] */
    PACINI_API pacini_result pacini_play_set(pacini_play play, int32_t control, double value, double glide,
                                             int64_t frame);

    /* Fades (s) out and ends. [any thread but audio] */
    PACINI_API pacini_result pacini_play_stop(pacini_play play, double fade, int64_t frame);

    /* Fades (s) out and waits where it is; resume goes on. [any thread but audio] */
    PACINI_API pacini_result pacini_play_pause(pacini_play play, double fade, int64_t frame);
    PACINI_API pacini_result pacini_play_resume(pacini_play play, double fade, int64_t frame);

    /* Goes on at another second of the clip, 0 to 86400. [any thread but audio] */
    PACINI_API pacini_result pacini_play_seek(pacini_play play, double position, int64_t frame);

    typedef enum pacini_play_state
    {
        PACINI_ENDED = 0,
        PACINI_WAITING = 1, /* for its frame */
        PACINI_PLAYING = 2,
        PACINI_PAUSED = 3,
        PACINI_LEFT_OUT = 4 /* there is no time or voice for it */
    } pacini_play_state;

    typedef struct pacini_play_info
    {
        uint32_t struct_size;
        int32_t state;   /* pacini_play_state */
        double position; /* s of the clip */
    } pacini_play_info;

    PACINI_API void pacini_play_info_init(pacini_play_info* info);

    /* A play that has ended is PACINI_OK with the state PACINI_ENDED as long as its engine lives. [any thread but
     * audio] */
    PACINI_API pacini_result pacini_play_get_info(pacini_play play, pacini_play_info* info);

    /* Sets a control of all plays of a group. Its gain and the levels of its roles are faders of their own, which plays
     * to come are under too. [any thread but audio] */
    PACINI_API pacini_result pacini_group_set(pacini_engine engine, uint32_t group, int32_t control, double value,
                                              double glide, int64_t frame);
    PACINI_API pacini_result pacini_group_stop(pacini_engine engine, uint32_t group, double fade, int64_t frame);

    /* ---- Game controllers (since 1.1)
     * -------------------------------------------------------------------------------------------------------
     * A controller that is attached to an engine pulls it: a thread of Pacini's renders the engine at the pace of the
     * controller's reports and sends them. So the program needs no audio thread for it, there is one clock and no drift
     * between two, and a play is felt one report (2 to 31 ms) after its frame. To play on several controllers, make an
     * engine for each; clips are shared. An engine without a controller is rendered by pacini_render() as ever.
     *
     * One actuator plays on both sides of the controller, of several the first two play left and right. Joy-Con, Switch
     * Pro get two tones a side, motors their levels, a Steam Controller the drive signal itself. */

    typedef enum pacini_haptics
    {
        PACINI_HD_RUMBLE = 0,
        PACINI_DUALSHOCK4 = 1,
        PACINI_DUALSENSE = 2,
        PACINI_XBOX = 3,
        PACINI_WAVEFORMS = 4, /* touchpads, mice, pens: they click, and some rumble */
        PACINI_STEAM_CONTROLLER = 5,
        PACINI_STEAM_DECK = 6
    } pacini_haptics;

    typedef enum pacini_connection
    {
        PACINI_CONNECTION_UNKNOWN = 0,
        PACINI_USB = 1,
        PACINI_BLUETOOTH = 2,
        PACINI_RECEIVER = 3 /* radio, its receiver on USB */
    } pacini_connection;

    typedef struct pacini_controller_info
    {
        uint32_t struct_size;
        int32_t haptics;    /* pacini_haptics */
        int32_t connection; /* pacini_connection */
        char name[128];     /* UTF-8, as the controller gives it; cut if it is longer */
        char path[256];     /* what the system calls it */
    } pacini_controller_info;

    /* Looks what is connected. Writes at most `capacity` handles, sorted by path, and into `count` how many there are.
     * A controller keeps its handle from call to call; one that is not connected any more is stale. Takes up to 0.1 s.
     * [any thread but audio] */
    PACINI_API pacini_result pacini_controllers_find(pacini_controller* controllers, uint32_t capacity,
                                                     uint32_t* count);

    PACINI_API void pacini_controller_info_init(pacini_controller_info* info);
    PACINI_API pacini_result pacini_controller_get_info(pacini_controller controller, pacini_controller_info* info);

    typedef struct pacini_attach_settings
    {
        uint32_t struct_size;
        int32_t stop_on_crash; /* 1: a signal that ends the program first silences the controller. Installs handlers of
                                  signals, which pass on to those that were there; on Linux only. 0: none are touched */
    } pacini_attach_settings;

    /* No handlers of signals. */
    PACINI_API void pacini_attach_settings_init(pacini_attach_settings* settings);

    /* Opens the controller and plays the engine on it from now on. NULL settings: as pacini_attach_settings_init().
     * Waits for a block that is being rendered, and for the controller. PACINI_BUSY: the engine has one, or the
     * controller plays another engine. PACINI_IO: it cannot be opened. PACINI_INVALID: the engine's sample rate is not
     * one for a Steam Controller, 8000 Hz or more in whole numbers. [any thread but audio] */
    PACINI_API pacini_result pacini_engine_attach(pacini_engine engine, pacini_controller controller,
                                                  const pacini_attach_settings* settings);

    /* Silences the controller, closes it and gives the engine back to pacini_render(). pacini_engine_destroy() does so
     * by itself, and so does the end of the program. PACINI_INVALID: it has none. [any thread but audio] */
    PACINI_API pacini_result pacini_engine_detach(pacini_engine engine);

    typedef enum pacini_attachment_state
    {
        PACINI_DETACHED = 0,
        PACINI_ATTACHED = 1,
        PACINI_GONE = 2 /* unplugged or switched off: the engine goes on unfelt until it is detached */
    } pacini_attachment_state;

    typedef struct pacini_attachment_info
    {
        uint32_t struct_size;
        int32_t state; /* pacini_attachment_state */
        pacini_controller controller;
        uint64_t sent;     /* reports so far */
        char failure[128]; /* why it is gone, in words */
    } pacini_attachment_info;

    PACINI_API void pacini_attachment_info_init(pacini_attachment_info* info);

    /* [any thread but audio] */
    PACINI_API pacini_result pacini_engine_get_attachment(pacini_engine engine, pacini_attachment_info* info);

#ifdef __cplusplus
}
#endif
/* NOLINTEND(modernize-use-using) */

#endif
