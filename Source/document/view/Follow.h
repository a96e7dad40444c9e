#pragma once

// Scrolling of a view that follows the playhead.

#include "document/view/TimeAxis.h"

#include <cmath>

namespace pacini
{

enum class Follow
{
    off,
    page,  ///< turns when the playhead leaves it
    smooth ///< the playhead stays in the middle
};

/// The view of `width` pixels that shows a playhead at `time`. Smooth ones move by whole pixels, so that nothing
/// flickers.
[[nodiscard]] inline TimeAxis followed(TimeAxis axis, double time, double width, Follow follow) noexcept
{
    const TimeRange shown = axis.visible(width);
    if (follow == Follow::page && (time < shown.from || time > shown.to))
        axis.start = time;
    if (follow == Follow::smooth)
        axis.start += axis.secondsPerPixel * std::round(axis.xOf(time) - 0.5 * width);
    return axis;
}

} // namespace pacini
