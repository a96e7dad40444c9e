// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Latency compensation: delays the sound by the latency of the haptic signal.

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini::plugin
{

/// Delays channels by a whole number of frames, bit by bit unchanged.
class MainDelay
{
public:
    /// Allocates; silence follows.
    void prepare(std::size_t channels, std::size_t delayFrames)
    {
        frames = delayFrames;
        lines.assign(channels, std::vector<float>(delayFrames, 0.0f));
        position = 0;
    }

    void reset() noexcept
    {
        for (auto& line : lines)
            std::fill(line.begin(), line.end(), 0.0f);
        position = 0;
    }

    /// Delays in place. Channels beyond the prepared ones stay unchanged. A line that is exactly as long as the delay
    /// swaps its oldest samples for the newest.
    void process(std::span<const std::span<float>> channels) noexcept
    {
        if (channels.empty() || frames == 0)
            return;
        std::size_t end = position;
        for (std::size_t c = 0; c < std::min(channels.size(), lines.size()); ++c)
        {
            end = position;
            auto rest = channels[c];
            while (!rest.empty())
            {
                const std::size_t n = std::min(rest.size(), frames - end);
                std::swap_ranges(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(n),
                                 lines[c].begin() + static_cast<std::ptrdiff_t>(end));
                rest = rest.subspan(n);
                end = end + n == frames ? 0 : end + n;
            }
        }
        position = end;
    }

private:
    std::vector<std::vector<float>> lines;
    std::size_t frames = 0;
    std::size_t position = 0;
};

} // namespace pacini::plugin
