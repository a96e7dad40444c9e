// SPDX-License-Identifier: GPL-3.0-or-later

// Entry of the CLAP plugin. Nothing is made before a host wants an instance, so that it may be entered and left any
// number of times.

#include "plugin/clap/ClapPlugin.h"

#include <array>
#include <cstring>

namespace pacini::plugin
{

namespace
{
constexpr const char* clapPluginId = "example.pacini.translator";
constexpr std::array<const char*, 4> features{CLAP_PLUGIN_FEATURE_AUDIO_EFFECT, CLAP_PLUGIN_FEATURE_UTILITY,
                                              CLAP_PLUGIN_FEATURE_STEREO, nullptr};
constexpr clap_plugin_descriptor_t descriptor{
    CLAP_VERSION_INIT,     clapPluginId,     "Pacini",       "Pacini", "", "", "",
    PACINI_PLUGIN_VERSION, "Sound to touch", features.data()};

constexpr clap_plugin_factory_t factory{
    [](const clap_plugin_factory_t*) -> std::uint32_t { return 1; },
    [](const clap_plugin_factory_t*, std::uint32_t index) { return index == 0 ? &descriptor : nullptr; },
    [](const clap_plugin_factory_t*, const clap_host_t* host, const char* id) -> const clap_plugin_t*
    {
        if (host == nullptr || host->clap_version.major < 1 || id == nullptr || std::strcmp(id, clapPluginId) != 0)
            return nullptr;
        return ClapPlugin::make(*host, descriptor);
    }};
} // namespace

} // namespace pacini::plugin

extern "C"
{
    CLAP_EXPORT extern const clap_plugin_entry_t clap_entry;
    const clap_plugin_entry_t clap_entry{CLAP_VERSION_INIT, [](const char*) { return true; }, [] {},
                                         [](const char* id) -> const void*
                                         {
                                             return id != nullptr && std::strcmp(id, CLAP_PLUGIN_FACTORY_ID) == 0
                                                        ? &pacini::plugin::factory
                                                        : nullptr;
                                         }};
}
