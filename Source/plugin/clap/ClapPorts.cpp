// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/clap/ClapAudio.h"
#include "plugin/clap/ClapPlugin.h"

#include <array>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>

namespace pacini::plugin
{

namespace
{
constexpr std::array<std::string_view, 2> inputNames{"Sound", "Sidechain"};
constexpr std::array<std::string_view, 2> outputNames{"Sound", "Haptic"};

/// What a host may know of the channels of a port; null: anything. Haptic channels are actuators, no loudspeakers.
const char* typeOf(bool isHaptic, int channels) noexcept
{
    if (isHaptic)
        return nullptr;
    return channels == 1 ? CLAP_PORT_MONO : channels == 2 ? CLAP_PORT_STEREO : nullptr;
}

bool isHaptic(bool isInput, int port) noexcept
{
    return !isInput && port == 1;
}

template <std::size_t size>
void copyName(std::string_view name, char (&to)[size]) noexcept
{
    static_assert(size > 64);
    std::memcpy(to, name.data(), name.size());
    to[name.size()] = 0;
}

using Layout = juce::AudioProcessor::BusesLayout;
using Request = clap_audio_port_configuration_request_t;

/// The channels after the requests; none if the processor cannot have them.
std::optional<Layout> layoutAfter(const juce::AudioProcessor& processor, std::span<const Request> requests)
{
    Layout layout = processor.getBusesLayout();
    for (const Request& request : requests)
    {
        auto& buses = request.is_input ? layout.inputBuses : layout.outputBuses;
        const auto port = static_cast<int>(request.port_index);
        if (request.port_index >= static_cast<std::uint32_t>(buses.size()) || request.channel_count == 0 ||
            request.channel_count > maxMainChannels)
            return std::nullopt;
        const auto channels = static_cast<int>(request.channel_count);
        buses.set(port, isHaptic(request.is_input, port) ? juce::AudioChannelSet::discreteChannels(channels)
                                                         : juce::AudioChannelSet::canonicalChannelSet(channels));
    }
    return processor.checkBusesLayoutSupported(layout) ? std::optional(layout) : std::nullopt;
}

/// The choices of hosts that do not ask for channels by themselves.
struct Configuration
{
    std::string_view name;
    std::uint32_t sound, haptic;
};
constexpr std::array<Configuration, 7> configurations{{{"Stereo, 1 actuator", 2, 1},
                                                       {"Stereo, 2 actuators", 2, 2},
                                                       {"Stereo, 4 actuators", 2, 4},
                                                       {"Stereo, 8 actuators", 2, 8},
                                                       {"Mono, 1 actuator", 1, 1},
                                                       {"5.1, 1 actuator", 6, 1},
                                                       {"5.1, 2 actuators", 6, 2}}};

std::optional<Layout> layoutOf(const juce::AudioProcessor& processor, const Configuration& wanted)
{
    const std::array<Request, 4> requests{
        Request{true, 0, wanted.sound, nullptr, nullptr}, Request{true, 1, 1, nullptr, nullptr},
        Request{false, 0, wanted.sound, nullptr, nullptr}, Request{false, 1, wanted.haptic, nullptr, nullptr}};
    return layoutAfter(processor, requests);
}
} // namespace

bool describePort(const juce::AudioProcessor& processor, bool isInput, std::uint32_t index,
                  clap_audio_port_info_t& info) noexcept
{
    if (index >= static_cast<std::uint32_t>(processor.getBusCount(isInput)))
        return false;
    const auto port = static_cast<int>(index);
    const int channels = processor.getChannelCountOfBus(isInput, port);
    info = {};
    info.id = index;
    copyName((isInput ? inputNames : outputNames)[index], info.name);
    info.flags = index == 0 ? std::uint32_t(CLAP_AUDIO_PORT_IS_MAIN) : 0;
    info.channel_count = static_cast<std::uint32_t>(channels);
    info.port_type = typeOf(isHaptic(isInput, port), channels);
    info.in_place_pair = index == 0 ? 0 : CLAP_INVALID_ID;
    return true;
}

const clap_plugin_audio_ports_t& audioPortsExtension() noexcept
{
    static constexpr clap_plugin_audio_ports_t extension{
        [](const clap_plugin_t* plugin, bool isInput)
        { return static_cast<std::uint32_t>(ClapPlugin::of(plugin).processor().getBusCount(isInput)); },
        [](const clap_plugin_t* plugin, std::uint32_t index, bool isInput, clap_audio_port_info_t* info)
        {
            return info != nullptr && describePort(ClapPlugin::of(plugin).processor(), isInput, index, *info);
        }};
    return extension;
}

const clap_plugin_configurable_audio_ports_t& configurablePortsExtension() noexcept
{
    static constexpr clap_plugin_configurable_audio_ports_t extension{
        [](const clap_plugin_t* plugin, const Request* requests, std::uint32_t count)
        {
            const ClapPlugin& asked = ClapPlugin::of(plugin);
            return !asked.isActive() && requests != nullptr &&
                   layoutAfter(asked.processor(), {requests, count}).has_value();
        },
        [](const clap_plugin_t* plugin, const Request* requests, std::uint32_t count)
        {
            ClapPlugin& asked = ClapPlugin::of(plugin);
            if (asked.isActive() || requests == nullptr)
                return false;
            const auto layout = layoutAfter(asked.processor(), {requests, count});
            return layout.has_value() && asked.processor().setBusesLayout(*layout);
        }};
    return extension;
}

const clap_plugin_audio_ports_config_t& portsConfigExtension() noexcept
{
    static constexpr clap_plugin_audio_ports_config_t extension{
        [](const clap_plugin_t*) -> std::uint32_t { return configurations.size(); },
        [](const clap_plugin_t*, std::uint32_t index, clap_audio_ports_config_t* config)
        {
            if (index >= configurations.size() || config == nullptr)
                return false;
            const Configuration& described = configurations[index];
            *config = {};
            config->id = index;
            copyName(described.name, config->name);
            config->input_port_count = config->output_port_count = 2;
            config->has_main_input = config->has_main_output = true;
            config->main_input_channel_count = config->main_output_channel_count = described.sound;
            config->main_input_port_type = config->main_output_port_type =
                typeOf(false, static_cast<int>(described.sound));
            return true;
        },
        [](const clap_plugin_t* plugin, clap_id id)
        {
            ClapPlugin& asked = ClapPlugin::of(plugin);
            if (asked.isActive() || id >= configurations.size())
                return false;
            const auto layout = layoutOf(asked.processor(), configurations[id]);
            return layout.has_value() && asked.processor().setBusesLayout(*layout);
        }};
    return extension;
}

} // namespace pacini::plugin
