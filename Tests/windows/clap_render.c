/* Plays a sound through the CLAP plugin of Windows or of this machine, as a host without a window does, and writes what
   its haptic port puts out. Samples are raw 32-bit floats of one channel at 48 kHz.

   clap_render PLUGIN IN OUT [SECONDS]   SECONDS: how long its window is shown afterwards, within one of the host's */

#include "../../Source/plugin/clap/ClapDeclarations.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

enum
{
    most = 64,
    block = 480
};

static const void* extension(const clap_host_t* host, const char* id)
{
    (void)host;
    (void)id;
    return NULL;
}

static void ignore(const clap_host_t* host)
{
    (void)host;
}

static uint32_t none(const clap_input_events_t* list)
{
    (void)list;
    return 0;
}

static const clap_event_header_t* nothing(const clap_input_events_t* list, uint32_t index)
{
    (void)list;
    (void)index;
    return NULL;
}

static bool take(const clap_output_events_t* list, const clap_event_header_t* event)
{
    (void)list;
    (void)event;
    return true;
}

static const clap_plugin_entry_t* load(const char* path)
{
#ifdef _WIN32
    /* As most hosts do: what the plugin needs is not looked for in its folder. */
    HMODULE module = LoadLibraryA(path);
    if (!module)
        fprintf(stderr, "clap_render: %s: cannot be loaded: %lu\n", path, GetLastError());
    return module ? (const clap_plugin_entry_t*)(void*)GetProcAddress(module, "clap_entry") : NULL;
#else
    void* module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!module)
        fprintf(stderr, "clap_render: %s\n", dlerror());
    return module ? (const clap_plugin_entry_t*)dlsym(module, "clap_entry") : NULL;
#endif
}

static int fail(const char* what)
{
    fprintf(stderr, "clap_render: %s\n", what);
    return 1;
}

/* Buffers of the ports of one direction; all channels share the sound, or have room of their own. */
static uint32_t ports(const clap_plugin_t* plugin, bool isInput, float* sound, clap_audio_buffer_t* buffers,
                      uint32_t* haptic)
{
    const clap_plugin_audio_ports_t* audio = plugin->get_extension(plugin, CLAP_EXT_AUDIO_PORTS);
    const uint32_t count = audio ? audio->count(plugin, isInput) : 0;
    for (uint32_t p = 0; p < count && p < most; ++p)
    {
        clap_audio_port_info_t info;
        if (!audio->get(plugin, p, isInput, &info))
            return 0;
        if (strcmp(info.name, "Haptic") == 0)
            *haptic = p;
        buffers[p].channel_count = info.channel_count;
        buffers[p].data32 = malloc(sizeof(float*) * (info.channel_count + 1));
        for (uint32_t c = 0; c < info.channel_count; ++c)
            buffers[p].data32[c] = sound ? sound : calloc(block, sizeof(float));
    }
    return count;
}

#ifdef _WIN32
static void turn(DWORD milliseconds)
{
    const DWORD until = GetTickCount() + milliseconds;
    MSG message;
    while ((LONG)(until - GetTickCount()) > 0)
    {
        while (PeekMessageA(&message, NULL, 0, 0, PM_REMOVE))
        {
            TranslateMessage(&message);
            DispatchMessageA(&message);
        }
        Sleep(5);
    }
}

static int show(const clap_plugin_t* plugin, double seconds)
{
    const clap_plugin_gui_t* gui = plugin->get_extension(plugin, CLAP_EXT_GUI);
    uint32_t width = 0, height = 0;
    if (!gui || !gui->is_api_supported(plugin, CLAP_WINDOW_API_WIN32, false))
        return fail("has no window for Windows");
    if (!gui->create(plugin, CLAP_WINDOW_API_WIN32, false) || !gui->get_size(plugin, &width, &height))
        return fail("makes no window");
    RECT outside = {0, 0, (LONG)width, (LONG)height};
    AdjustWindowRect(&outside, WS_OVERLAPPEDWINDOW, FALSE);
    HWND window = CreateWindowA("STATIC", "Host", WS_OVERLAPPEDWINDOW | WS_VISIBLE, 0, 0, outside.right - outside.left,
                                outside.bottom - outside.top, NULL, NULL, GetModuleHandleA(NULL), NULL);
    clap_window_t parent;
    parent.api = CLAP_WINDOW_API_WIN32;
    parent.win32 = window;
    if (!window || !gui->set_parent(plugin, &parent) || !gui->show(plugin))
        return fail("does not show its window");
    printf("%u %u\n", width, height);
    fflush(stdout);
    turn((DWORD)(1000.0 * seconds));
    gui->destroy(plugin);
    DestroyWindow(window);
    return 0;
}
#endif

int main(int argc, char** argv)
{
    if (argc < 4)
        return fail("needs PLUGIN IN OUT [SECONDS]");
    const clap_host_t host = {CLAP_VERSION_INIT, NULL,   "clap_render", "Pacini", "", "1",
                              extension,         ignore, ignore,        ignore};
    const clap_plugin_entry_t* entry = load(argv[1]);
    if (!entry || !entry->init(argv[1]))
        return fail("cannot load the plugin");
    const clap_plugin_factory_t* factory = entry->get_factory(CLAP_PLUGIN_FACTORY_ID);
    const clap_plugin_descriptor_t* descriptor = factory ? factory->get_plugin_descriptor(factory, 0) : NULL;
    const clap_plugin_t* plugin = descriptor ? factory->create_plugin(factory, &host, descriptor->id) : NULL;
    if (!plugin || !plugin->init(plugin))
        return fail("cannot make the plugin");
    const clap_plugin_render_t* render = plugin->get_extension(plugin, CLAP_EXT_RENDER);
    if (!render || !render->set(plugin, CLAP_RENDER_OFFLINE))
        return fail("does not render offline");

    static float sound[block];
    clap_audio_buffer_t inputs[most] = {{0}}, outputs[most] = {{0}};
    uint32_t haptic = most;
    const uint32_t inputCount = ports(plugin, true, sound, inputs, &haptic);
    const uint32_t outputCount = ports(plugin, false, NULL, outputs, &haptic);
    if (haptic >= outputCount || outputs[haptic].channel_count == 0)
        return fail("has no haptic port");
    if (!plugin->activate(plugin, 48000.0, 1, block) || !plugin->start_processing(plugin))
        return fail("does not start");

    FILE* in = fopen(argv[2], "rb");
    FILE* out = fopen(argv[3], "wb");
    if (!in || !out)
        return fail("cannot open the sounds");
    const clap_input_events_t inEvents = {NULL, none, nothing};
    const clap_output_events_t outEvents = {NULL, take};
    int64_t time = 0;
    size_t frames;
    while ((frames = fread(sound, sizeof(float), block, in)) > 0)
    {
        const clap_process_t process = {time,       (uint32_t)frames, NULL,      inputs,    outputs,
                                        inputCount, outputCount,      &inEvents, &outEvents};
        if (plugin->process(plugin, &process) == CLAP_PROCESS_ERROR)
            return fail("does not process");
        fwrite(outputs[haptic].data32[0], sizeof(float), frames, out);
        time += (int64_t)frames;
    }
    if (fclose(out) != 0)
        return fail("cannot write");
    fclose(in);
    plugin->stop_processing(plugin);
    plugin->deactivate(plugin);
#ifdef _WIN32
    const int shown = argc > 4 ? show(plugin, atof(argv[4])) : 0;
#else
    const int shown = 0;
#endif
    plugin->destroy(plugin);
    entry->deinit();
    return shown;
}
