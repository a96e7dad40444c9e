#pragma once

// Edits of single breakpoints. Pure functions: a curve in, a curve out. Times are clamped to 0..duration and values to
// the lane's range, so that a valid curve stays valid whatever the arguments; numbers that are not finite change
// nothing; indices beyond the curve are ignored.

#include <pacini/clip/edits/CurveSection.h>
#include <pacini/clip/edits/Selection.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace pacini
{

/// Limits of a curve: laneRange() of its lane and the duration of its clip in seconds.
struct CurveLimits
{
    double duration = 0.0;
    ValueRange values;
};

[[nodiscard]] inline CurveLimits limitsOf(const Clip& clip, Lane lane) noexcept
{
    return {clip.duration, laneRange(lane.kind)};
}

/// A curve after an edit, with the indices of the edited points: the selected or the new ones.
struct EditedCurve
{
    Curve curve;
    Indices selection;
};

namespace detail
{
[[nodiscard]] inline Breakpoint limitedPoint(Breakpoint p, const CurveLimits& limits) noexcept
{
    return {clampTo(p.time, 0.0, limits.duration), clampTo(p.value, limits.values.low, limits.values.high)};
}

/// Puts points whose times have changed in order; points at one time keep theirs.
[[nodiscard]] inline EditedCurve inOrder(Curve curve, const Indices& selection)
{
    const auto earlier = [](const Breakpoint& a, const Breakpoint& b)
    {
        return a.time < b.time;
    };
    if (std::is_sorted(curve.begin(), curve.end(), earlier))
        return {std::move(curve), selection};
    Indices order = allIndices(curve.size());
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return curve[a].time < curve[b].time; });
    EditedCurve result;
    result.curve.reserve(curve.size());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
        result.curve.push_back(curve[order[i]]);
        if (std::binary_search(selection.begin(), selection.end(), order[i]))
            result.selection.push_back(i);
    }
    return result;
}

/// The indices of a selection that exist.
[[nodiscard]] inline Indices existing(const Indices& selection, std::size_t count)
{
    return {selection.begin(), std::lower_bound(selection.begin(), selection.end(), count)};
}
} // namespace detail

/// Adds one point; behind those that are already at its time.
[[nodiscard]] inline EditedCurve addPoint(const Curve& curve, Breakpoint point, const CurveLimits& limits)
{
    if (!std::isfinite(point.time) || !std::isfinite(point.value))
        return {curve, {}};
    const Breakpoint added = detail::limitedPoint(point, limits);
    EditedCurve result{curve, {}};
    const auto place = std::upper_bound(result.curve.begin(), result.curve.end(), added.time,
                                        [](double t, const Breakpoint& p) { return t < p.time; });
    result.selection = {static_cast<std::size_t>(place - result.curve.begin())};
    result.curve.insert(place, added);
    return result;
}

/// Removes points.
[[nodiscard]] inline Curve deletePoints(const Curve& curve, const Indices& selection)
{
    Curve result;
    result.reserve(curve.size());
    auto next = selection.begin();
    for (std::size_t i = 0; i < curve.size(); ++i)
    {
        if (next != selection.end() && *next == i)
            ++next;
        else
            result.push_back(curve[i]);
    }
    return result;
}

/// Movement of points: value becomes value * factor + offset (factor for dB and log views, offset for linear ones).
struct PointMove
{
    double time = 0.0; ///< s
    double offset = 0.0;
    double factor = 1.0; ///< 0 and above
};

/// Moves points together. The move in time is limited as a whole, so that the group keeps its shape at the clip's ends;
/// values are clamped one by one. Points may pass others.
[[nodiscard]] inline EditedCurve movePoints(const Curve& curve, const Indices& selection, const PointMove& move,
                                            const CurveLimits& limits)
{
    const Indices chosen = detail::existing(selection, curve.size());
    if (chosen.empty() || !std::isfinite(move.time) || !std::isfinite(move.offset) || !std::isfinite(move.factor))
        return {curve, chosen};
    const double shift =
        clampTo(move.time, -curve[chosen.front()].time, std::max(0.0, limits.duration - curve[chosen.back()].time));
    Curve moved = curve;
    for (std::size_t i : chosen)
        moved[i] = detail::limitedPoint(
            {curve[i].time + shift, curve[i].value * std::max(0.0, move.factor) + move.offset}, limits);
    return detail::inOrder(std::move(moved), chosen);
}

} // namespace pacini
