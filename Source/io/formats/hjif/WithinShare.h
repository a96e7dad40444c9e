#pragma once

// Curve simplification within an error that is relative to the level.

#include <pacini/clip/Curve.h>

namespace pacini
{

/// As few points as a walk along the curve finds that keep every point within `share` of its value, or within
/// `floor`: a limit that follows the level keeps the rise of an event out of silence. The cone of slopes from the last
/// kept point to all points since is that of J. O'Rourke, "An on-line algorithm for fitting straight lines between data
/// ranges" (1981), with the line starting at a point.
[[nodiscard]] Curve withinShare(const Curve& curve, double share, double floor);

} // namespace pacini
