#pragma once

// Loudness of a sound over time, and the share of it above the range of touch.

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/OnsetFrame.h>
#include <pacini/foundation/Powers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

/// Loudness around one moment, in an arbitrary unit: only ratios are meaningful.
struct HeardFrame
{
    float loudness = 0.0f;  ///< of all that is heard
    float high = 0.0f;      ///< of the part above 900 Hz
    float bright = 0.0f;    ///< the same, weighted by frequency: 0 at 900 to 1800 Hz, 1 above 3600 Hz
    float power = 0.0f;     ///< mean square of the sound, A-weighted
    float highPower = 0.0f; ///< the same of the part above 900 Hz
};

/// Estimates the course of loudness from the powers that onsets are found in, so that it costs no filters of its own.
/// Loudness is the sum of the powers of seven bands to .3 each (S. Stevens, "On the psychophysical law", 1957),
/// A-weighted (IEC 61672-1) and by their widths in critical bands, then the memory of ISO 532-1:2017, 6.5. Masking,
/// threshold and the decay of that standard are left out: they hardly change the course. Allocates.
class HeardLevel
{
public:
    /// The next frames.
    void push(std::span<const OnsetFrame> frames)
    {
        for (const OnsetFrame& frame : frames)
        {
            recent.push_back(next(frame));
            while (windowEnd() <= received())
                emit();
        }
    }

    /// One value for each BandAnalysisResult::envelopeStep from 0 on: those that are complete and not yet dropped.
    [[nodiscard]] std::span<const HeardFrame> found() const noexcept { return values; }

    /// Forgets the first `count` of found().
    void drop(std::size_t count)
    {
        values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
        dropped += static_cast<std::int64_t>(count);
    }

    /// Completes found() to `count` values in all, more than were dropped; after the last frame comes nothing. None for
    /// a sound without frames.
    void finish(std::int64_t count)
    {
        if (received() == 0)
            return;
        while (dropped + std::ssize(values) < count)
            emit();
        values.resize(static_cast<std::size_t>(count - dropped));
    }

private:
    static constexpr std::size_t valueCount = 5;
    using Values = std::array<double, valueCount>;

    /// Smoothing by 3.5 and 70 ms.
    struct Memory
    {
        double fast = 0.0;
        double slow = 0.0;

        double next(double value) noexcept
        {
            fast += fastShare * (value - fast);
            slow += slowShare * (value - slow);
            return 0.47 * fast + 0.53 * slow;
        }
        static inline const double fastShare = -std::expm1(-1.0 / (0.0035 * OnsetFrame::rate));
        static inline const double slowShare = -std::expm1(-1.0 / (0.070 * OnsetFrame::rate));
    };

    struct EarBand
    {
        double weight;   ///< of the power, A-weighting at the centres of the bands: -27, -13, -6, -2, 1, 1 and 0 dB
        double critical; ///< critical bands
    };
    static constexpr std::array<EarBand, OnsetFrame::bandCount> ear{
        {{0.0018, 1.0}, {0.05, 1.2}, {0.24, 2.2}, {0.67, 3.5}, {1.17, 4.5}, {1.35, 4.3}, {0.93, 7.0}}};
    static constexpr std::size_t firstHigh = 4; // of them: from 900 Hz on
    static constexpr double exponent = 0.3;

    /// What the widths of the bands add to their loudness.
    [[nodiscard]] static std::array<double, ear.size()> widthFactors()
    {
        std::array<double, ear.size()> factors;
        std::transform(ear.begin(), ear.end(), factors.begin(),
                       [](const EarBand& band) { return std::pow(band.critical, 1.0 - exponent); });
        return factors;
    }

    Values next(const OnsetFrame& frame) noexcept
    {
        std::array<double, ear.size() + 1> parts{}; // an even number
        double total = 0.0;
        double highPower = 0.0;
        for (std::size_t b = 0; b < ear.size(); ++b)
        {
            const double power = std::max(0.0, ear[b].weight * static_cast<double>(frame.bands[b]));
            parts[b] = power;
            total += power;
            highPower += b < firstHigh ? 0.0 : power;
        }
        raiseAll(parts, exponent);
        double loudness = 0.0;
        double high = 0.0;
        double bright = 0.0;
        for (std::size_t b = 0; b < ear.size(); ++b)
        {
            const double part = widths[b] * parts[b];
            loudness += part;
            if (b < firstHigh)
                continue;
            high += part;
            bright += part * 0.5 * static_cast<double>(b - firstHigh);
        }
        return {memory[0].next(loudness), memory[1].next(high), memory[2].next(bright), total, highPower};
    }

    /// The memory makes loudness late by this; frames.
    static constexpr double delay = 2.5;
    static constexpr double reach = BandAnalysisResult::envelopeStep * OnsetFrame::rate; // half the window
    static constexpr auto windowSize = static_cast<std::size_t>(4.0 * reach) + 3;

    /// Frames so far.
    [[nodiscard]] std::int64_t received() const noexcept { return start + std::ssize(recent); }

    [[nodiscard]] double centre() const noexcept
    {
        return reach * static_cast<double>(dropped + std::ssize(values)) + delay;
    }
    /// The first frame after the window of the coming value.
    [[nodiscard]] std::int64_t windowEnd() const noexcept
    {
        return static_cast<std::int64_t>(std::ceil(centre() + reach));
    }

    /// The mean under a Hann window of 10 ms.
    void emit()
    {
        const double middle = centre();
        const auto first = static_cast<std::int64_t>(std::max(0.0, std::floor(middle - reach)));
        const std::int64_t end = std::min(windowEnd(), received());
        Values sum{};
        double total = 0.0;
        for (std::int64_t k = std::max(first, start); k < end; ++k)
        {
            const double w = window[static_cast<std::size_t>(2.0 * (static_cast<double>(k) + 0.5 - middle + reach))];
            total += w;
            for (std::size_t v = 0; v < valueCount; ++v)
                sum[v] += w * recent[static_cast<std::size_t>(k - start)][v];
        }
        HeardFrame frame;
        if (total > 0.0)
            frame = {static_cast<float>(sum[0] / total), static_cast<float>(sum[1] / total),
                     static_cast<float>(sum[2] / total), static_cast<float>(sum[3] / total),
                     static_cast<float>(sum[4] / total)};
        values.push_back(frame);
        const std::int64_t unused = std::clamp<std::int64_t>(first - start, 0, std::ssize(recent));
        if (unused < 4096)
            return;
        recent.erase(recent.begin(), recent.begin() + static_cast<std::ptrdiff_t>(unused));
        start += unused;
    }

    /// The Hann window at every half of a frame, where the centres of frames lie: `reach` and `delay` are multiples of
    /// that.
    [[nodiscard]] static std::array<double, windowSize> hann()
    {
        std::array<double, windowSize> weights{};
        for (std::size_t i = 0; i < weights.size(); ++i)
        {
            const double u = (0.5 * static_cast<double>(i) - reach) / reach;
            weights[i] = std::abs(u) < 1.0 ? 0.5 + 0.5 * std::cos(std::numbers::pi * u) : 0.0;
        }
        return weights;
    }

    std::array<double, ear.size()> widths = widthFactors();
    std::array<double, windowSize> window = hann();
    std::array<Memory, 3> memory{}; // of the first values
    std::vector<Values> recent;     // frames from number `start` on
    std::int64_t start = 0;
    std::vector<HeardFrame> values; // from number `dropped` on
    std::int64_t dropped = 0;
};

} // namespace pacini
