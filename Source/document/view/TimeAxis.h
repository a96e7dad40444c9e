#pragma once

// Time axis of a view: time <-> x.

#include <pacini/clip/edits/Lane.h>

#include <algorithm>
#include <cmath>

namespace pacini
{

/// The part of time that a view shows, from its left edge (x = 0) on. x in pixels, fractions allowed.
struct TimeAxis
{
    double start = 0.0;            ///< s at x = 0
    double secondsPerPixel = 0.01; ///< above 0
    bool operator==(const TimeAxis&) const = default;

    [[nodiscard]] double xOf(double time) const noexcept { return (time - start) / secondsPerPixel; }
    [[nodiscard]] double timeAt(double x) const noexcept { return start + x * secondsPerPixel; }

    /// What a view of `width` pixels shows.
    [[nodiscard]] TimeRange visible(double width) const noexcept { return {start, timeAt(width)}; }

    /// Shows `range` over `width` pixels; at least a microsecond for each.
    [[nodiscard]] static TimeAxis showing(TimeRange range, double width) noexcept
    {
        return {range.from, std::max((range.to - range.from) / std::max(width, 1.0), 1e-6)};
    }

    /// Zooms by `factor` (above 1: closer) so that what is at `x` stays there. One pixel shows 1 microsecond to 1 hour.
    [[nodiscard]] TimeAxis zoomed(double factor, double x) const noexcept
    {
        TimeAxis axis = *this;
        if (factor > 0.0 && std::isfinite(factor))
            axis.secondsPerPixel = std::clamp(secondsPerPixel / factor, 1e-6, 3600.0);
        axis.start = timeAt(x) - x * axis.secondsPerPixel;
        return axis;
    }

    /// Moved so that a clip of `duration` does not leave a view of `width` pixels: its start never lies right of the
    /// left edge, its end never left of the right edge while it could reach it.
    [[nodiscard]] TimeAxis keptInside(double duration, double width) const noexcept
    {
        TimeAxis axis = *this;
        axis.start = std::clamp(start, 0.0, std::max(0.0, duration - width * secondsPerPixel));
        return axis;
    }
};

} // namespace pacini
