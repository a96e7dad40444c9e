/* pacini.h for Godot 3: functions for GDNative.call_native("standard_varcall", ...), which addons/pacini/pacini.gd
 * wraps. Those that fail give null, and pacini_godot_last_error() says why.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gdnative.h"

#include <pacini.h>

#if defined(_WIN32)
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

static const godot_api* api;

/* A function of the table, as what it is. */
#define CALL(place, type) ((type)api->functions[place])

typedef void (*by_pointer)(void*);
typedef void (*pointer_from)(void*, const void*);
typedef godot_pointer (*pointer_of)(const void*);
typedef void (*resize)(void*, int);
typedef void* (*address_of)(const void*);

EXPORT void godot_gdnative_init(godot_init_options* options)
{
    api = options->api;
}

EXPORT void godot_gdnative_terminate(void* options)
{
    (void)options;
}

/* ---- Values to Godot and from it */

static godot_variant of_nothing(void)
{
    godot_variant made;
    CALL(GODOT_VARIANT_NEW_NIL, by_pointer)(&made);
    return made;
}

static godot_variant of_int(int64_t value)
{
    godot_variant made;
    CALL(GODOT_VARIANT_NEW_INT, void (*)(godot_variant*, int64_t))(&made, value);
    return made;
}

static godot_variant of_real(double value)
{
    godot_variant made;
    CALL(GODOT_VARIANT_NEW_REAL, void (*)(godot_variant*, double))(&made, value);
    return made;
}

static godot_variant of_text(const char* utf8)
{
    godot_variant made;
    godot_pointer text = CALL(GODOT_STRING_CHARS_TO_UTF8, pointer_of)(utf8);
    CALL(GODOT_VARIANT_NEW_STRING, pointer_from)(&made, &text);
    CALL(GODOT_STRING_DESTROY, by_pointer)(&text);
    return made;
}

/* Without a value of its own: 1. */
static godot_variant of_result(pacini_result result)
{
    return result == PACINI_OK ? of_int(1) : of_nothing();
}

static godot_variant of_handle(pacini_result result, uint64_t handle)
{
    return result == PACINI_OK ? of_int((int64_t)handle) : of_nothing();
}

static godot_variant argument(const void* arguments, int at)
{
    return CALL(GODOT_ARRAY_GET, godot_variant(*)(const void*, int))(arguments, at);
}

static int count(const void* arguments)
{
    return CALL(GODOT_ARRAY_SIZE, int (*)(const void*))(arguments);
}

static void destroy(godot_variant* value)
{
    CALL(GODOT_VARIANT_DESTROY, by_pointer)(value);
}

static int64_t to_int(const void* arguments, int at)
{
    godot_variant given = argument(arguments, at);
    const int64_t value = CALL(GODOT_VARIANT_AS_INT, int64_t(*)(const void*))(&given);
    destroy(&given);
    return value;
}

/* Handles are whole numbers to Godot. */
#define TO_HANDLE(type)                                                                                                \
    static pacini_##type to_##type(const void* arguments, int at)                                                      \
    {                                                                                                                  \
        pacini_##type handle;                                                                                          \
        handle.id = (uint64_t)to_int(arguments, at);                                                                   \
        return handle;                                                                                                 \
    }
TO_HANDLE(clip)
TO_HANDLE(texture)
TO_HANDLE(engine)
TO_HANDLE(play)
TO_HANDLE(controller)

static double to_real(const void* arguments, int at)
{
    godot_variant given = argument(arguments, at);
    const double value = CALL(GODOT_VARIANT_AS_REAL, double (*)(const void*))(&given);
    destroy(&given);
    return value;
}

static int is_given(const void* arguments, int at)
{
    godot_variant given = argument(arguments, at);
    const int type = CALL(GODOT_VARIANT_GET_TYPE, int (*)(const void*))(&given);
    destroy(&given);
    return type != GODOT_NIL;
}

/* A real number where one is given; what was there stays where null is. */
#define GIVEN(arguments, at, to)                                                                                       \
    do                                                                                                                 \
    {                                                                                                                  \
        if (is_given(arguments, at))                                                                                   \
            (to) = to_real(arguments, at);                                                                             \
    } while (0)

/* The same for whole numbers. What the type cannot hold becomes its largest, which the library refuses. */
#define GIVEN_WHOLE(arguments, at, to, type, least, most)                                                              \
    do                                                                                                                 \
    {                                                                                                                  \
        if (is_given(arguments, at))                                                                                   \
        {                                                                                                              \
            const int64_t whole = to_int(arguments, at);                                                               \
            (to) = whole < (least) || whole > (most) ? (type)(most) : (type)whole;                                     \
        }                                                                                                              \
    } while (0)
#define GIVEN_COUNT(arguments, at, to) GIVEN_WHOLE(arguments, at, to, uint32_t, 0, (int64_t)UINT32_MAX)
#define GIVEN_INT(arguments, at, to) GIVEN_WHOLE(arguments, at, to, int32_t, INT32_MIN, INT32_MAX)
#define GIVEN_LONG(arguments, at, to, type) GIVEN_WHOLE(arguments, at, to, type, INT64_MIN, INT64_MAX)

/* UTF-8 of a text; let go of it with forget(). */
typedef struct utf8_text
{
    godot_pointer bytes;
    const char* text;
} utf8_text;

static utf8_text to_text(const void* arguments, int at)
{
    utf8_text made;
    godot_variant given = argument(arguments, at);
    godot_pointer text = CALL(GODOT_VARIANT_AS_STRING, pointer_of)(&given);
    made.bytes = CALL(GODOT_STRING_UTF8, pointer_of)(&text);
    made.text = (const char*)CALL(GODOT_CHAR_STRING_GET_DATA, address_of)(&made.bytes);
    CALL(GODOT_STRING_DESTROY, by_pointer)(&text);
    destroy(&given);
    return made;
}

static void forget(utf8_text* text)
{
    CALL(GODOT_CHAR_STRING_DESTROY, by_pointer)(&text->bytes);
}

/* ---- Clips */

EXPORT godot_variant pacini_godot_last_error(const void* arguments)
{
    char text[512];
    (void)arguments;
    pacini_last_error(text, sizeof text);
    return of_text(text);
}

EXPORT godot_variant pacini_godot_version(const void* arguments)
{
    (void)arguments;
    return of_int(pacini_api_version());
}

/* bytes; or clip, bytes: reloads it */
EXPORT godot_variant pacini_godot_clip_load(const void* arguments)
{
    const int last = count(arguments) - 1;
    pacini_clip clip = PACINI_NONE;
    pacini_result result;
    godot_variant given = argument(arguments, last);
    godot_pointer array = CALL(GODOT_VARIANT_AS_POOL_BYTE_ARRAY, pointer_of)(&given);
    const int size = CALL(GODOT_POOL_BYTE_ARRAY_SIZE, int (*)(const void*))(&array);
    void* access = CALL(GODOT_POOL_BYTE_ARRAY_READ, address_of)(&array);
    const void* bytes = CALL(GODOT_POOL_BYTE_ARRAY_READ_PTR, address_of)(access);
    if (last == 1)
        clip = to_clip(arguments, 0);
    result = last == 1 ? pacini_clip_reload(clip, bytes, (size_t)size) : pacini_clip_load(bytes, (size_t)size, &clip);
    CALL(GODOT_POOL_BYTE_ARRAY_READ_DESTROY, by_pointer)(access);
    CALL(GODOT_POOL_BYTE_ARRAY_DESTROY, by_pointer)(&array);
    destroy(&given);
    return of_handle(result, clip.id);
}

/* clip, which of: name, duration, events, bytes */
EXPORT godot_variant pacini_godot_clip_info(const void* arguments)
{
    pacini_clip_info info;
    pacini_clip_info_init(&info);
    if (pacini_clip_get_info(to_clip(arguments, 0), &info) != PACINI_OK)
        return of_nothing();
    switch (to_int(arguments, 1))
    {
    case 0:
        return of_text(info.name);
    case 1:
        return of_real(info.duration);
    case 2:
        return of_int(info.events);
    default:
        return of_int((int64_t)info.bytes);
    }
}

/* clip: how many markers it has */
EXPORT godot_variant pacini_godot_clip_count_markers(const void* arguments)
{
    uint32_t found = 0;
    return pacini_clip_count_markers(to_clip(arguments, 0), &found) == PACINI_OK ? of_int(found) : of_nothing();
}

/* clip, index, which of: name, time */
EXPORT godot_variant pacini_godot_clip_marker(const void* arguments)
{
    pacini_marker_info info;
    pacini_marker_info_init(&info);
    if (pacini_clip_get_marker(to_clip(arguments, 0), (uint32_t)to_int(arguments, 1), &info) != PACINI_OK)
        return of_nothing();
    return to_int(arguments, 2) == 0 ? of_text(info.name) : of_real(info.time);
}

/* clip, name, index from which on: the index */
EXPORT godot_variant pacini_godot_clip_find_marker(const void* arguments)
{
    pacini_marker_info info;
    pacini_result result;
    utf8_text name = to_text(arguments, 1);
    pacini_marker_info_init(&info);
    result = pacini_clip_find_marker(to_clip(arguments, 0), name.text, (uint32_t)to_int(arguments, 2), &info);
    forget(&name);
    return result == PACINI_OK ? of_int(info.index) : of_nothing();
}

EXPORT godot_variant pacini_godot_clip_release(const void* arguments)
{
    return of_result(pacini_clip_release(to_clip(arguments, 0)));
}

/* ---- Textures */

/* bytes */
EXPORT godot_variant pacini_godot_texture_load(const void* arguments)
{
    pacini_texture texture = PACINI_NONE;
    pacini_result result;
    godot_variant given = argument(arguments, 0);
    godot_pointer array = CALL(GODOT_VARIANT_AS_POOL_BYTE_ARRAY, pointer_of)(&given);
    const int size = CALL(GODOT_POOL_BYTE_ARRAY_SIZE, int (*)(const void*))(&array);
    void* access = CALL(GODOT_POOL_BYTE_ARRAY_READ, address_of)(&array);
    result = pacini_texture_load(CALL(GODOT_POOL_BYTE_ARRAY_READ_PTR, address_of)(access), (size_t)size, &texture);
    CALL(GODOT_POOL_BYTE_ARRAY_READ_DESTROY, by_pointer)(access);
    CALL(GODOT_POOL_BYTE_ARRAY_DESTROY, by_pointer)(&array);
    destroy(&given);
    return of_handle(result, texture.id);
}

EXPORT godot_variant pacini_godot_texture_release(const void* arguments)
{
    return of_result(pacini_texture_release(to_texture(arguments, 0)));
}

/* ---- Engines */

/* scene, sample rate, pan law, protect, pan delay, longest delay, strength, plays, commands, budget, frames, voices,
 * each or null; then profile, gain, delay of each actuator */
EXPORT godot_variant pacini_godot_engine_create(const void* arguments)
{
    enum
    {
        FIRST = 12
    };
    pacini_engine_config config;
    pacini_engine engine = PACINI_NONE;
    pacini_result result;
    utf8_text texts[PACINI_MAX_ACTUATORS];
    int a, actuators = (count(arguments) - FIRST) / 3;
    pacini_engine_config_init(&config);
    GIVEN(arguments, 1, config.sample_rate);
    GIVEN_INT(arguments, 2, config.pan_law);
    GIVEN_INT(arguments, 3, config.protect);
    GIVEN(arguments, 4, config.pan_delay);
    GIVEN(arguments, 5, config.longest_delay);
    GIVEN(arguments, 6, config.strength);
    GIVEN_COUNT(arguments, 7, config.max_plays);
    GIVEN_COUNT(arguments, 8, config.max_commands);
    GIVEN(arguments, 9, config.budget);
    GIVEN_COUNT(arguments, 10, config.budget_frames);
    GIVEN_COUNT(arguments, 11, config.budget_voices);
    config.actuator_count = (uint32_t)actuators;
    if (actuators > PACINI_MAX_ACTUATORS)
        actuators = 0; /* the library says that these are too many */
    for (a = 0; a < actuators; ++a)
    {
        texts[a] = to_text(arguments, FIRST + 3 * a);
        config.actuators[a].profile = texts[a].text; /* empty: none */
        GIVEN(arguments, FIRST + 3 * a + 1, config.actuators[a].gain);
        GIVEN(arguments, FIRST + 3 * a + 2, config.actuators[a].delay);
    }
    if (is_given(arguments, 0))
    {
        utf8_text scene = to_text(arguments, 0);
        result = pacini_engine_create_scene(&config, scene.text, &engine);
        forget(&scene);
    }
    else
        result = pacini_engine_create(&config, &engine);
    for (a = 0; a < actuators; ++a)
        forget(&texts[a]);
    return of_handle(result, engine.id);
}

EXPORT godot_variant pacini_godot_engine_destroy(const void* arguments)
{
    return of_result(pacini_engine_destroy(to_engine(arguments, 0)));
}

/* engine, frames, channels: samples frame by frame */
EXPORT godot_variant pacini_godot_render(const void* arguments)
{
    const int64_t frames = to_int(arguments, 1), channels = to_int(arguments, 2);
    godot_pointer samples;
    void* access;
    pacini_result result;
    godot_variant made;
    if (frames < 0 || channels < 1 || channels > PACINI_MAX_ACTUATORS || frames > 0x1000000)
        return of_nothing();
    CALL(GODOT_POOL_REAL_ARRAY_NEW, by_pointer)(&samples);
    CALL(GODOT_POOL_REAL_ARRAY_RESIZE, resize)(&samples, (int)(frames * channels));
    access = CALL(GODOT_POOL_REAL_ARRAY_WRITE, address_of)(&samples);
    result = pacini_render_interleaved(to_engine(arguments, 0),
                                       (float*)CALL(GODOT_POOL_REAL_ARRAY_WRITE_PTR, address_of)(access),
                                       (uint32_t)channels, (uint32_t)frames);
    CALL(GODOT_POOL_REAL_ARRAY_WRITE_DESTROY, by_pointer)(access);
    if (result == PACINI_OK)
        CALL(GODOT_VARIANT_NEW_POOL_REAL_ARRAY, pointer_from)(&made, &samples);
    else
        made = of_nothing();
    CALL(GODOT_POOL_REAL_ARRAY_DESTROY, by_pointer)(&samples);
    return made;
}

/* engine, frames: the first two actuators, as AudioStreamGeneratorPlayback.push_buffer() takes them */
EXPORT godot_variant pacini_godot_render_stereo(const void* arguments)
{
    const int64_t frames = to_int(arguments, 1);
    godot_pointer samples;
    void* access;
    pacini_result result;
    godot_variant made;
    if (frames < 0 || frames > 0x1000000)
        return of_nothing();
    CALL(GODOT_POOL_VECTOR2_ARRAY_NEW, by_pointer)(&samples);
    CALL(GODOT_POOL_VECTOR2_ARRAY_RESIZE, resize)(&samples, (int)frames);
    access = CALL(GODOT_POOL_VECTOR2_ARRAY_WRITE, address_of)(&samples);
    /* A Vector2 is two floats. */
    result = pacini_render_interleaved(to_engine(arguments, 0),
                                       (float*)CALL(GODOT_POOL_VECTOR2_ARRAY_WRITE_PTR, address_of)(access), 2,
                                       (uint32_t)frames);
    CALL(GODOT_POOL_VECTOR2_ARRAY_WRITE_DESTROY, by_pointer)(access);
    if (result == PACINI_OK)
        CALL(GODOT_VARIANT_NEW_POOL_VECTOR2_ARRAY, pointer_from)(&made, &samples);
    else
        made = of_nothing();
    CALL(GODOT_POOL_VECTOR2_ARRAY_DESTROY, by_pointer)(&samples);
    return made;
}

/* engine, which of: frame, latency, playing, left out, cost, error of what is left out, gain reduction */
EXPORT godot_variant pacini_godot_engine_info(const void* arguments)
{
    pacini_engine_info info;
    pacini_engine_info_init(&info);
    if (pacini_engine_get_info(to_engine(arguments, 0), &info) != PACINI_OK)
        return of_nothing();
    switch (to_int(arguments, 1))
    {
    case 0:
        return of_int(info.frame);
    case 1:
        return of_int(info.latency);
    case 2:
        return of_int(info.playing);
    case 3:
        return of_int(info.left_out);
    case 4:
        return of_real(info.cost);
    case 5:
        return of_real(info.left_out_error);
    default:
        return of_real(info.gain_reduction);
    }
}

EXPORT godot_variant pacini_godot_engine_set_budget(const void* arguments)
{
    return of_result(pacini_engine_set_budget(to_engine(arguments, 0), to_real(arguments, 1),
                                              (uint32_t)to_int(arguments, 2), (uint32_t)to_int(arguments, 3)));
}

EXPORT godot_variant pacini_godot_engine_calibrate(const void* arguments)
{
    double used = 0.0;
    const godot_variant done =
        of_result(pacini_engine_calibrate(to_engine(arguments, 0), to_real(arguments, 1), &used));
    return used > 0.0 ? of_real(used) : done;
}

EXPORT godot_variant pacini_godot_engine_set_actuator_gain(const void* arguments)
{
    return of_result(pacini_engine_set_actuator_gain(to_engine(arguments, 0), (uint32_t)to_int(arguments, 1),
                                                     to_real(arguments, 2), to_real(arguments, 3),
                                                     to_int(arguments, 4)));
}

EXPORT godot_variant pacini_godot_group_set(const void* arguments)
{
    return of_result(pacini_group_set(to_engine(arguments, 0), (uint32_t)to_int(arguments, 1),
                                      (int32_t)to_int(arguments, 2), to_real(arguments, 3), to_real(arguments, 4),
                                      to_int(arguments, 5)));
}

EXPORT godot_variant pacini_godot_group_stop(const void* arguments)
{
    return of_result(pacini_group_stop(to_engine(arguments, 0), (uint32_t)to_int(arguments, 1), to_real(arguments, 2),
                                       to_int(arguments, 3)));
}

/* ---- Plays */

/* Group, frame, gain, intensity, pan, delay, transposition, speed, from, loop, passes, priority, headroom, fade in,
 * variation, seed from argument `at` on, each or null. */
static pacini_play_settings settings_of(const void* arguments, int at)
{
    pacini_play_settings settings;
    pacini_play_settings_init(&settings);
    GIVEN_COUNT(arguments, at, settings.group);
    GIVEN_LONG(arguments, at + 1, settings.frame, int64_t);
    GIVEN(arguments, at + 2, settings.gain);
    GIVEN(arguments, at + 3, settings.intensity);
    GIVEN(arguments, at + 4, settings.pan);
    GIVEN(arguments, at + 5, settings.delay);
    GIVEN(arguments, at + 6, settings.transposition);
    GIVEN(arguments, at + 7, settings.speed);
    GIVEN(arguments, at + 8, settings.from);
    GIVEN(arguments, at + 9, settings.loop);
    GIVEN_COUNT(arguments, at + 10, settings.passes);
    GIVEN_INT(arguments, at + 11, settings.priority);
    GIVEN(arguments, at + 12, settings.headroom);
    GIVEN(arguments, at + 13, settings.fade_in);
    GIVEN(arguments, at + 14, settings.variation);
    GIVEN_LONG(arguments, at + 15, settings.seed, uint64_t);
    return settings;
}

/* engine, clip; then settings */
EXPORT godot_variant pacini_godot_play_start(const void* arguments)
{
    const pacini_play_settings settings = settings_of(arguments, 2);
    pacini_play play = PACINI_NONE;
    const pacini_result result = pacini_play_start(to_engine(arguments, 0), to_clip(arguments, 1), &settings, &play);
    return of_handle(result, play.id);
}

/* engine, texture, speed, force; then settings */
EXPORT godot_variant pacini_godot_texture_start(const void* arguments)
{
    const pacini_play_settings settings = settings_of(arguments, 4);
    pacini_play play = PACINI_NONE;
    const pacini_result result = pacini_texture_start(to_engine(arguments, 0), to_texture(arguments, 1),
                                                      to_real(arguments, 2), to_real(arguments, 3), &settings, &play);
    return of_handle(result, play.id);
}

EXPORT godot_variant pacini_godot_play_set(const void* arguments)
{
    return of_result(pacini_play_set(to_play(arguments, 0), (int32_t)to_int(arguments, 1), to_real(arguments, 2),
                                     to_real(arguments, 3), to_int(arguments, 4)));
}

EXPORT godot_variant pacini_godot_play_stop(const void* arguments)
{
    return of_result(pacini_play_stop(to_play(arguments, 0), to_real(arguments, 1), to_int(arguments, 2)));
}

EXPORT godot_variant pacini_godot_play_pause(const void* arguments)
{
    return of_result(pacini_play_pause(to_play(arguments, 0), to_real(arguments, 1), to_int(arguments, 2)));
}

EXPORT godot_variant pacini_godot_play_resume(const void* arguments)
{
    return of_result(pacini_play_resume(to_play(arguments, 0), to_real(arguments, 1), to_int(arguments, 2)));
}

EXPORT godot_variant pacini_godot_play_seek(const void* arguments)
{
    return of_result(pacini_play_seek(to_play(arguments, 0), to_real(arguments, 1), to_int(arguments, 2)));
}

/* play, which of: state, position */
EXPORT godot_variant pacini_godot_play_info(const void* arguments)
{
    pacini_play_info info;
    pacini_play_info_init(&info);
    if (pacini_play_get_info(to_play(arguments, 0), &info) != PACINI_OK)
        return of_nothing();
    return to_int(arguments, 1) == 0 ? of_int(info.state) : of_real(info.position);
}

/* ---- Game controllers */

/* which, from 0: its handle, 0 behind the last */
EXPORT godot_variant pacini_godot_controller(const void* arguments)
{
    pacini_controller controllers[32];
    uint32_t found = 0;
    const int64_t which = to_int(arguments, 0);
    if (pacini_controllers_find(controllers, 32, &found) != PACINI_OK)
        return of_nothing();
    return of_int(which >= 0 && which < 32 && which < (int64_t)found ? (int64_t)controllers[which].id : 0);
}

/* controller, which of: name, path, haptics, connection */
EXPORT godot_variant pacini_godot_controller_info(const void* arguments)
{
    pacini_controller_info info;
    pacini_controller_info_init(&info);
    if (pacini_controller_get_info(to_controller(arguments, 0), &info) != PACINI_OK)
        return of_nothing();
    switch (to_int(arguments, 1))
    {
    case 0:
        return of_text(info.name);
    case 1:
        return of_text(info.path);
    case 2:
        return of_int(info.haptics);
    default:
        return of_int(info.connection);
    }
}

/* engine, controller, whether it is silenced by a crash */
EXPORT godot_variant pacini_godot_engine_attach(const void* arguments)
{
    pacini_attach_settings settings;
    pacini_attach_settings_init(&settings);
    settings.stop_on_crash = (int32_t)to_int(arguments, 2);
    return of_result(pacini_engine_attach(to_engine(arguments, 0), to_controller(arguments, 1), &settings));
}

EXPORT godot_variant pacini_godot_engine_detach(const void* arguments)
{
    return of_result(pacini_engine_detach(to_engine(arguments, 0)));
}

/* engine, which of: state, sent, failure */
EXPORT godot_variant pacini_godot_engine_attachment(const void* arguments)
{
    pacini_attachment_info info;
    pacini_attachment_info_init(&info);
    if (pacini_engine_get_attachment(to_engine(arguments, 0), &info) != PACINI_OK)
        return of_nothing();
    switch (to_int(arguments, 1))
    {
    case 0:
        return of_int(info.state);
    case 1:
        return of_int((int64_t)info.sent);
    default:
        return of_text(info.failure);
    }
}
