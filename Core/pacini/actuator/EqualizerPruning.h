#pragma once

// Pruning of equalizer sections: leaves out those that change nothing that is felt.

#include <pacini/actuator/Equalizer.h>
#include <pacini/foundation/FixedVector.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

namespace pacini
{

/// Report of pruning: a section that was left out.
struct DroppedSection
{
    std::size_t index = 0;  ///< in the equaliser as it was
    double deviation = 0.0; ///< dB, the farthest that its own response is from flat in the range
    bool operator==(const DroppedSection&) const = default;
};

/// Result of pruning.
struct PrunedEqualizer
{
    EqualizerSections kept;
    FixedVector<DroppedSection, EqualizerSections::capacity()> dropped;
    double predictedError = 0.0; ///< dB, the farthest that the equaliser without them is from the one with them
};

/// Parameters of pruning: the range to check, and the largest deviation from flat of a section that is dropped.
struct PruningParams
{
    Hertz lowFrequency{20.0};
    Hertz highFrequency{1000.0}; ///< at most 0.49 of the sample rate counts
    Decibels tolerance{0.1};
};

namespace detail
{

/// The largest magnitude in dB, from low to high Hz, of the response of the sections of `equalizer` in `indices`.
/// A logarithmic grid finds the hills, golden-section search (J. Kiefer, 1953) the top of the highest; the sections'
/// own frequencies are on the grid too, where narrow peaks would slip through it.
template <typename Indices>
[[nodiscard]] double largestDeviation(const EqualizerSections& equalizer, const Indices& indices, double low,
                                      double high, double fs) noexcept
{
    EqualizerSections sections;
    for (const std::size_t i : indices)
        sections.pushBack(equalizer[i]);
    const BiquadCascadeCoefficients filter = designEqualizer(sections, fs);
    const auto at = [&](double octaves)
    {
        return std::abs(Decibels::fromGain(std::abs(filter.response(Hertz(std::exp2(octaves)), fs))).value);
    };

    constexpr int points = 800;
    const double from = std::log2(low);
    const double step = (std::log2(high) - from) / points;
    double best = from;
    double largest = at(from);
    const auto look = [&](double octaves)
    {
        if (const double deviation = at(octaves); deviation > largest)
        {
            best = octaves;
            largest = deviation;
        }
    };
    for (int i = 1; i <= points; ++i)
        look(from + step * i);
    for (const EqualizerSection& section : sections)
        look(std::log2(std::clamp(section.frequency, low, high)));

    double left = std::max(best - step, from);
    double right = std::min(best + step, from + step * points);
    constexpr double golden = 0.6180339887498949;
    for (int i = 0; i < 30; ++i)
    {
        const double a = right - golden * (right - left);
        const double b = left + golden * (right - left);
        (at(a) < at(b) ? left : right) = at(a) < at(b) ? a : b;
    }
    return std::max(largest, at(0.5 * (left + right)));
}

} // namespace detail

/// Leaves out every section whose own response stays within the tolerance of flat over the range, at the sample rate
/// `fs`, and states the error: the errors of several may add up beyond the tolerance, or cancel. Sections that
/// designEqualizer() leaves out at this rate are among the dropped ones. Design time only: some thousand responses.
[[nodiscard]] inline PrunedEqualizer pruneEqualizer(const EqualizerSections& equalizer, const PruningParams& params,
                                                    double fs) noexcept
{
    const double high = std::min(params.highFrequency.value, 0.49 * fs);
    const double low = std::min(params.lowFrequency.value, high);
    PrunedEqualizer pruned;
    FixedVector<std::size_t, EqualizerSections::capacity()> dropped;
    for (std::size_t i = 0; i < equalizer.size(); ++i)
    {
        const double deviation = detail::largestDeviation(equalizer, std::array{i}, low, high, fs);
        if (deviation <= params.tolerance.value)
        {
            dropped.pushBack(i);
            pruned.dropped.pushBack({i, deviation});
        }
        else
            pruned.kept.pushBack(equalizer[i]);
    }
    if (!dropped.empty())
        pruned.predictedError = detail::largestDeviation(equalizer, dropped, low, high, fs);
    return pruned;
}

} // namespace pacini
