// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/clap/ClapPlugin.h"

#include "plugin/clap/ClapParameters.h"
#include "plugin/clap/ClapState.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace pacini::plugin
{

namespace
{
const clap_plugin_latency_t& latencyExtension() noexcept
{
    static constexpr clap_plugin_latency_t extension{
        [](const clap_plugin_t* plugin)
        {
            return static_cast<std::uint32_t>(ClapPlugin::of(plugin).processor().latency());
        }};
    return extension;
}

const clap_plugin_tail_t& tailExtension() noexcept
{
    static constexpr clap_plugin_tail_t extension{
        [](const clap_plugin_t* plugin)
        {
            const PluginProcessor& processor = ClapPlugin::of(plugin).processor();
            return static_cast<std::uint32_t>(std::lround(processor.getTailLengthSeconds() * processor.sampleRate()));
        }};
    return extension;
}

const clap_plugin_render_t& renderExtension() noexcept
{
    static constexpr clap_plugin_render_t extension{[](const clap_plugin_t*) { return false; },
                                                    [](const clap_plugin_t* plugin, clap_plugin_render_mode mode)
                                                    {
                                                        return ClapPlugin::of(plugin).setRenderMode(mode);
                                                    }};
    return extension;
}

const void* extensionNamed(const char* name) noexcept
{
    struct Named
    {
        const char* name;
        const void* extension;
    };
    const std::array<Named, 10> extensions{{{CLAP_EXT_AUDIO_PORTS, &audioPortsExtension()},
                                            {CLAP_EXT_CONFIGURABLE_AUDIO_PORTS, &configurablePortsExtension()},
                                            {CLAP_EXT_AUDIO_PORTS_CONFIG, &portsConfigExtension()},
                                            {CLAP_EXT_PARAMS, &paramsExtension()},
                                            {CLAP_EXT_STATE, &stateExtension()},
                                            {CLAP_EXT_LATENCY, &latencyExtension()},
                                            {CLAP_EXT_TAIL, &tailExtension()},
                                            {CLAP_EXT_RENDER, &renderExtension()},
                                            {CLAP_EXT_GUI, &guiExtension()},
                                            {CLAP_EXT_TIMER_SUPPORT, &timerExtension()}}};
    for (const auto& [known, extension] : extensions)
        if (name != nullptr && std::strcmp(name, known) == 0)
            return extension;
    return nullptr;
}
} // namespace

const clap_plugin_t* ClapPlugin::make(const clap_host_t& host, const clap_plugin_descriptor_t& described)
{
    return &(new ClapPlugin(host, described))->seen; // destroy() deletes it
}

ClapPlugin::ClapPlugin(const clap_host_t& wanted, const clap_plugin_descriptor_t& described)
    : seen{&described,
           this,
           [](const clap_plugin_t* plugin) { return of(plugin).init(); },
           [](const clap_plugin_t* plugin) { delete &of(plugin); },
           [](const clap_plugin_t* plugin, double rate, std::uint32_t, std::uint32_t mostFrames)
           { return of(plugin).activate(rate, mostFrames); },
           [](const clap_plugin_t* plugin) { of(plugin).deactivate(); },
           [](const clap_plugin_t* plugin) { return of(plugin).active; },
           [](const clap_plugin_t*) {},
           [](const clap_plugin_t* plugin) { of(plugin).processor().reset(); },
           [](const clap_plugin_t* plugin, const clap_process_t* block) -> clap_process_status
           { return block == nullptr ? CLAP_PROCESS_ERROR : of(plugin).process(*block); },
           [](const clap_plugin_t*, const char* name) { return extensionNamed(name); },
           [](const clap_plugin_t* plugin)
           {
               of(plugin).onMainThread();
           }},
      host(wanted)
{
}

ClapPlugin::~ClapPlugin()
{
    if (parts == nullptr)
        return;
    const juce::MessageManagerLock lock;
    parts = nullptr;
}

ClapPlugin::Parts::Parts(ClapPlugin& owner)
    : reports(processor, {[&owner]
                          {
                              const auto* asked = extensionOf<clap_host_params_t>(owner.host, CLAP_EXT_PARAMS);
                              if (asked != nullptr && asked->request_flush != nullptr)
                                  asked->request_flush(&owner.host);
                          },
                          [&owner]
                          {
                              owner.edited.store(true);
                              owner.host.request_callback(&owner.host);
                          }}),
      window(processor, owner.host)
{
}

bool ClapPlugin::init()
{
    if (parts != nullptr)
        return false;
    loop = std::make_unique<ClapEventLoop>(host);
    const juce::MessageManagerLock lock;
    parts = std::make_unique<Parts>(*this);
    return true;
}

bool ClapPlugin::activate(double rate, std::uint32_t mostFrames)
{
    if (active || !std::isfinite(rate) || rate <= 0.0 || mostFrames == 0)
        return false;
    PluginProcessor& prepared = processor();
    const int before = prepared.latency();
    const auto frames =
        static_cast<int>(std::min(mostFrames, static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max())));
    prepared.setRateAndBufferSizeDetails(rate, frames);
    prepared.prepareToPlay(rate, frames);
    parts->audio.prepare();
    active = true;
    const auto* told = extensionOf<clap_host_latency_t>(host, CLAP_EXT_LATENCY);
    if (prepared.latency() != before && told != nullptr && told->changed != nullptr)
        told->changed(&host);
    return true;
}

void ClapPlugin::deactivate()
{
    active = false;
    processor().releaseResources();
}

/// Hosts shall always go on: clips that are played in the window need no sound to come in, and the engine rests by
/// itself.
clap_process_status ClapPlugin::process(const clap_process_t& block) noexcept
{
    if (!active || !parts->audio.process(block))
        return CLAP_PROCESS_ERROR;
    if (block.out_events != nullptr)
        parts->reports.send(*block.out_events);
    return CLAP_PROCESS_CONTINUE;
}

void ClapPlugin::flush(const clap_input_events_t* in, const clap_output_events_t* out) noexcept
{
    const std::uint32_t count = in != nullptr && in->size != nullptr ? in->size(in) : 0;
    for (std::uint32_t i = 0; i < count; ++i)
        if (const clap_event_header_t* event = in->get(in, i))
            applyEvent(processor(), *event);
    if (out != nullptr)
        parts->reports.send(*out);
}

bool ClapPlugin::save(const clap_ostream_t& stream)
{
    juce::MemoryBlock state;
    {
        const juce::MessageManagerLock lock;
        processor().getStateInformation(state);
    }
    return writeAll(stream, {static_cast<const char*>(state.getData()), state.getSize()});
}

bool ClapPlugin::load(const clap_istream_t& stream)
{
    const auto state = readAll(stream, largestState);
    if (!state)
        return false;
    {
        const juce::MessageManagerLock lock;
        const ParameterReports::Pause pause(parts->reports);
        if (!processor().restoreState(*state))
            return false;
    }
    const auto* told = extensionOf<clap_host_params_t>(host, CLAP_EXT_PARAMS);
    if (told != nullptr && told->rescan != nullptr)
        told->rescan(&host, CLAP_PARAM_RESCAN_VALUES);
    return true;
}

bool ClapPlugin::setRenderMode(clap_plugin_render_mode mode)
{
    if (mode != CLAP_RENDER_REALTIME && mode != CLAP_RENDER_OFFLINE)
        return false;
    processor().setNonRealtime(mode == CLAP_RENDER_OFFLINE);
    return true;
}

void ClapPlugin::onMainThread()
{
    const auto* told = extensionOf<clap_host_state_t>(host, CLAP_EXT_STATE);
    if (edited.exchange(false) && told != nullptr && told->mark_dirty != nullptr)
        told->mark_dirty(&host);
}

} // namespace pacini::plugin
