// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Output routing of the drive signal: haptic output, main output and bypass.

#include "plugin/engine/GainRamp.h"
#include "plugin/engine/ParameterTable.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>

namespace pacini::plugin
{

/// Writes the drives to the haptic output and, as the output mode says, into the main output: that of the first
/// channel, or all of them where they take the place of the sound. Bypass fades them out, and the sound in again,
/// within 10 ms.
class DriveRouting
{
public:
    void prepare(double sampleRate) noexcept
    {
        active.prepare(sampleRate);
        begun = false;
    }
    void reset() noexcept { begun = false; }

    /// `channel` and how many from there on the drives are added to.
    void aim(OutputMode wanted, std::size_t channel, std::size_t channelCount, bool bypassed) noexcept
    {
        mode = wanted;
        chosen = channel;
        count = channelCount;
        if (begun)
            active.aim(bypassed ? 0.0f : 1.0f);
        else
            active.jump(bypassed ? 0.0f : 1.0f);
        begun = true;
    }

    /// `main` holds the sound, as late as the drives; all of one length, with a drive for each of `haptic` and one at
    /// least. `drives` are afterwards what goes out: faded, and silent where nothing plays them.
    void process(std::span<const std::span<float>> main, std::span<const std::span<float>> haptic,
                 std::span<const std::span<float>> drives) noexcept
    {
        if (active.atRest() && active.value() == 0.0f)
        {
            for (const auto& channels : {haptic, drives})
                for (const auto& channel : channels)
                    std::fill(channel.begin(), channel.end(), 0.0f);
            return;
        }
        const GainRamp gain = active;
        if (!active.atRest())
            for (const auto& drive : drives)
            {
                active = gain;
                for (float& sample : drive)
                    sample *= active.next();
            }
        for (std::size_t c = 0; c < haptic.size(); ++c)
            std::copy(drives[c].begin(), drives[c].end(), haptic[c].begin());
        const auto first = drives[0];
        switch (mode)
        {
        case OutputMode::separate:
            break;
        case OutputMode::replaceMain:
            for (std::size_t c = 0; c < main.size(); ++c)
                put(main[c], c < drives.size() ? drives[c] : first, gain);
            break;
        case OutputMode::monoAndHaptic:
            if (main.size() >= 2)
                fold(main, gain);
            [[fallthrough]];
        case OutputMode::rightHaptic:
            if (main.size() >= 2)
                put(main[1], first, gain);
            break;
        case OutputMode::addToChannel:
            for (std::size_t c = 0; c < std::min(count, drives.size()) && chosen + c < main.size(); ++c)
                std::transform(drives[c].begin(), drives[c].end(), main[chosen + c].begin(), main[chosen + c].begin(),
                               std::plus<>());
            break;
        }
        for (std::size_t c = haptic.size(); c < drives.size(); ++c)
            if (!isInMain(c, main.size()))
                std::fill(drives[c].begin(), drives[c].end(), 0.0f);
    }

    /// Whether the main output has a drive.
    [[nodiscard]] bool isInMain(std::size_t drive, std::size_t mainChannels) const noexcept
    {
        switch (mode)
        {
        case OutputMode::separate:
            break;
        case OutputMode::replaceMain:
            return drive < mainChannels;
        case OutputMode::monoAndHaptic:
        case OutputMode::rightHaptic:
            return drive == 0 && mainChannels >= 2;
        case OutputMode::addToChannel:
            return drive < count && chosen + drive < mainChannels;
        }
        return false;
    }

private:
    /// The drive, which is faded already, in the place of the sound.
    static void put(std::span<float> to, std::span<const float> drive, GainRamp gain) noexcept
    {
        if (gain.atRest())
        {
            std::copy(drive.begin(), drive.end(), to.begin());
            return;
        }
        for (std::size_t i = 0; i < to.size(); ++i)
            to[i] = drive[i] + (1.0f - gain.next()) * to[i];
    }

    /// The mean of all channels in the first.
    static void fold(std::span<const std::span<float>> main, GainRamp gain) noexcept
    {
        const float share = 1.0f / static_cast<float>(main.size());
        for (std::size_t i = 0; i < main[0].size(); ++i)
        {
            float sum = 0.0f;
            for (const auto& channel : main)
                sum += channel[i];
            main[0][i] += gain.next() * (share * sum - main[0][i]);
        }
    }

    GainRamp active;
    OutputMode mode = OutputMode::separate;
    std::size_t chosen = 0, count = 1;
    bool begun = false;
};

} // namespace pacini::plugin
