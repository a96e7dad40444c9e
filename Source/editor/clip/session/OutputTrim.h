// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Level and delay trim of one output, so that what is heard and what is felt meet in time and strength.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini::editor
{

/// Up to two channels. A new level or delay is reached within 10 ms, delays by a cross-fade, so neither clicks.
class OutputTrim
{
public:
    static constexpr double longestDelay = 0.5; ///< s
    static constexpr std::size_t maxChannels = 2;

    /// Linear, 0 to 4. [any]
    void setLevel(double wanted) noexcept { level.store(std::clamp(wanted, 0.0, 4.0), std::memory_order_relaxed); }
    [[nodiscard]] double levelNow() const noexcept { return level.load(std::memory_order_relaxed); }
    /// s, 0 to `longestDelay`. [any]
    void setDelay(double wanted) noexcept
    {
        delay.store(std::clamp(wanted, 0.0, longestDelay), std::memory_order_relaxed);
    }
    [[nodiscard]] double delayNow() const noexcept { return delay.load(std::memory_order_relaxed); }

    /// Silence follows. While process() is not called. Allocates.
    void prepare(double sampleRate)
    {
        fs = sampleRate;
        const auto frames = static_cast<std::size_t>(std::ceil(longestDelay * fs)) + 1;
        for (auto& line : lines)
            line.assign(frames, 0.0f);
        position = 0;
        gain = level.load(std::memory_order_relaxed);
        now = next = framesOfDelay();
        faded = 1.0;
    }

    /// In place, after prepare(). [audio]
    void process(std::span<const std::span<float>> channels) noexcept
    {
        if (channels.empty())
            return;
        const double wanted = level.load(std::memory_order_relaxed);
        const double step = 1.0 / (0.010 * fs);
        if (faded >= 1.0)
        {
            now = next;
            next = framesOfDelay();
            faded = now == next ? 1.0 : 0.0;
        }
        const std::size_t size = lines[0].size();
        for (std::size_t i = 0; i < channels[0].size(); ++i)
        {
            gain += std::clamp(wanted - gain, -step, step);
            faded = std::min(1.0, faded + step);
            for (std::size_t c = 0; c < std::min(channels.size(), maxChannels); ++c)
            {
                lines[c][position] = channels[c][i];
                const auto old = static_cast<double>(lines[c][(position + size - now) % size]);
                const auto fresh = static_cast<double>(lines[c][(position + size - next) % size]);
                channels[c][i] = static_cast<float>(gain * (faded < 1.0 ? old + faded * (fresh - old) : fresh));
            }
            position = position + 1 == size ? 0 : position + 1;
        }
    }

private:
    [[nodiscard]] std::size_t framesOfDelay() const noexcept
    {
        const auto frames = static_cast<std::size_t>(std::lround(delay.load(std::memory_order_relaxed) * fs));
        return std::min(frames, lines[0].size() - 1);
    }

    std::atomic<double> level{1.0}, delay{0.0};
    double fs = 48000.0;
    std::vector<float> lines[maxChannels];
    std::size_t position = 0;
    double gain = 1.0;
    std::size_t now = 0, next = 0; ///< frames of delay; `faded` goes from one to the other
    double faded = 1.0;
};

} // namespace pacini::editor
