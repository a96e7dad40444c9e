// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Channels of a sound device among those that are switched on, which are all that its callback gets.

#include <juce_core/juce_core.h>

#include <array>
#include <cstddef>
#include <vector>

namespace pacini::app
{

inline constexpr int mostDeviceChannels = 256;

/// The index of each channel in the callback; -1 if it is disabled.
[[nodiscard]] inline std::array<int, mostDeviceChannels> channelPlaces(const juce::BigInteger& active)
{
    std::array<int, mostDeviceChannels> places{};
    int count = 0;
    for (int channel = 0; channel < mostDeviceChannels; ++channel)
        places[static_cast<std::size_t>(channel)] = active[channel] ? count++ : -1;
    return places;
}

/// Whether each of a number of channels is switched on.
[[nodiscard]] inline std::vector<bool> channelsOn(const juce::BigInteger& active, int channels)
{
    std::vector<bool> on;
    for (int channel = 0; channel < channels; ++channel)
        on.push_back(active[channel]);
    return on;
}

} // namespace pacini::app
