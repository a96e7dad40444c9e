#pragma once

// Hit test: the breakpoint or the line under the pointer.

#include "document/view/TimeAxis.h"
#include "document/view/ValueAxis.h"

#include <pacini/clip/Curve.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

namespace pacini
{

/// The point of a curve nearest to (x, y), at most `radius` pixels away; of equally near ones the later, which is drawn
/// on top. O(log n + points within the radius in x).
[[nodiscard]] inline std::optional<std::size_t> pointAt(std::span<const Breakpoint> curve, const TimeAxis& time,
                                                        const ValueAxis& value, double x, double y, double radius)
{
    const auto first = std::lower_bound(curve.begin(), curve.end(), time.timeAt(x - radius),
                                        [](const Breakpoint& p, double t) { return p.time < t; });
    std::optional<std::size_t> best;
    double nearest = radius * radius;
    for (auto p = first; p != curve.end() && p->time <= time.timeAt(x + radius); ++p)
    {
        const double dx = time.xOf(p->time) - x;
        const double dy = value.yOf(p->value) - y;
        const double distance = dx * dx + dy * dy;
        if (distance > nearest)
            continue;
        nearest = distance;
        best = static_cast<std::size_t>(p - curve.begin());
    }
    return best;
}

/// Whether the curve's line passes within `radius` pixels above or below (x, y).
[[nodiscard]] inline bool lineIsAt(std::span<const Breakpoint> curve, const TimeAxis& time, const ValueAxis& value,
                                   double x, double y, double radius)
{
    return !curve.empty() && std::abs(value.yOf(valueAt(curve, time.timeAt(x))) - y) <= radius;
}

} // namespace pacini
