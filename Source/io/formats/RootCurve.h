#pragma once

// Square root and square of a curve, for formats whose players square its values.

#include <pacini/clip/Curve.h>

namespace pacini
{

/// Adds points to a curve so that its square root, or square, taken point by point, is within 1/255 of that of the
/// lines: a straight line of one is a parabola of the other. Values of 0 or more.
[[nodiscard]] Curve rootOf(const Curve& amplitude);
[[nodiscard]] Curve squareOf(const Curve& level);

} // namespace pacini
