#pragma once

// Freehand drawing and bending of curves: a pointer's path on the screen becomes few breakpoints.

#include "document/view/TimeAxis.h"
#include "document/view/ValueAxis.h"

#include <pacini/clip/edits/PointEdits.h>
#include <pacini/simplify/DouglasPeucker.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// The path of a pointer as one height for each column of pixels; later parts overwrite earlier ones.
class Stroke
{
public:
    void begin(double x, double y)
    {
        heights.clear();
        lastX = std::round(x);
        lastY = y;
        heights[static_cast<int>(lastX)] = y;
    }

    /// A straight line from the last place.
    void to(double x, double y)
    {
        const double end = std::round(x);
        const double columns = std::abs(end - lastX);
        for (double k = 1.0; k <= columns; k += 1.0)
            heights[static_cast<int>(lastX + std::copysign(k, end - lastX))] = lastY + (y - lastY) * k / columns;
        heights[static_cast<int>(end)] = y;
        lastX = end;
        lastY = y;
    }

    /// Column -> height, pixels.
    [[nodiscard]] const std::map<int, double>& columns() const noexcept { return heights; }

private:
    std::map<int, double> heights;
    double lastX = 0.0, lastY = 0.0;
};

/// Few of a curve's points (ascending times), so that on the screen no other is more than `tolerance` pixels above or
/// below the new curve: Douglas and Peucker, "Algorithms for the reduction of the number of points required to
/// represent a digitized line" (1973), with distances straight up, as curves are functions of time.
[[nodiscard]] inline Curve fewPoints(const Curve& dense, const ValueAxis& axis, double tolerance)
{
    if (dense.size() < 3)
        return dense;
    const auto pixels = [&axis](std::span<const Breakpoint> curve, std::size_t first, std::size_t last)
    {
        const Breakpoint &a = curve[first], &b = curve[last];
        Deviation largest{0.0, first};
        for (std::size_t i = first + 1; i < last; ++i)
        {
            const double x = (curve[i].time - a.time) / (b.time - a.time);
            const double away = std::abs(axis.yOf(curve[i].value) - axis.yOf(a.value + x * (b.value - a.value)));
            if (away > largest.value)
                largest = {away, i};
        }
        return largest;
    };
    return curveOf(dense, splitWorst(dense, {0, dense.size() - 1}, dense.size(), tolerance, pixels));
}

/// A stroke as points within a pixel of it. x = 0, y = 0 is the upper left corner of the lane; what is above or below
/// counts as its edge.
[[nodiscard]] inline Curve pointsOf(const Stroke& stroke, const TimeAxis& time, const ValueAxis& values,
                                    const CurveLimits& limits)
{
    constexpr double tolerance = 1.0; // pixel
    Curve dense;
    for (const auto& [x, y] : stroke.columns())
    {
        const double at = time.timeAt(x);
        if (at >= 0.0 && at <= limits.duration)
            dense.push_back(detail::limitedPoint({at, values.valueAtY(std::clamp(y, 0.0, values.height))}, limits));
    }
    return fewPoints(dense, values, tolerance);
}

/// Puts drawn points (ascending, at least one) in place of what was between the first and the last of them. The curve
/// beside them stays as it is: it steps to them. What was drawn at one time only is a point more.
[[nodiscard]] inline EditedCurve withDrawn(const Curve& curve, const Curve& drawn, const CurveLimits& limits)
{
    if (drawn.empty())
        return {curve, {}};
    const TimeRange range{drawn.front().time, drawn.back().time};
    if (range.from >= range.to)
        return addPoint(curve, drawn.front(), limits);
    Curve points;
    if (range.from > 0.0 && !curve.empty())
        appendPoint(points, {range.from, valueBefore(curve, range.from)});
    const std::size_t leading = points.size();
    for (const Breakpoint& p : drawn)
        appendPoint(points, p);
    const std::size_t end = points.size();
    if (range.to < limits.duration && !curve.empty())
        appendPoint(points, {range.to, valueAt(curve, range.to)});
    EditedCurve result{replaceSection(curve, range, points), {}};
    const auto first =
        static_cast<std::size_t>(std::lower_bound(result.curve.begin(), result.curve.end(), range.from,
                                                  [](const Breakpoint& p, double t) { return p.time < t; }) -
                                 result.curve.begin());
    for (std::size_t i = points[0] == drawn.front() ? 0 : leading; i < end; ++i)
        result.selection.push_back(first + i);
    return result;
}

/// Bends the line behind point `first` so that its place at the time `grabbed` moves by `dy` pixels (down is positive)
/// and the ends stay: a parabola on the screen, as few points within half a pixel. Nothing happens to a line of under
/// two pixels, nor without a point behind `first`.
[[nodiscard]] inline EditedCurve bentLine(const Curve& curve, std::size_t first, double grabbed, double dy,
                                          const TimeAxis& time, const ValueAxis& values, const CurveLimits& limits)
{
    constexpr double tolerance = 0.5; // pixels
    if (first + 1 >= curve.size() || !std::isfinite(dy))
        return {curve, {}};
    const Breakpoint a = curve[first];
    const Breakpoint b = curve[first + 1];
    const double pixels = (b.time - a.time) / time.secondsPerPixel;
    if (!(pixels >= 2.0))
        return {curve, {}};
    // Near an end a parabola through the pointer would fly away.
    const double x = clampTo((grabbed - a.time) / (b.time - a.time), 0.1, 0.9);
    const auto pieces = static_cast<std::size_t>(clampTo(std::ceil(pixels / 2.0), 8.0, 1000.0));
    Curve dense = {a};
    for (std::size_t k = 1; k < pieces; ++k)
    {
        const double t = static_cast<double>(k) / static_cast<double>(pieces);
        const double line = values.yOf(a.value + t * (b.value - a.value));
        const double y = std::clamp(line + dy * t * (1.0 - t) / (x * (1.0 - x)), 0.0, values.height);
        dense.push_back(detail::limitedPoint({a.time + t * (b.time - a.time), values.valueAtY(y)}, limits));
    }
    dense.push_back(b);
    const Curve few = fewPoints(dense, values, tolerance);
    EditedCurve result{curve, {}};
    result.curve.insert(result.curve.begin() + static_cast<std::ptrdiff_t>(first) + 1, few.begin() + 1, few.end() - 1);
    for (std::size_t i = 1; i + 1 < few.size(); ++i)
        result.selection.push_back(first + i);
    return result;
}

} // namespace pacini
