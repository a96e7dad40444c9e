/* pacini.h: Pacini's runtime for C and languages that call C. Plays haptic clips together on several actuators, and
 * starts, moves and changes them live.
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
 *     pacini_render(engine, channels, 1, 256);   // in each audio callback
 *
 * THREADS. pacini_render() and pacini_render_interleaved() are for the audio thread, one at a time for each engine:
 * they never allocate, lock, wait or throw. An engine that plays on a game controller needs no audio thread. All other
 * functions may be called from any other thread at any time; calls for the same engine wait for each other. Commands
 * reach the audio thread through a lock-free queue.
 *
 * TIME. A command takes effect at a frame of the output; frame 0 is the first one that the engine renders. Past frames,
 * such as 0, mean now. For exact timing, send a command pacini_engine_info.latency frames ahead.
 *
 * HANDLES are structs of one number, a type for each kind, so that a clip in the place of an engine does not compile.
 * `id` 0 is no handle: pacini_clip clip = PACINI_NONE. Two handles are the same if their ids are; in C++ == compares
 * them. A stale or invalid handle causes an error (PACINI_STALE), never a crash.
 *
 * Up to 1.4 handles were uint64_t: sources that initialise, compare, print or store them as numbers must be changed,
 * and programs built against an older pacini.h keep working. Handles are arguments and fields of structs, never
 * results, and there a struct of one uint64_t is passed and laid out as the uint64_t itself by the calling conventions
 * of x86-64 (System V and Windows), 64-bit and 32-bit ARM, i386 and WebAssembly. Results are left out for i386, which
 * returns a uint64_t in registers and a struct in memory. Languages that cannot pass structs may therefore declare
 * handles as uint64_t.
 *
 * STRUCTS begin with their size, which their init function sets. They never grow within a major version: additions are
 * new functions and structs, so that programs built against an older pacini.h keep working.
 *
 * ERRORS. A function that returns pacini_result changes nothing on failure, neither the state of the library nor its
 * output arguments; pacini_last_error() then returns a message, for the calling thread. pacini_render() and
 * pacini_render_interleaved() set no message, which would need memory: pacini_result_text() says what is wrong. They
 * write silence as described there. A number out of its range, infinite
 * or NaN causes PACINI_INVALID. Fades and glides are 0 to 3600 s.
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

/* Version of this header. It works with a library of the same major version and at least this minor version. */
#define PACINI_API_MAJOR 1
#define PACINI_API_MINOR 5

    /* Version of the library: major * 1000 + minor. [any thread] */
    PACINI_API uint32_t pacini_api_version(void);

    typedef enum pacini_result
    {
        PACINI_OK = 0,
        PACINI_INVALID = 1,  /* an argument is out of its range */
        PACINI_STALE = 2,    /* a handle is not, or no longer, valid */
        PACINI_BAD_DATA = 3, /* the data is not a clip, scene, texture or profile */
        PACINI_NEWER = 4,    /* the data was written by a newer version */
        PACINI_TOO_MANY = 5, /* too many plays, commands, clips or engines; or too large */
        PACINI_IO = 6,       /* a file cannot be read */
        PACINI_NO_MEMORY = 7,
        PACINI_INTERNAL = 8, /* a bug in Pacini; please report it */
        PACINI_BUSY = 9      /* already plays on a controller; since 1.1 */
    } pacini_result;

    /* Short description of a result; never NULL. [any thread] */
    PACINI_API const char* pacini_result_text(pacini_result result);

    /* Message of the last failed call of this thread, such as "loop: is longer than the clip". Writes at most `size`
     * bytes including a terminating 0 and returns the size of the whole text. [any thread] */
    PACINI_API size_t pacini_last_error(char* text, size_t size);

    /* Handles; structs since 1.5. */
    typedef struct pacini_clip
    {
        uint64_t id;
    } pacini_clip;

    typedef struct pacini_engine
    {
        uint64_t id;
    } pacini_engine;

    typedef struct pacini_texture /* since 1.3 */
    {
        uint64_t id;
    } pacini_texture;

    typedef struct pacini_play
    {
        uint64_t id;
    } pacini_play;

    typedef struct pacini_controller
    {
        uint64_t id;
    } pacini_controller;

    /* clang-format off */
/* Initial value of a handle of any kind: none. */
#define PACINI_NONE {0}
    /* clang-format on */

    /* ---- Clips
     * ------------------------------------------------------------------------------------------------------- */

    typedef struct pacini_clip_info
    {
        uint32_t struct_size;
        uint32_t events; /* transients */
        double duration; /* s */
        uint64_t bytes;  /* size in memory */
        char name[64];   /* truncated if longer */
    } pacini_clip_info;

    /* Loads a clip of any format that Pacini reads (.pacb, .json, .haptic, .ahap, .hjif, ...) from memory; copies
     * the data. Wavelets of .hjif and .hmpg are PACINI_BAD_DATA: the encoder that translates them is not in this
     * library, convert them before. A clip can play any number of times, on any engine. [any thread but audio] */
    PACINI_API pacini_result pacini_clip_load(const void* bytes, size_t size, pacini_clip* clip);

    /* Loads a clip from a file; the path is UTF-8. [any thread but audio] */
    PACINI_API pacini_result pacini_clip_load_file(const char* path, pacini_clip* clip);

    /* Loads `count` clips from memory, each as pacini_clip_load() does: `bytes[i]` has `sizes[i]` bytes, and its handle
     * becomes `clips[i]`. All or none: when one cannot be loaded, no clip is, `clips` is left as it was, and the
     * message names the first such one, as in "bytes[3]: is not a clip that Pacini reads". Since 1.4. [any thread but
     * audio] */
    PACINI_API pacini_result pacini_clips_load(const void* const* bytes, const size_t* sizes, size_t count,
                                               pacini_clip* clips);

    /* Replaces the content of a clip. Active plays of the clip fade over to the new content. [any thread but
     * audio] */
    PACINI_API pacini_result pacini_clip_reload(pacini_clip clip, const void* bytes, size_t size);

    PACINI_API void pacini_clip_info_init(pacini_clip_info* info);
    PACINI_API pacini_result pacini_clip_get_info(pacini_clip clip, pacini_clip_info* info);

    /* A named point of time of a clip. Since 1.5. */
    typedef struct pacini_marker_info
    {
        uint32_t struct_size;
        uint32_t index; /* from 0, in order of time */
        double time;    /* s of the clip */
        char name[128]; /* UTF-8; truncated at a character if longer */
    } pacini_marker_info;

    /* Writes the number of a clip's markers: cues and chapters of the sound that it was made of, and what was set in an
     * editor. A loop of a WAV is two of them, "loop start" and "loop end", then "loop 2 start" and so on. A clip that
     * is reloaded has those of its new content. Since 1.5. [any thread but audio] */
    PACINI_API pacini_result pacini_clip_count_markers(pacini_clip clip, uint32_t* count);

    PACINI_API void pacini_marker_info_init(pacini_marker_info* info);

    /* Returns a marker. PACINI_INVALID: there are not so many. Since 1.5. [any thread but audio] */
    PACINI_API pacini_result pacini_clip_get_marker(pacini_clip clip, uint32_t index, pacini_marker_info* info);

    /* Returns the first marker with this name, UTF-8, from `index` on. Names that are longer than pacini_marker_info
     * holds are found by the whole name. PACINI_INVALID: there is none. Since 1.5. [any thread but audio] */
    PACINI_API pacini_result pacini_clip_find_marker(pacini_clip clip, const char* name, uint32_t index,
                                                     pacini_marker_info* info);

    /* Releases a clip. Active plays of the clip continue to their end. [any thread but audio] */
    PACINI_API pacini_result pacini_clip_release(pacini_clip clip);

    /* ---- Textures (since 1.3)
     * --------------------------------------------------------------------------------------------------------
     * A texture is what a hand feels of a surface, or a seat of an engine: made of a recording by `pacini texture
     * analyse`, it plays for as long as it is let, without repeating, and follows a speed and a force.
     *
     *     pacini_texture_load_file("wood.texture.json", &wood);
     *     pacini_texture_start(engine, wood, 0.0, 1.0, NULL, &play);
     *     pacini_play_set(play, PACINI_TEXTURE_SPEED, 0.4, 0.02, 0);   // whenever the hand moves
     *     pacini_play_stop(play, 0.01, 0); */

    /* Loads a texture from memory; copies the data. It can play any number of times, on any engine. [any thread but
     * audio] */
    PACINI_API pacini_result pacini_texture_load(const void* bytes, size_t size, pacini_texture* texture);

    /* Loads a texture from a file; the path is UTF-8. [any thread but audio] */
    PACINI_API pacini_result pacini_texture_load_file(const char* path, pacini_texture* texture);

    /* Releases a texture. Active plays of it continue. [any thread but audio] */
    PACINI_API pacini_result pacini_texture_release(pacini_texture texture);

    /* ---- Engines
     * ----------------------------------------------------------------------------------------------------- */

    enum
    {
        PACINI_MAX_ACTUATORS = 16,
        PACINI_GROUPS = 32
    };

    typedef enum pacini_pan_law
    {
        PACINI_PAN_POWER = 0, /* by level between the two nearest actuators, at constant power */
        PACINI_PAN_DELAY = 1, /* by time: actuators further away play later */
        PACINI_PAN_BOTH = 2
    } pacini_pan_law;

    typedef struct pacini_actuator
    {
        const char* profile; /* name of a shipped profile ("lra-175"), or the text of a profile in JSON;
                                NULL: the unchanged drive signal, within full drive */
        double gain;         /* linear, 0 to 1, after the protection */
        double delay;        /* s, 0 to 1, to align actuators */
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
        double longest_delay;   /* maximum delay of a play in s, 0 to 1 */
        double strength;        /* 0 (as flat as possible) to 1 (as strong as possible) */
        uint32_t max_plays;     /* simultaneous plays, 1 to 10000 */
        uint32_t max_commands;  /* waiting commands, 16 to 1000000 */
        double budget;          /* predicted time limit of a block, microseconds, 0 to 1e6; 0: none */
        uint32_t budget_frames; /* frames of this block, 1 or more */
        uint32_t budget_voices; /* plays at the same time; 0: no limit */
    } pacini_engine_config;

    /* Defaults: one actuator without a profile, 48 kHz, protection on, 256 plays. */
    PACINI_API void pacini_engine_config_init(pacini_engine_config* config);

    /* Creates an engine. [any thread but audio] */
    PACINI_API pacini_result pacini_engine_create(const pacini_engine_config* config, pacini_engine* engine);

    /* Creates an engine that plays a scene file from frame 0 on, with the same samples as `pacini render`, and plays
     * started beside it. The scene must have the same number of actuators. [any thread but audio] */
    PACINI_API pacini_result pacini_engine_create_scene(const pacini_engine_config* config, const char* scene_path,
                                                        pacini_engine* engine);

    /* Destroys the engine and its plays; waits for the end of the current block. [any thread but audio] */
    PACINI_API pacini_result pacini_engine_destroy(pacini_engine engine);

    /* Renders the next `frames` frames of each actuator into `channels[actuator]`; channels without an actuator are
     * silent. A stale engine writes silence and returns PACINI_STALE; an engine that plays on a controller writes
     * silence and returns PACINI_BUSY. [audio] */
    PACINI_API pacini_result pacini_render(pacini_engine engine, float* const* channels, uint32_t channel_count,
                                           uint32_t frames);

    /* Renders interleaved samples: samples[frame * channel_count + channel]. [audio] */
    PACINI_API pacini_result pacini_render_interleaved(pacini_engine engine, float* samples, uint32_t channel_count,
                                                       uint32_t frames);

    typedef struct pacini_engine_info
    {
        uint32_t struct_size;
        uint32_t latency;      /* frames by which commands must be early for exact timing */
        int64_t frame;         /* frames rendered so far */
        uint32_t playing;      /* active plays */
        uint32_t left_out;     /* plays skipped for lack of time or voices */
        double cost;           /* predicted time of a block of `budget_frames`, microseconds */
        double left_out_error; /* skipped energy so far, dB re all energy to play; -1000 for none */
        double gain_reduction; /* largest reduction by the protection in the last block, dB */
    } pacini_engine_info;

    PACINI_API void pacini_engine_info_init(pacini_engine_info* info);
    PACINI_API pacini_result pacini_engine_get_info(pacini_engine engine, pacini_engine_info* info);

    /* Sets the budget from the next block on, see pacini_engine_config. [any thread but audio] */
    PACINI_API pacini_result pacini_engine_set_budget(pacini_engine engine, double microseconds, uint32_t frames,
                                                      uint32_t voices);

    /* Sets the factor by which blocks take longer on this machine than predicted, 0.01 to 100; initially 1. It
     * multiplies `cost`, and the budget counts with it. 0 measures it: nine in ten of the last 256 blocks in which
     * something played took no longer than the factor says. `used`, which may be NULL, receives the factor. With one
     * that is stored the same commands leave out the same plays in each run and on each machine.
     * PACINI_INVALID: fewer than 64 such blocks have been rendered. [any thread but audio] Since 1.2. */
    PACINI_API pacini_result pacini_engine_calibrate(pacini_engine engine, double factor, double* used);

    /* Sets the gain of an actuator after its protection, 0 to 1. [any thread but audio] */
    PACINI_API pacini_result pacini_engine_set_actuator_gain(pacini_engine engine, uint32_t actuator, double gain,
                                                             double glide, int64_t frame);

    /* ---- Plays
     * ------------------------------------------------------------------------------------------------------- */

    typedef enum pacini_control
    {
        PACINI_GAIN = 0,          /* linear, 0 to 1000 */
        PACINI_INTENSITY = 1,     /* 0 to 1, multiplied with the gain */
        PACINI_PAN = 2,           /* 0 = first actuator, 1 = last */
        PACINI_DELAY = 3,         /* s, 0 to pacini_engine_config.longest_delay */
        PACINI_TRANSPOSITION = 4, /* semitones, -96 to 96; no glide */
        PACINI_SPEED = 5,         /* 0.01 to 100, pitch unchanged; no glide */
        PACINI_PRIORITY = 6, /* whole number, -1e9 to 1e9, usually 0 or more; lower values are kept longer; no glide */

        /* Levels of the roles of the clip, linear, 0 to 1000; initially 1. Since 1.2. */
        PACINI_TONES = 7,  /* the bands */
        PACINI_EVENTS = 8, /* the transients */
        PACINI_NOISE = 9,  /* the bands of noise; of a texture its noise, and PACINI_TONES its tones */

        /* Of a texture, 0 to 1; at 0 it is silent. Felt within 9 ms. Since 1.3. */
        PACINI_TEXTURE_SPEED = 10,
        PACINI_TEXTURE_FORCE = 11
    } pacini_control;

    typedef struct pacini_play_settings
    {
        uint32_t struct_size;
        uint32_t group;                                           /* 0 to 31 */
        int64_t frame;                                            /* start of the play */
        double gain, intensity, pan, delay, transposition, speed; /* see the controls */
        double from;                                              /* start position in the clip, s, 0 to 86400 */
        double loop;      /* length of the loop in s, 0.005 or more; 0: play once; -1: the whole clip */
        uint32_t passes;  /* passes of the loop; 0: until stopped */
        int32_t priority; /* see the control */
        double headroom;  /* semitones of later upward transposition without loss, 0 to 48 */
        double fade_in;   /* s */
        double variation; /* random variation of amplitudes in each pass, 0 to 1 */
        uint64_t seed;    /* seed of the variation */
    } pacini_play_settings;

    /* Defaults: play once, now, at the centre, unchanged. */
    PACINI_API void pacini_play_settings_init(pacini_play_settings* settings);

    /* Starts a play. NULL settings are the defaults. `play` may be NULL. [any thread but audio] */
    PACINI_API pacini_result pacini_play_start(pacini_engine engine, pacini_clip clip,
                                               const pacini_play_settings* settings, pacini_play* play);

    /* Starts a texture, which plays until it is stopped, a day at most. `speed` and `force` are 0 to 1; set them with
     * PACINI_TEXTURE_SPEED and PACINI_TEXTURE_FORCE while it plays. Of the settings, transposition, speed, from, loop,
     * passes, headroom and variation are without effect; different seeds make different noise. A play of a texture
     * cannot be moved by pacini_play_seek(). PACINI_INVALID: all actuators are motors. Takes some 15 ms the first time
     * on an engine. [any thread but audio] Since 1.3. */
    PACINI_API pacini_result pacini_texture_start(pacini_engine engine, pacini_texture texture, double speed,
                                                  double force, const pacini_play_settings* settings,
                                                  pacini_play* play);

    /* Sets a control, a pacini_control. The value moves linearly over `glide` s, from `frame` on. To set initial values
     * that pacini_play_settings does not have, call this right after pacini_play_start() for the same frame. [any
     * thread but audio] */
    PACINI_API pacini_result pacini_play_set(pacini_play play, int32_t control, double value, double glide,
                                             int64_t frame);

    /* Fades out over `fade` s and ends the play. [any thread but audio] */
    PACINI_API pacini_result pacini_play_stop(pacini_play play, double fade, int64_t frame);

    /* Fades out over `fade` s and pauses the play; resume continues it. [any thread but audio] */
    PACINI_API pacini_result pacini_play_pause(pacini_play play, double fade, int64_t frame);
    PACINI_API pacini_result pacini_play_resume(pacini_play play, double fade, int64_t frame);

    /* Continues at another position of the clip, 0 to 86400 s. [any thread but audio] */
    PACINI_API pacini_result pacini_play_seek(pacini_play play, double position, int64_t frame);

    typedef enum pacini_play_state
    {
        PACINI_ENDED = 0,
        PACINI_WAITING = 1, /* until its start frame */
        PACINI_PLAYING = 2,
        PACINI_PAUSED = 3,
        PACINI_LEFT_OUT = 4 /* skipped for lack of time or voices */
    } pacini_play_state;

    typedef struct pacini_play_info
    {
        uint32_t struct_size;
        int32_t state;   /* pacini_play_state */
        double position; /* position in the clip, s */
    } pacini_play_info;

    PACINI_API void pacini_play_info_init(pacini_play_info* info);

    /* Returns PACINI_OK with the state PACINI_ENDED for ended plays, as long as the engine exists. [any thread but
     * audio] */
    PACINI_API pacini_result pacini_play_get_info(pacini_play play, pacini_play_info* info);

    /* Sets a control of all plays of a group. The gain and the role levels of a group are separate faders, which also
     * apply to later plays. [any thread but audio] */
    PACINI_API pacini_result pacini_group_set(pacini_engine engine, uint32_t group, int32_t control, double value,
                                              double glide, int64_t frame);
    PACINI_API pacini_result pacini_group_stop(pacini_engine engine, uint32_t group, double fade, int64_t frame);

    /* ---- Game controllers (since 1.1)
     * -------------------------------------------------------------------------------------------------------
     * A controller attached to an engine drives it: a thread of Pacini renders the engine at the rate of the
     * controller's reports and sends them. The program needs no audio thread for it, and there is no clock drift. A
     * play is felt one report (2 to 31 ms) after its frame. To play on several controllers, create an engine for each;
     * clips are shared. Use pacini_render() for an engine without a controller.
     *
     * A single actuator plays on both sides of the controller; of several, the first two play left and right. Joy-Con
     * and Switch Pro play two tones per side, motors play levels, a Steam Controller plays the drive signal itself. */

    typedef enum pacini_haptics
    {
        PACINI_HD_RUMBLE = 0,
        PACINI_DUALSHOCK4 = 1,
        PACINI_DUALSENSE = 2,
        PACINI_XBOX = 3,
        PACINI_WAVEFORMS = 4, /* touchpads, mice, pens: clicks, on some also rumble */
        PACINI_STEAM_CONTROLLER = 5,
        PACINI_STEAM_DECK = 6
    } pacini_haptics;

    typedef enum pacini_connection
    {
        PACINI_CONNECTION_UNKNOWN = 0,
        PACINI_USB = 1,
        PACINI_BLUETOOTH = 2,
        PACINI_RECEIVER = 3 /* radio, with a receiver on USB */
    } pacini_connection;

    typedef struct pacini_controller_info
    {
        uint32_t struct_size;
        int32_t haptics;    /* pacini_haptics */
        int32_t connection; /* pacini_connection */
        char name[128];     /* UTF-8, as reported by the controller; truncated if longer */
        char path[256];     /* device path of the system */
    } pacini_controller_info;

    /* Finds connected controllers. Writes at most `capacity` handles, sorted by path, and the number of all controllers
     * into `count`. A controller keeps its handle between calls; handles of disconnected controllers are stale. Takes
     * up to 0.1 s. [any thread but audio] */
    PACINI_API pacini_result pacini_controllers_find(pacini_controller* controllers, uint32_t capacity,
                                                     uint32_t* count);

    PACINI_API void pacini_controller_info_init(pacini_controller_info* info);
    PACINI_API pacini_result pacini_controller_get_info(pacini_controller controller, pacini_controller_info* info);

    typedef struct pacini_attach_settings
    {
        uint32_t struct_size;
        int32_t stop_on_crash; /* 1: silence the controller when a signal ends the program. Installs signal handlers
                                  that call the previous ones; on Linux only. 0: install no handlers */
    } pacini_attach_settings;

    /* Defaults: no signal handlers. */
    PACINI_API void pacini_attach_settings_init(pacini_attach_settings* settings);

    /* Opens the controller and plays the engine on it. NULL settings are the defaults. Waits for the end of the current
     * block, and for the controller. PACINI_BUSY: the engine already has a controller, or the controller plays another
     * engine. PACINI_IO: the controller cannot be opened. PACINI_INVALID: the engine's sample rate does not suit a
     * Steam Controller, which needs a whole number of at least 8000 Hz. [any thread but audio] */
    PACINI_API pacini_result pacini_engine_attach(pacini_engine engine, pacini_controller controller,
                                                  const pacini_attach_settings* settings);

    /* Silences and closes the controller and returns the engine to pacini_render(). pacini_engine_destroy() and the end
     * of the program do the same. PACINI_INVALID: the engine has no controller. [any thread but audio] */
    PACINI_API pacini_result pacini_engine_detach(pacini_engine engine);

    typedef enum pacini_attachment_state
    {
        PACINI_DETACHED = 0,
        PACINI_ATTACHED = 1,
        PACINI_GONE = 2 /* unplugged or switched off: the engine continues without output until detached */
    } pacini_attachment_state;

    typedef struct pacini_attachment_info
    {
        uint32_t struct_size;
        int32_t state; /* pacini_attachment_state */
        pacini_controller controller;
        uint64_t sent;     /* number of reports so far */
        char failure[128]; /* message for the state PACINI_GONE */
    } pacini_attachment_info;

    PACINI_API void pacini_attachment_info_init(pacini_attachment_info* info);

    /* Returns the state of the attachment. [any thread but audio] */
    PACINI_API pacini_result pacini_engine_get_attachment(pacini_engine engine, pacini_attachment_info* info);

#ifdef __cplusplus
}

/* In C++: equality of handles, and an order for std::map. */
#define PACINI_COMPARE(handle)                                                                                         \
    inline bool operator==(handle a, handle b)                                                                         \
    {                                                                                                                  \
        return a.id == b.id;                                                                                           \
    }                                                                                                                  \
    inline bool operator!=(handle a, handle b)                                                                         \
    {                                                                                                                  \
        return a.id != b.id;                                                                                           \
    }                                                                                                                  \
    inline bool operator<(handle a, handle b)                                                                          \
    {                                                                                                                  \
        return a.id < b.id;                                                                                            \
    }
PACINI_COMPARE(pacini_clip)
PACINI_COMPARE(pacini_engine)
PACINI_COMPARE(pacini_texture)
PACINI_COMPARE(pacini_play)
PACINI_COMPARE(pacini_controller)
#undef PACINI_COMPARE
#endif
/* NOLINTEND(modernize-use-using) */

#endif
