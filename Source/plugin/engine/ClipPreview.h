// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Preview of the clip that is edited in the plugin's window, played instead of the live drive.

#include "document/HostedProject.h"

#include <pacini/foundation/Fade.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace pacini::plugin
{

/// The live drives fade out and in again within 10 ms; the sound of the clip is added to the main output, its drive to
/// the first one. Other actuators rest meanwhile: the clip is made for the one that its editor shows.
class ClipPreview
{
public:
    static constexpr std::size_t pieceFrames = 512;

    void prepare(double sampleRate) noexcept
    {
        share.prepare(static_cast<std::size_t>(0.010 * sampleRate));
        share.jump(0.0);
    }

    /// Fetches the clips' output for the next `frames`, at most `pieceFrames`. Returns false if they rest and process()
    /// would change nothing. [audio]
    [[nodiscard]] bool take(HostedProject& clips, std::size_t frames) noexcept
    {
        const std::array<std::span<float>, 2> beside{std::span(left).first(frames), std::span(right).first(frames)};
        plays = clips.process(std::span(haptic).first(frames), beside);
        share.aim(plays ? 1.0 : 0.0);
        return plays || !share.resting();
    }

    /// Mixes the output that take() fetched; all of that length. [audio]
    void process(std::span<float> drive, std::span<const std::span<float>> others,
                 std::span<const std::span<float>> main) noexcept
    {
        const std::array<std::span<float>, 2> beside{std::span(left).first(drive.size()),
                                                     std::span(right).first(drive.size())};
        const auto signal = std::span(haptic).first(drive.size());
        if (!plays && share.resting())
            return;
        if (plays)
            for (std::size_t c = 0; c < main.size(); ++c)
                std::transform(main[c].begin(), main[c].end(), beside[c % 2].begin(), main[c].begin(), std::plus<>());
        else
            std::fill(signal.begin(), signal.end(), 0.0f);
        for (const auto& other : others)
        {
            Fade fade = share;
            for (float& sample : other)
                sample *= static_cast<float>(1.0 - fade.next());
        }
        for (std::size_t i = 0; i < drive.size(); ++i)
            drive[i] = static_cast<float>(1.0 - share.next()) * drive[i] + signal[i];
    }

private:
    Fade share; ///< of the clip
    bool plays = false;
    std::array<float, pieceFrames> haptic{}, left{}, right{};
};

} // namespace pacini::plugin
