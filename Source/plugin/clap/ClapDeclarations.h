/* SPDX-License-Identifier: GPL-3.0-or-later */
#pragma once

/*
 * The part of CLAP's binary interface that the plugin uses, for machines without its headers: names, layouts and values
 * are those of version 1.2.10 of https://github.com/free-audio/clap, which explains them. Plain C. A test compares all
 * of it with what others declare (Tests/plugin/clap/check_clap_abi.py); CMake takes the headers themselves from
 * PACINI_CLAP_DIR.
 */

#include <stdbool.h>
#include <stdint.h>

#if defined(_WIN32) || defined(__CYGWIN__)
#define CLAP_ABI __cdecl
#else
#define CLAP_ABI
#endif
#if defined(_MSC_VER)
#define CLAP_EXPORT __declspec(dllexport)
#elif defined(_WIN32)
#define CLAP_EXPORT __attribute__((dllexport))
#else
#define CLAP_EXPORT __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C"
{
#endif

    /* clang-format off */

/* Version and identifiers */
typedef struct clap_version {
    uint32_t major;
    uint32_t minor;
    uint32_t revision;
} clap_version_t;

#define CLAP_VERSION_MAJOR 1
#define CLAP_VERSION_MINOR 2
#define CLAP_VERSION_REVISION 10
#define CLAP_VERSION_INIT { CLAP_VERSION_MAJOR, CLAP_VERSION_MINOR, CLAP_VERSION_REVISION }

typedef uint32_t clap_id;
#define CLAP_INVALID_ID UINT32_MAX
enum {
    CLAP_NAME_SIZE = 256,
    CLAP_PATH_SIZE = 1024
};

/* Host */
typedef struct clap_host {
    clap_version_t clap_version;
    void *host_data;
    const char *name;
    const char *vendor;
    const char *url;
    const char *version;
    const void *(CLAP_ABI *get_extension)(const struct clap_host *host, const char *extension_id);
    void (CLAP_ABI *request_restart)(const struct clap_host *host);
    void (CLAP_ABI *request_process)(const struct clap_host *host);
    void (CLAP_ABI *request_callback)(const struct clap_host *host);
} clap_host_t;

/* Events */
typedef struct clap_event_header {
    uint32_t size;
    uint32_t time;
    uint16_t space_id;
    uint16_t type;
    uint32_t flags;
} clap_event_header_t;

#define CLAP_CORE_EVENT_SPACE_ID 0
enum {
    CLAP_EVENT_IS_LIVE = 1,
    CLAP_EVENT_PARAM_VALUE = 5,
    CLAP_EVENT_PARAM_MOD = 6,
    CLAP_EVENT_PARAM_GESTURE_BEGIN = 7,
    CLAP_EVENT_PARAM_GESTURE_END = 8
};

typedef struct clap_event_param_value {
    clap_event_header_t header;
    clap_id param_id;
    void *cookie;
    int32_t note_id;
    int16_t port_index;
    int16_t channel;
    int16_t key;
    double value;
} clap_event_param_value_t;

typedef struct clap_event_param_mod {
    clap_event_header_t header;
    clap_id param_id;
    void *cookie;
    int32_t note_id;
    int16_t port_index;
    int16_t channel;
    int16_t key;
    double amount;
} clap_event_param_mod_t;

typedef struct clap_event_param_gesture {
    clap_event_header_t header;
    clap_id param_id;
} clap_event_param_gesture_t;

typedef struct clap_input_events {
    void *ctx;
    uint32_t (CLAP_ABI *size)(const struct clap_input_events *list);
    const clap_event_header_t *(CLAP_ABI *get)(const struct clap_input_events *list, uint32_t index);
} clap_input_events_t;

typedef struct clap_output_events {
    void *ctx;
    bool (CLAP_ABI *try_push)(const struct clap_output_events *list, const clap_event_header_t *event);
} clap_output_events_t;

/* Processing */
typedef struct clap_audio_buffer {
    float **data32;
    double **data64;
    uint32_t channel_count;
    uint32_t latency;
    uint64_t constant_mask;
} clap_audio_buffer_t;

typedef struct clap_event_transport clap_event_transport_t; /* which the plugin does not read */

typedef struct clap_process {
    int64_t steady_time;
    uint32_t frames_count;
    const clap_event_transport_t *transport;
    const clap_audio_buffer_t *audio_inputs;
    clap_audio_buffer_t *audio_outputs;
    uint32_t audio_inputs_count;
    uint32_t audio_outputs_count;
    const clap_input_events_t *in_events;
    const clap_output_events_t *out_events;
} clap_process_t;

typedef int32_t clap_process_status;
enum {
    CLAP_PROCESS_ERROR = 0,
    CLAP_PROCESS_CONTINUE = 1
};

/* Plugin, factory, entry */
#define CLAP_PLUGIN_FEATURE_AUDIO_EFFECT "audio-effect"
#define CLAP_PLUGIN_FEATURE_UTILITY "utility"
#define CLAP_PLUGIN_FEATURE_STEREO "stereo"

typedef struct clap_plugin_descriptor {
    clap_version_t clap_version;
    const char *id;
    const char *name;
    const char *vendor;
    const char *url;
    const char *manual_url;
    const char *support_url;
    const char *version;
    const char *description;
    const char *const *features;
} clap_plugin_descriptor_t;

typedef struct clap_plugin {
    const clap_plugin_descriptor_t *desc;
    void *plugin_data;
    bool (CLAP_ABI *init)(const struct clap_plugin *plugin);
    void (CLAP_ABI *destroy)(const struct clap_plugin *plugin);
    bool (CLAP_ABI *activate)(const struct clap_plugin *plugin, double sample_rate, uint32_t min_frames_count, uint32_t max_frames_count);
    void (CLAP_ABI *deactivate)(const struct clap_plugin *plugin);
    bool (CLAP_ABI *start_processing)(const struct clap_plugin *plugin);
    void (CLAP_ABI *stop_processing)(const struct clap_plugin *plugin);
    void (CLAP_ABI *reset)(const struct clap_plugin *plugin);
    clap_process_status (CLAP_ABI *process)(const struct clap_plugin *plugin, const clap_process_t *process);
    const void *(CLAP_ABI *get_extension)(const struct clap_plugin *plugin, const char *id);
    void (CLAP_ABI *on_main_thread)(const struct clap_plugin *plugin);
} clap_plugin_t;

#define CLAP_PLUGIN_FACTORY_ID "clap.plugin-factory"
typedef struct clap_plugin_factory {
    uint32_t (CLAP_ABI *get_plugin_count)(const struct clap_plugin_factory *factory);
    const clap_plugin_descriptor_t *(CLAP_ABI *get_plugin_descriptor)(const struct clap_plugin_factory *factory, uint32_t index);
    const clap_plugin_t *(CLAP_ABI *create_plugin)(const struct clap_plugin_factory *factory, const clap_host_t *host, const char *plugin_id);
} clap_plugin_factory_t;

typedef struct clap_plugin_entry {
    clap_version_t clap_version;
    bool (CLAP_ABI *init)(const char *plugin_path);
    void (CLAP_ABI *deinit)(void);
    const void *(CLAP_ABI *get_factory)(const char *factory_id);
} clap_plugin_entry_t;

CLAP_EXPORT extern const clap_plugin_entry_t clap_entry;

/* Audio ports */
#define CLAP_EXT_AUDIO_PORTS "clap.audio-ports"
#define CLAP_PORT_MONO "mono"
#define CLAP_PORT_STEREO "stereo"
enum {
    CLAP_AUDIO_PORT_IS_MAIN = 1
};

typedef struct clap_audio_port_info {
    clap_id id;
    char name[CLAP_NAME_SIZE];
    uint32_t flags;
    uint32_t channel_count;
    const char *port_type;
    clap_id in_place_pair;
} clap_audio_port_info_t;

typedef struct clap_plugin_audio_ports {
    uint32_t (CLAP_ABI *count)(const clap_plugin_t *plugin, bool is_input);
    bool (CLAP_ABI *get)(const clap_plugin_t *plugin, uint32_t index, bool is_input, clap_audio_port_info_t *info);
} clap_plugin_audio_ports_t;

#define CLAP_EXT_CONFIGURABLE_AUDIO_PORTS "clap.configurable-audio-ports/1"
typedef struct clap_audio_port_configuration_request {
    bool is_input;
    uint32_t port_index;
    uint32_t channel_count;
    const char *port_type;
    const void *port_details;
} clap_audio_port_configuration_request_t;

typedef struct clap_plugin_configurable_audio_ports {
    bool (CLAP_ABI *can_apply_configuration)(const clap_plugin_t *plugin, const struct clap_audio_port_configuration_request *requests, uint32_t request_count);
    bool (CLAP_ABI *apply_configuration)(const clap_plugin_t *plugin, const struct clap_audio_port_configuration_request *requests, uint32_t request_count);
} clap_plugin_configurable_audio_ports_t;

#define CLAP_EXT_AUDIO_PORTS_CONFIG "clap.audio-ports-config"
typedef struct clap_audio_ports_config {
    clap_id id;
    char name[CLAP_NAME_SIZE];
    uint32_t input_port_count;
    uint32_t output_port_count;
    bool has_main_input;
    uint32_t main_input_channel_count;
    const char *main_input_port_type;
    bool has_main_output;
    uint32_t main_output_channel_count;
    const char *main_output_port_type;
} clap_audio_ports_config_t;

typedef struct clap_plugin_audio_ports_config {
    uint32_t (CLAP_ABI *count)(const clap_plugin_t *plugin);
    bool (CLAP_ABI *get)(const clap_plugin_t *plugin, uint32_t index, clap_audio_ports_config_t *config);
    bool (CLAP_ABI *select)(const clap_plugin_t *plugin, clap_id config_id);
} clap_plugin_audio_ports_config_t;

/* Parameters */
#define CLAP_EXT_PARAMS "clap.params"
enum {
    CLAP_PARAM_IS_STEPPED = 1,
    CLAP_PARAM_IS_BYPASS = 16,
    CLAP_PARAM_IS_AUTOMATABLE = 32,
    CLAP_PARAM_IS_MODULATABLE = 1024,
    CLAP_PARAM_IS_ENUM = 65536,
    CLAP_PARAM_RESCAN_VALUES = 1
};
typedef uint32_t clap_param_info_flags;
typedef uint32_t clap_param_rescan_flags;
typedef uint32_t clap_param_clear_flags;

typedef struct clap_param_info {
    clap_id id;
    clap_param_info_flags flags;
    void *cookie;
    char name[CLAP_NAME_SIZE];
    char module[CLAP_PATH_SIZE];
    double min_value;
    double max_value;
    double default_value;
} clap_param_info_t;

typedef struct clap_plugin_params {
    uint32_t (CLAP_ABI *count)(const clap_plugin_t *plugin);
    bool (CLAP_ABI *get_info)(const clap_plugin_t *plugin, uint32_t param_index, clap_param_info_t *param_info);
    bool (CLAP_ABI *get_value)(const clap_plugin_t *plugin, clap_id param_id, double *out_value);
    bool (CLAP_ABI *value_to_text)(const clap_plugin_t *plugin, clap_id param_id, double value, char *out_buffer, uint32_t out_buffer_capacity);
    bool (CLAP_ABI *text_to_value)(const clap_plugin_t *plugin, clap_id param_id, const char *param_value_text, double *out_value);
    void (CLAP_ABI *flush)(const clap_plugin_t *plugin, const clap_input_events_t *in, const clap_output_events_t *out);
} clap_plugin_params_t;

typedef struct clap_host_params {
    void (CLAP_ABI *rescan)(const clap_host_t *host, clap_param_rescan_flags flags);
    void (CLAP_ABI *clear)(const clap_host_t *host, clap_id param_id, clap_param_clear_flags flags);
    void (CLAP_ABI *request_flush)(const clap_host_t *host);
} clap_host_params_t;

/* Latency, tail, rendering */
#define CLAP_EXT_LATENCY "clap.latency"
typedef struct clap_plugin_latency {
    uint32_t (CLAP_ABI *get)(const clap_plugin_t *plugin);
} clap_plugin_latency_t;

typedef struct clap_host_latency {
    void (CLAP_ABI *changed)(const clap_host_t *host);
} clap_host_latency_t;

#define CLAP_EXT_TAIL "clap.tail"
typedef struct clap_plugin_tail {
    uint32_t (CLAP_ABI *get)(const clap_plugin_t *plugin);
} clap_plugin_tail_t;

#define CLAP_EXT_RENDER "clap.render"
typedef int32_t clap_plugin_render_mode;
enum {
    CLAP_RENDER_REALTIME = 0,
    CLAP_RENDER_OFFLINE = 1
};

typedef struct clap_plugin_render {
    bool (CLAP_ABI *has_hard_realtime_requirement)(const clap_plugin_t *plugin);
    bool (CLAP_ABI *set)(const clap_plugin_t *plugin, clap_plugin_render_mode mode);
} clap_plugin_render_t;

/* State */
typedef struct clap_istream {
    void *ctx;
    int64_t (CLAP_ABI *read)(const struct clap_istream *stream, void *buffer, uint64_t size);
} clap_istream_t;

typedef struct clap_ostream {
    void *ctx;
    int64_t (CLAP_ABI *write)(const struct clap_ostream *stream, const void *buffer, uint64_t size);
} clap_ostream_t;

#define CLAP_EXT_STATE "clap.state"
typedef struct clap_plugin_state {
    bool (CLAP_ABI *save)(const clap_plugin_t *plugin, const clap_ostream_t *stream);
    bool (CLAP_ABI *load)(const clap_plugin_t *plugin, const clap_istream_t *stream);
} clap_plugin_state_t;

typedef struct clap_host_state {
    void (CLAP_ABI *mark_dirty)(const clap_host_t *host);
} clap_host_state_t;

/* Timer of the host */
#define CLAP_EXT_TIMER_SUPPORT "clap.timer-support"
typedef struct clap_plugin_timer_support {
    void (CLAP_ABI *on_timer)(const clap_plugin_t *plugin, clap_id timer_id);
} clap_plugin_timer_support_t;

typedef struct clap_host_timer_support {
    bool (CLAP_ABI *register_timer)(const clap_host_t *host, uint32_t period_ms, clap_id *timer_id);
    bool (CLAP_ABI *unregister_timer)(const clap_host_t *host, clap_id timer_id);
} clap_host_timer_support_t;

/* Window */
#define CLAP_EXT_GUI "clap.gui"
#define CLAP_WINDOW_API_WIN32 "win32"
#define CLAP_WINDOW_API_COCOA "cocoa"
#define CLAP_WINDOW_API_X11 "x11"

typedef struct clap_window {
    const char *api;
    union {
        void *cocoa;
        void *uikit;
        unsigned long x11;
        void *win32;
        void *ptr;
    };
} clap_window_t;

typedef struct clap_gui_resize_hints {
    bool can_resize_horizontally;
    bool can_resize_vertically;
    bool preserve_aspect_ratio;
    uint32_t aspect_ratio_width;
    uint32_t aspect_ratio_height;
} clap_gui_resize_hints_t;

typedef struct clap_plugin_gui {
    bool (CLAP_ABI *is_api_supported)(const clap_plugin_t *plugin, const char *api, bool is_floating);
    bool (CLAP_ABI *get_preferred_api)(const clap_plugin_t *plugin, const char **api, bool *is_floating);
    bool (CLAP_ABI *create)(const clap_plugin_t *plugin, const char *api, bool is_floating);
    void (CLAP_ABI *destroy)(const clap_plugin_t *plugin);
    bool (CLAP_ABI *set_scale)(const clap_plugin_t *plugin, double scale);
    bool (CLAP_ABI *get_size)(const clap_plugin_t *plugin, uint32_t *width, uint32_t *height);
    bool (CLAP_ABI *can_resize)(const clap_plugin_t *plugin);
    bool (CLAP_ABI *get_resize_hints)(const clap_plugin_t *plugin, clap_gui_resize_hints_t *hints);
    bool (CLAP_ABI *adjust_size)(const clap_plugin_t *plugin, uint32_t *width, uint32_t *height);
    bool (CLAP_ABI *set_size)(const clap_plugin_t *plugin, uint32_t width, uint32_t height);
    bool (CLAP_ABI *set_parent)(const clap_plugin_t *plugin, const clap_window_t *window);
    bool (CLAP_ABI *set_transient)(const clap_plugin_t *plugin, const clap_window_t *window);
    void (CLAP_ABI *suggest_title)(const clap_plugin_t *plugin, const char *title);
    bool (CLAP_ABI *show)(const clap_plugin_t *plugin);
    bool (CLAP_ABI *hide)(const clap_plugin_t *plugin);
} clap_plugin_gui_t;

typedef struct clap_host_gui {
    void (CLAP_ABI *resize_hints_changed)(const clap_host_t *host);
    bool (CLAP_ABI *request_resize)(const clap_host_t *host, uint32_t width, uint32_t height);
    bool (CLAP_ABI *request_show)(const clap_host_t *host);
    bool (CLAP_ABI *request_hide)(const clap_host_t *host);
    void (CLAP_ABI *closed)(const clap_host_t *host, bool was_destroyed);
} clap_host_gui_t;

    /* clang-format on */

#ifdef __cplusplus
}
#endif
