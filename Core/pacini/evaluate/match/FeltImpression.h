#pragma once

// Predicted impression of a vibration alone: strength, speed and roughness.

#include <pacini/evaluate/match/TouchTrack.h>
#include <pacini/evaluate/match/TrackStatistics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Figures of a vibration that ratings are predicted from. All 0 for silence.
struct FeltFigures
{
    double level = 0.0;       ///< natural logarithm of the root mean square strength, above 1e-3 of full drive
    double meanLevel = 0.0;   ///< natural logarithm of the mean strength, above 1e-3
    double octave = 0.0;      ///< mean felt frequency, octaves above 1 Hz
    double pulses = 0.0;      ///< per second: rises by at least 15 % of the largest (square root of) strength
    double fluctuation = 0.0; ///< natural logarithm of the depth of fluctuations at 20 to 100 Hz, above 1e-3
    bool operator==(const FeltFigures&) const = default;
};

namespace detail
{
/// Counts the rises of `x` by at least `least` above the valley before them, with a fall as large in between.
[[nodiscard]] inline std::size_t countPulses(std::span<const float> x, float least) noexcept
{
    std::size_t pulses = 0;
    bool rising = true;
    float extreme = 0.0f; // the valley while a rise is awaited, the peak while a fall is
    for (const float v : x)
    {
        if (rising ? v < extreme : v > extreme)
            extreme = v;
        if (!(rising ? v > extreme + least : v < extreme - least))
            continue;
        pulses += rising ? 1u : 0u;
        rising = !rising;
        extreme = v;
    }
    return pulses;
}
} // namespace detail

[[nodiscard]] inline FeltFigures feltFigures(const TouchTrack& felt)
{
    FeltFigures figures;
    double sum = 0.0;
    double squares = 0.0;
    std::vector<float> root;
    for (const float v : felt.strength)
    {
        sum += static_cast<double>(v);
        squares += static_cast<double>(v) * static_cast<double>(v);
        root.push_back(std::sqrt(v));
    }
    if (!(sum > 0.0))
        return figures;
    constexpr double least = 1e-3;
    const auto frames = static_cast<double>(root.size());
    figures.level = std::log(std::sqrt(squares / frames) + least);
    figures.meanLevel = std::log(sum / frames + least);

    double power = 0.0;
    double weighted = 0.0;
    for (std::size_t m = 0; m < felt.power.size(); ++m)
    {
        power += felt.power[m];
        weighted += felt.power[m] * felt.octave[m];
    }
    figures.octave = power > 0.0 ? weighted / power : 0.0;

    const auto course = detail::smoothed(root, detail::trackKernel(0.020));
    const float largest = *std::max_element(root.begin(), root.end());
    figures.pulses = static_cast<double>(detail::countPulses(course, 0.15f * largest)) / (frames / TouchTrack::rate);
    double depth = 0.0;
    for (const float v : detail::fluctuation(root))
        depth += static_cast<double>(v);
    figures.fluctuation = std::log(depth / frames + least);
    return figures;
}

/// Ratings from -3 (none) to 3 (very), as people gave them to 120 vibrations.
struct FeltImpression
{
    double strength = -3.0; ///< "energy"
    double tempo = -3.0;
    double roughness = -3.0;
};

/// The mean ratings that people would give the vibration, at the level that it has in `figures`. Fitted by ridge
/// regression to the ratings of VibViz (H. Seifi et al., "VibViz", 2015) by `Tests/human/fit_impression.py`.
[[nodiscard]] inline FeltImpression feltImpression(const FeltFigures& figures) noexcept
{
    if (figures == FeltFigures{})
        return {};
    const auto rating = [](double value)
    {
        return std::clamp(value, -3.0, 3.0);
    };
    return {rating(-5.08 + 1.80 * figures.level + 1.11 * figures.octave),
            rating(-4.01 + 0.254 * figures.pulses + 0.69 * figures.level + 0.70 * figures.octave),
            rating(-2.16 + 0.48 * figures.fluctuation + 0.755 * figures.octave + 0.66 * figures.meanLevel)};
}

} // namespace pacini
