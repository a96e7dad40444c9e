#pragma once

// What is heard of a sound above the range of touch, and its way into the bands of the skin.

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/OnsetFrame.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

/// Loudness around one moment, in a unit of its own: only ratios mean anything.
struct HeardFrame
{
    float loudness = 0.0f; ///< of all that is heard
    float high = 0.0f;     ///< of what lies above 900 Hz
    float bright = 0.0f;   ///< of that, weighted by where it lies: 0 at 900 to 1800 Hz, 1 above 3600 Hz
    float power = 0.0f;    ///< mean square of the sound
};

/// Estimates the course of loudness from the powers that onsets are found in, so that it costs no filters of its own.
/// Loudness is the sum of the powers of seven bands to .3 each (S. Stevens, "On the psychophysical law", 1957),
/// weighted like an ear hears (ISO 226) and by their widths in critical bands, then the memory of ISO 532-1:2017, 6.5.
/// Masking, threshold and the decay of that standard are left out: they hardly change the course. Allocates.
class HeardLevel
{
public:
    /// The next frames.
    void push(std::span<const OnsetFrame> frames)
    {
        for (const OnsetFrame& frame : frames)
        {
            recent.push_back(next(frame));
            while (windowEnd() <= start + recent.size())
                emit();
        }
    }

    /// One value for each BandAnalysisResult::envelopeStep from 0 on, `count` in all; after the last frame comes
    /// nothing. Empty for a sound without frames.
    [[nodiscard]] std::vector<HeardFrame> finish(std::size_t count)
    {
        if (start + recent.size() == 0)
            return {};
        while (found.size() < count)
            emit();
        found.resize(count);
        return std::move(found);
    }

private:
    static constexpr std::size_t values = 4;
    using Values = std::array<double, values>;

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
        double weight;   ///< of the power: -22, -8, -2, 0, 0, 2 and -1 dB
        double critical; ///< critical bands
    };
    static constexpr std::array<EarBand, OnsetFrame::bandCount> ear{
        {{0.0063, 1.0}, {0.158, 1.2}, {0.63, 2.2}, {1.0, 3.5}, {1.0, 4.5}, {1.58, 4.3}, {0.79, 7.0}}};
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
        double loudness = 0.0;
        double high = 0.0;
        double bright = 0.0;
        for (std::size_t b = 0; b < ear.size(); ++b)
        {
            const double power = std::max(0.0, ear[b].weight * static_cast<double>(frame.bands[b]));
            const double part = widths[b] * std::pow(power, exponent);
            loudness += part;
            if (b < firstHigh)
                continue;
            high += part;
            bright += part * 0.5 * static_cast<double>(b - firstHigh);
        }
        return {memory[0].next(loudness), memory[1].next(high), memory[2].next(bright),
                static_cast<double>(frame.power)};
    }

    /// The memory makes loudness late by this; frames.
    static constexpr double delay = 4.0;
    static constexpr double reach = BandAnalysisResult::envelopeStep * OnsetFrame::rate; // half the window

    [[nodiscard]] double centre() const noexcept { return reach * static_cast<double>(found.size()) + delay; }
    /// The first frame after the window of the coming value.
    [[nodiscard]] std::size_t windowEnd() const noexcept
    {
        return static_cast<std::size_t>(std::ceil(centre() + reach));
    }

    /// The mean under a Hann window of 10 ms.
    void emit()
    {
        const double middle = centre();
        const auto first = static_cast<std::size_t>(std::max(0.0, std::floor(middle - reach)));
        const std::size_t end = std::min(windowEnd(), start + recent.size());
        Values sum{};
        double total = 0.0;
        for (std::size_t k = std::max(first, start); k < end; ++k)
        {
            const double u = (static_cast<double>(k) + 0.5 - middle) / reach;
            const double w = std::abs(u) < 1.0 ? 0.5 + 0.5 * std::cos(std::numbers::pi * u) : 0.0;
            total += w;
            for (std::size_t v = 0; v < values; ++v)
                sum[v] += w * recent[k - start][v];
        }
        HeardFrame frame;
        if (total > 0.0)
            frame = {static_cast<float>(sum[0] / total), static_cast<float>(sum[1] / total),
                     static_cast<float>(sum[2] / total), static_cast<float>(sum[3] / total)};
        found.push_back(frame);
        const std::size_t unused = std::min(first > start ? first - start : 0, recent.size());
        if (unused < 4096)
            return;
        recent.erase(recent.begin(), recent.begin() + static_cast<std::ptrdiff_t>(unused));
        start += unused;
    }

    std::array<double, ear.size()> widths = widthFactors();
    std::array<Memory, values - 1> memory{};
    std::vector<Values> recent; // frames from number `start` on
    std::size_t start = 0;
    std::vector<HeardFrame> found;
};

/// Lets what is heard above the range of touch be felt. Where most of the loudness lies above 900 Hz, the level of the
/// bands gives way to the course of the loudness, on a tone of 150 to 290 Hz, the brighter the higher, as if the sound
/// had it; where little does, nothing changes. `heard` has a value for each one of `found.envelope`; `audible` 0 to 1
/// is how far that goes. The peak follows. The limits of the blend and the range of the tone are choices, not derived.
class AudibleBlend
{
public:
    AudibleBlend(std::span<const BandEdges> edges, double audible)
        : fades(edges, BandAnalysisParams{}.overlap), bands(edges.begin(), edges.end()), most(audible)
    {
    }

    void apply(BandAnalysisResult& found, std::span<const HeardFrame> heard)
    {
        const std::size_t frames = std::min(found.envelope.size(), heard.size());
        double loudest = 0.0;
        for (const HeardFrame& frame : heard)
            loudest = std::max(loudest, static_cast<double>(frame.loudness));
        if (!(loudest > 0.0))
            return;
        findShares(heard.first(frames), loudest);
        double peak = found.peak;
        for (std::size_t i = 0; i < frames; ++i)
            peak = std::max(peak, share[i] * std::sqrt(2.0 * static_cast<double>(std::max(0.0f, heard[i].power))));
        level.resize(frames);
        for (std::size_t i = 0; i < frames; ++i)
        {
            level[i] = share[i] * peak * static_cast<double>(heard[i].loudness) / loudest;
            found.envelope[i] =
                static_cast<float>((1.0 - share[i]) * static_cast<double>(found.envelope[i]) + level[i]);
        }
        for (std::size_t j = 0; j < found.tracks.front().amplitude.size(); ++j)
            addTone(found, heard.first(frames), j);
        found.peak = peak;
    }

private:
    /// How far the loudness takes over at each moment, by where it lies within some 200 ms.
    void findShares(std::span<const HeardFrame> heard, double loudest)
    {
        constexpr std::ptrdiff_t reach = 40; // values of 5 ms
        constexpr double none = 0.3;
        constexpr double all = 0.7;
        const auto count = std::ssize(heard);
        std::array<double, 2 * reach + 1> window{};
        for (std::ptrdiff_t k = -reach; k <= reach; ++k)
            window[static_cast<std::size_t>(k + reach)] =
                0.5 + 0.5 * std::cos(std::numbers::pi * static_cast<double>(k) / (reach + 1));
        share.assign(heard.size(), 0.0);
        for (std::ptrdiff_t i = 0; i < count; ++i)
        {
            double high = 0.0;
            double total = 1e-12 * loudest;
            for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, i - reach); k < std::min(count, i + reach + 1); ++k)
            {
                const double w = window[static_cast<std::size_t>(k - i + reach)];
                high += w * static_cast<double>(heard[static_cast<std::size_t>(k)].high);
                total += w * static_cast<double>(heard[static_cast<std::size_t>(k)].loudness);
            }
            const double u = std::clamp((high / total - none) / (all - none), 0.0, 1.0);
            share[static_cast<std::size_t>(i)] = most * u * u * (3.0 - 2.0 * u);
        }
    }

    /// The tone in frame `j` of the bands, which lasts eight values of the envelope.
    void addTone(BandAnalysisResult& found, std::span<const HeardFrame> heard, std::size_t j)
    {
        constexpr auto ratio =
            static_cast<std::ptrdiff_t>(BandAnalysisResult::bandStep / BandAnalysisResult::envelopeStep + 0.5);
        const auto middle = static_cast<std::ptrdiff_t>(j) * ratio;
        double weights = 0.0;
        double power = 0.0;
        double taken = 0.0;
        double high = 0.0;
        double bright = 0.0;
        for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, middle - ratio + 1);
             k < std::min(std::ssize(heard), middle + ratio); ++k)
        {
            const auto i = static_cast<std::size_t>(k);
            const double w = 0.5 + 0.5 * std::cos(std::numbers::pi * static_cast<double>(k - middle) / ratio);
            weights += w;
            power += w * level[i] * level[i];
            taken += w * share[i];
            high += w * static_cast<double>(heard[i].high);
            bright += w * static_cast<double>(heard[i].bright);
        }
        if (!(weights > 0.0 && taken > 0.0 && high > 0.0))
            return;
        power /= weights;
        const double kept = 1.0 - taken / weights;
        const double wanted = lowest * std::pow(highest / lowest, bright / high);
        const double frequency = std::clamp(wanted, bands.front().low, bands.back().high);
        for (std::size_t k = 0; k < found.tracks.size(); ++k)
        {
            auto& track = found.tracks[k];
            const double old = kept * static_cast<double>(track.amplitude[j]);
            const double part = fades.weight(k, k, frequency);
            const double added = part * part * power;
            const double sum = old * old + added;
            if (sum > 0.0)
                track.frequency[j] =
                    static_cast<float>((old * old * static_cast<double>(track.frequency[j]) + added * frequency) / sum);
            track.amplitude[j] = static_cast<float>(std::sqrt(sum));
        }
    }

    static constexpr double lowest = 150.0;  // Hz
    static constexpr double highest = 290.0; // Hz

    BandFades fades;
    std::vector<BandEdges> bands;
    double most;
    std::vector<double> share, level; // of each value of the envelope
};

} // namespace pacini
