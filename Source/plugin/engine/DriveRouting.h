// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Output routing of the drive signal: haptic output, main output and bypass.

#include "plugin/engine/GainRamp.h"
#include "plugin/engine/ParameterTable.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace pacini::plugin
{

/// Writes the drive to the haptic output, all of its channels alike, and, as the output mode says, into the main
/// output. Bypass fades the drive out, and the sound in again, within 10 ms.
class DriveRouting
{
public:
    void prepare(double sampleRate) noexcept
    {
        active.prepare(sampleRate);
        begun = false;
    }
    void reset() noexcept { begun = false; }

    void aim(OutputMode wanted, std::size_t channelIndex, bool bypassed) noexcept
    {
        mode = wanted;
        chosen = channelIndex;
        if (begun)
            active.aim(bypassed ? 0.0f : 1.0f);
        else
            active.jump(bypassed ? 0.0f : 1.0f);
        begun = true;
    }

    /// `main` holds the sound, as late as the drive; all of one length. `drive` is scratch afterwards.
    void process(std::span<const std::span<float>> main, std::span<const std::span<float>> haptic,
                 std::span<float> drive) noexcept
    {
        if (active.atRest() && active.value() == 0.0f)
        {
            for (const auto& channel : haptic)
                std::fill(channel.begin(), channel.end(), 0.0f);
            return;
        }
        GainRamp gain = active;
        if (!active.atRest())
            for (float& sample : drive)
                sample *= active.next();
        for (const auto& channel : haptic)
            std::copy(drive.begin(), drive.end(), channel.begin());
        switch (mode)
        {
        case OutputMode::separate:
            break;
        case OutputMode::replaceMain:
            for (const auto& channel : main)
                put(channel, drive, gain);
            break;
        case OutputMode::monoAndHaptic:
            if (main.size() >= 2)
                fold(main, gain);
            [[fallthrough]];
        case OutputMode::rightHaptic:
            if (main.size() >= 2)
                put(main[1], drive, gain);
            break;
        case OutputMode::addToChannel:
            if (chosen < main.size())
                for (std::size_t i = 0; i < drive.size(); ++i)
                    main[chosen][i] += drive[i];
            break;
        }
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
    std::size_t chosen = 0;
    bool begun = false;
};

} // namespace pacini::plugin
