// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/engine/ParameterGroups.h"

#include <array>
#include <cstddef>

namespace pacini::plugin
{

namespace
{
using Name = std::string_view;
constexpr std::array<Name, 3> soundIds{"source", "sourceMix", "inputGain"};
constexpr std::array<Name, 4> outputIds{"outputMode", "outputChannel", "outputCount", "bypass"};
constexpr std::array<Name, 3> actuatorIds{"profile", "strength", "intensity"};
constexpr std::array<Name, 4> layerIds{"rumble", "texture", "transientLevel", "transientMute"};
constexpr std::array<Name, 6> characterIds{"brightness", "audible", "transposition", "direct", "attack", "release"};
constexpr std::array<Name, 2> eventIds{"transientSensitivity", "transientSharpness"};
constexpr std::array<Name, 2> gateIds{"gate", "speech"};
constexpr std::array<Name, 4> panningIds{"pan", "position", "panLaw", "places"};
constexpr std::array<Name, 4> channelIds{"actuator", "gain", "delay", "place"};

constexpr std::array<ParameterGroup, 9> groups{{
    {"sound", "Sound", soundIds},
    {"output", "Output", outputIds},
    {"actuator", "Actuator", actuatorIds},
    {"layers", "Layers", layerIds},
    {"character", "Character", characterIds},
    {"events", "Events", eventIds},
    {"gate", "Gate", gateIds},
    {"panning", "Panning", panningIds},
    {"channels", "Haptic channels", channelIds},
}};
} // namespace

std::span<const ParameterGroup> parameterGroups() noexcept
{
    return groups;
}

const ParameterGroup& groupOf(std::string_view id) noexcept
{
    const ParameterGroup* best = &groups.back();
    std::size_t longest = 0;
    for (const ParameterGroup& group : groups)
        for (const Name begin : group.ids)
            if (begin.size() > longest && id.starts_with(begin))
            {
                best = &group;
                longest = begin.size();
            }
    return *best;
}

} // namespace pacini::plugin
