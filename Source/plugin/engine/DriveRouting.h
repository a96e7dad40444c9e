// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Output routing of the drive signal: haptic output, main output and bypass.

#include "plugin/engine/ParameterTable.h"

#include <pacini/foundation/Fade.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace pacini::plugin
{

/// Writes the drives to the haptic output and, by the output mode, into the main output: the drive of the first
/// channel, or all drives if they replace the sound. Bypass silences the drives. Every change of the routing is a
/// cross-fade of 10 ms.
class DriveRouting
{
public:
    /// For pieces of at most `pieceFrames` frames. Allocates.
    void prepare(double sampleRate, std::size_t mainChannels, std::size_t pieceFrames)
    {
        share.prepare(static_cast<std::size_t>(0.010 * sampleRate));
        curve.assign(pieceFrames, 0.0);
        past.assign(mainChannels, std::vector<float>(pieceFrames));
        reset();
    }
    void reset() noexcept { begun = false; }

    /// Sets the routing. In addToChannel, `count` drives are added to the channels from `channel` on.
    void aim(OutputMode mode, std::size_t channel, std::size_t count, bool bypassed) noexcept
    {
        const bool adds = mode == OutputMode::addToChannel;
        wanted = {mode, adds ? channel : 0, adds ? count : 1, !bypassed};
        if (!begun)
        {
            now = before = wanted;
            share.jump(1.0);
        }
        begun = true;
    }

    /// Returns the largest number of drives in the main output, now or during the next piece.
    [[nodiscard]] std::size_t drivesInMain(std::size_t mainChannels) const noexcept
    {
        return std::max({wanted.drives(mainChannels), now.drives(mainChannels), before.drives(mainChannels)});
    }

    /// `main` contains the sound, delayed like the drives. All spans have one length, with a drive for each of `haptic`
    /// and at least one. Afterwards `drives` contain the output: faded, and silent where none is played; the first
    /// `elsewhere` of them are played without a haptic channel too.
    void process(std::span<const std::span<float>> main, std::span<const std::span<float>> haptic,
                 std::span<const std::span<float>> drives, std::size_t elsewhere = 0) noexcept
    {
        if (share.resting())
        {
            before = now;
            if (wanted != now)
            {
                now = wanted;
                share.jump(0.0);
                share.aim(1.0);
            }
        }
        if (before == now)
            play(now, main, drives);
        else
            playFading(main, drives);
        for (std::size_t c = 0; c < haptic.size(); ++c)
            std::copy(drives[c].begin(), drives[c].end(), haptic[c].begin());
        for (std::size_t c = std::max(haptic.size(), elsewhere); c < drives.size(); ++c)
            if (!isInMain(c, main.size()))
                std::fill(drives[c].begin(), drives[c].end(), 0.0f);
    }

    /// Whether the main output has a drive.
    [[nodiscard]] bool isInMain(std::size_t drive, std::size_t mainChannels) const noexcept
    {
        return now.hasInMain(drive, mainChannels) || before.hasInMain(drive, mainChannels);
    }

private:
    struct Route
    {
        OutputMode mode = OutputMode::separate;
        std::size_t chosen = 0, count = 1;
        bool active = true; ///< not bypassed
        bool operator==(const Route&) const = default;

        [[nodiscard]] bool hasInMain(std::size_t drive, std::size_t mainChannels) const noexcept
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
        [[nodiscard]] std::size_t drives(std::size_t mainChannels) const noexcept
        {
            return mode == OutputMode::replaceMain ? mainChannels : count;
        }
    };

    static void play(const Route& route, std::span<const std::span<float>> main,
                     std::span<const std::span<float>> drives) noexcept
    {
        if (!route.active)
        {
            for (const auto& drive : drives)
                std::fill(drive.begin(), drive.end(), 0.0f);
            return;
        }
        putInMain(route, main, drives);
    }

    /// Cross-fades from `before` to `now`.
    void playFading(std::span<const std::span<float>> main, std::span<const std::span<float>> drives) noexcept
    {
        const std::size_t frames = drives[0].size();
        for (double& gain : std::span(curve).first(frames))
            gain = share.next();
        std::array<std::span<float>, 16> kept;
        const std::size_t channels = std::min({main.size(), past.size(), kept.size()});
        for (std::size_t c = 0; c < channels; ++c)
        {
            kept[c] = std::span(past[c]).first(frames);
            std::copy(main[c].begin(), main[c].end(), kept[c].begin());
        }
        if (before.active)
            putInMain(before, std::span(kept).first(channels), drives);
        if (now.active)
            putInMain(now, main, drives);
        for (std::size_t c = 0; c < channels; ++c)
            for (std::size_t i = 0; i < frames; ++i)
                main[c][i] = mixed(kept[c][i], main[c][i], curve[i]);
        if (before.active != now.active)
            for (const auto& drive : drives)
                for (std::size_t i = 0; i < frames; ++i)
                    drive[i] = mixed(before.active ? drive[i] : 0.0f, now.active ? drive[i] : 0.0f, curve[i]);
        else if (!now.active)
            play(now, main, drives);
    }

    [[nodiscard]] static float mixed(float from, float to, double share) noexcept
    {
        return static_cast<float>((1.0 - share) * static_cast<double>(from) + share * static_cast<double>(to));
    }

    static void putInMain(const Route& route, std::span<const std::span<float>> main,
                          std::span<const std::span<float>> drives) noexcept
    {
        const auto first = drives[0];
        switch (route.mode)
        {
        case OutputMode::separate:
            break;
        case OutputMode::replaceMain:
            for (std::size_t c = 0; c < main.size(); ++c)
            {
                const auto drive = c < drives.size() ? drives[c] : first;
                std::copy(drive.begin(), drive.end(), main[c].begin());
            }
            break;
        case OutputMode::monoAndHaptic:
            if (main.size() >= 2)
                fold(main);
            [[fallthrough]];
        case OutputMode::rightHaptic:
            if (main.size() >= 2)
                std::copy(first.begin(), first.end(), main[1].begin());
            break;
        case OutputMode::addToChannel:
            for (std::size_t c = 0; c < std::min(route.count, drives.size()) && route.chosen + c < main.size(); ++c)
            {
                const auto to = main[route.chosen + c];
                std::transform(drives[c].begin(), drives[c].end(), to.begin(), to.begin(), std::plus<>());
            }
            break;
        }
    }

    /// The mean of all channels in the first.
    static void fold(std::span<const std::span<float>> main) noexcept
    {
        const float part = 1.0f / static_cast<float>(main.size());
        for (std::size_t i = 0; i < main[0].size(); ++i)
        {
            float sum = 0.0f;
            for (const auto& channel : main)
                sum += channel[i];
            main[0][i] = part * sum;
        }
    }

    Route wanted, now, before;
    Fade share; ///< of `now`
    std::vector<double> curve;
    std::vector<std::vector<float>> past; ///< the main output as `before` makes it
    bool begun = false;
};

} // namespace pacini::plugin
