#pragma once

// Edits of single breakpoints. Pure functions: a curve in, a curve out. Times are clamped to 0..duration and values to
// the lane's range, so that a valid curve stays valid whatever the arguments; numbers that are not finite change
// nothing; indices beyond the curve are ignored.

#include <pacini/clip/edits/CurveSection.h>
#include <pacini/clip/edits/Selection.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// What a curve may hold: laneRange() of its lane and the duration of its clip in seconds.
struct CurveLimits
{
    double duration = 0.0;
    ValueRange values;
};

[[nodiscard]] inline CurveLimits limitsOf(const Clip& clip, Lane lane) noexcept
{
    return {clip.duration, laneRange(lane.kind)};
}

/// A curve after an edit and where the edited points now are in it: those that were selected, or that are new.
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

/// How far points move: value becomes value * factor + offset (factor for dB and log views, offset for linear ones).
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

/// Distances from a pivot are multiplied; factors below 0 mirror.
struct PointScale
{
    double pivotTime = 0.0; ///< s
    double timeFactor = 1.0;
    double pivotValue = 0.0;
    double valueFactor = 1.0;
};

/// Scales points about a pivot; times and values are clamped one by one.
[[nodiscard]] inline EditedCurve scalePoints(const Curve& curve, const Indices& selection, const PointScale& scale,
                                             const CurveLimits& limits)
{
    const Indices chosen = detail::existing(selection, curve.size());
    if (!std::isfinite(scale.pivotTime) || !std::isfinite(scale.timeFactor) || !std::isfinite(scale.pivotValue) ||
        !std::isfinite(scale.valueFactor))
        return {curve, chosen};
    Curve scaled = curve;
    for (std::size_t i : chosen)
    {
        const Breakpoint& p = curve[i];
        const double time =
            scale.timeFactor == 1.0 ? p.time : scale.pivotTime + scale.timeFactor * (p.time - scale.pivotTime);
        const double value =
            scale.valueFactor == 1.0 ? p.value : scale.pivotValue + scale.valueFactor * (p.value - scale.pivotValue);
        scaled[i] = detail::limitedPoint({time, value}, limits);
    }
    return detail::inOrder(std::move(scaled), chosen);
}

/// Bows points: a parabola of `depth` (value units, either sign) in the middle and 0 at the ends of the selection's
/// time is added. Times stay.
[[nodiscard]] inline EditedCurve bendPoints(const Curve& curve, const Indices& selection, double depth,
                                            const CurveLimits& limits)
{
    const Indices chosen = detail::existing(selection, curve.size());
    if (chosen.empty() || !std::isfinite(depth))
        return {curve, chosen};
    const double start = curve[chosen.front()].time;
    const double length = curve[chosen.back()].time - start;
    EditedCurve result{curve, chosen};
    for (std::size_t i : chosen)
    {
        const double x = length > 0.0 ? (curve[i].time - start) / length : 0.5;
        result.curve[i].value = detail::limitedPoint({0.0, curve[i].value + depth * 4.0 * x * (1.0 - x)}, limits).value;
    }
    return result;
}

/// Draws by hand: what lies between the earliest and the latest point of `stroke` is replaced by it. The stroke is in
/// the order in which it was drawn; where it goes back in time, the later part counts. Points that are not finite are
/// left out.
[[nodiscard]] inline EditedCurve drawPoints(const Curve& curve, std::span<const Breakpoint> stroke,
                                            const CurveLimits& limits)
{
    Curve kept;
    double earliest = 0.0;
    double latest = 0.0;
    for (std::size_t i = stroke.size(); i-- > 0;)
    {
        if (!std::isfinite(stroke[i].time) || !std::isfinite(stroke[i].value))
            continue;
        const Breakpoint p = detail::limitedPoint(stroke[i], limits);
        if (!kept.empty() && p.time >= earliest && p.time <= latest)
            continue;
        earliest = kept.empty() ? p.time : std::min(earliest, p.time);
        latest = kept.empty() ? p.time : std::max(latest, p.time);
        kept.push_back(p);
    }
    if (kept.empty())
        return {curve, {}};
    std::sort(kept.begin(), kept.end(), [](const Breakpoint& a, const Breakpoint& b) { return a.time < b.time; });
    EditedCurve result{replaceSection(curve, {earliest, latest}, kept), {}};
    const auto first = std::lower_bound(result.curve.begin(), result.curve.end(), earliest,
                                        [](const Breakpoint& p, double t) { return p.time < t; });
    const auto start = static_cast<std::size_t>(first - result.curve.begin());
    for (std::size_t i = 0; i < kept.size(); ++i)
        result.selection.push_back(start + i);
    return result;
}

} // namespace pacini
