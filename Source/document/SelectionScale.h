#pragma once

// Scaling of a selection in time and in level.

#include "document/SelectionEdits.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace pacini
{

struct SelectionScale
{
    double pivot = 0.0;      ///< s: stays
    double timeFactor = 1.0; ///< of distances from the pivot, above 0; limited so that the selection stays in the clip
    double spread = 1.0; ///< of distances in dB (octaves for Hz) from the mean of what is selected of a lane, from 0
};

namespace detail
{
/// The time factor for which nothing between `range`'s ends leaves the clip.
[[nodiscard]] inline double factorInside(TimeRange range, double pivot, double factor, double duration)
{
    if (!std::isfinite(factor) || factor <= 0.0)
        return 1.0;
    double limited = factor;
    if (range.to > pivot)
        limited = std::min(limited, (duration - pivot) / (range.to - pivot));
    if (range.from < pivot)
        limited = std::min(limited, pivot / (pivot - range.from));
    return std::max(limited, 1e-6);
}

/// The geometric mean of values above 0, or 0 when there are none.
[[nodiscard]] inline double meanLevel(const std::vector<double>& values)
{
    double sum = 0.0;
    std::size_t count = 0;
    for (double value : values)
        if (value > 0.0)
        {
            sum += std::log(value);
            ++count;
        }
    return count > 0 ? std::exp(sum / static_cast<double>(count)) : 0.0;
}

[[nodiscard]] inline double spreadValue(double value, double mean, double spread)
{
    return value > 0.0 && mean > 0.0 ? mean * std::pow(value / mean, spread) : value;
}
} // namespace detail

/// Scales what is selected of all lanes about one pivot. Silence stays silent, sharpness stays.
[[nodiscard]] inline EditedClip scaleSelected(Clip clip, const Selection& wanted, const SelectionScale& scale)
{
    const Selection selection = withinClip(wanted, clip);
    EditedClip result{std::move(clip), {}};
    const auto range = timeOf(selection, result.clip);
    if (!range || !std::isfinite(scale.spread) || !std::isfinite(scale.pivot))
        return {std::move(result.clip), selection};
    const double pivot = clampTo(scale.pivot, 0.0, result.clip.duration);
    const double factor = detail::factorInside(*range, pivot, scale.timeFactor, result.clip.duration);
    const double spread = std::max(0.0, scale.spread);
    const auto moved = [&](double time)
    {
        return factor == 1.0 ? time : pivot + factor * (time - pivot);
    };
    for (const LaneSelection& part : selection.lanes)
    {
        Curve& curve = *curveOf(result.clip, part.lane);
        const CurveLimits limits = limitsOf(result.clip, part.lane);
        std::vector<double> values;
        for (std::size_t i : part.points)
            values.push_back(curve[i].value);
        const double mean = detail::meanLevel(values);
        Curve scaled = curve;
        for (std::size_t i : part.points)
            scaled[i] = detail::limitedPoint(
                {moved(curve[i].time),
                 spread == 1.0 ? curve[i].value : detail::spreadValue(curve[i].value, mean, spread)},
                limits);
        EditedCurve ordered = detail::inOrder(std::move(scaled), part.points);
        curve = std::move(ordered.curve);
        result.selection.lanes.push_back({part.lane, std::move(ordered.selection)});
    }
    std::vector<double> levels;
    for (std::size_t i : selection.transients)
        levels.push_back(result.clip.transients[i].amplitude);
    const double mean = detail::meanLevel(levels);
    for (std::size_t i : selection.transients)
    {
        Transient& event = result.clip.transients[i];
        const double level = spread == 1.0 ? event.amplitude : detail::spreadValue(event.amplitude, mean, spread);
        event = detail::limitedTransient({moved(event.time), level, event.sharpness}, result.clip.duration);
    }
    result.selection.transients = detail::sortTransients(result.clip.transients, selection.transients);
    return result;
}

} // namespace pacini
