#pragma once

// Curve of a clip cut to the time range of a chart: its axis, breakpoints, line, and peaks for each column.

#include "cli/plot/Axis.h"
#include "cli/plot/Path.h"
#include "cli/plot/Waveform.h"

#include <pacini/clip/Curve.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pacini::plot
{

/// The axis of a panel over time.
[[nodiscard]] inline Axis timeAxis(TimeRange range)
{
    return {range.to - range.from > 120.0 ? "Time (min:s)" : "Time (s)", Scale::time, range.from, range.to, {}};
}

/// The breakpoints within `range`.
[[nodiscard]] inline std::vector<Point> shownBreakpoints(const Curve& curve, TimeRange range)
{
    std::vector<Point> points;
    for (const Breakpoint& point : curve)
        if (point.time >= range.from && point.time <= range.to)
            points.push_back({point.time, point.value});
    return points;
}

/// The line of a curve within `range` and the clip's `duration`, including where it holds its end values. Empty for an
/// empty curve.
[[nodiscard]] inline std::vector<Point> shownCurve(const Curve& curve, TimeRange range, double duration)
{
    const TimeRange part{std::max(range.from, 0.0), std::min(range.to, duration)};
    if (curve.empty() || part.to < part.from)
        return {};
    std::vector<Point> points = shownBreakpoints(curve, part);
    if (points.empty() || points.front().x > part.from)
        points.insert(points.begin(), {part.from, valueAt(curve, part.from)});
    if (points.back().x < part.to)
        points.push_back({part.to, valueAt(curve, part.to)});
    return points;
}

/// The largest value of a curve in each of `columns` equal parts of `range`; 0 for an empty curve. The curve is 0
/// outside 0 to `duration`.
[[nodiscard]] inline std::vector<double> columnPeaks(const Curve& curve, TimeRange range, double duration,
                                                     std::size_t columns)
{
    std::vector<double> peaks(columns, 0.0);
    const double width = (range.to - range.from) / static_cast<double>(columns);
    for (std::size_t c = 0; c < columns; ++c)
        for (const double edge : {static_cast<double>(c), static_cast<double>(c + 1)})
        {
            const double time = range.from + edge * width;
            if (time >= 0.0 && time <= duration)
                peaks[c] = std::max(peaks[c], valueAt(curve, time));
        }
    for (const Breakpoint& point : curve)
    {
        const double position = (point.time - range.from) / width;
        if (position < 0.0 || position > static_cast<double>(columns) || point.time > duration)
            continue;
        const auto c = std::min(static_cast<std::size_t>(position), columns - 1);
        peaks[c] = std::max(peaks[c], point.value);
    }
    return peaks;
}

} // namespace pacini::plot
