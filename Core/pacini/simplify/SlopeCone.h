#pragma once

// Slope cone of streaming simplification: the lines from one point that pass close to all points after it.

#include <pacini/clip/Curve.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pacini
{

/// The slopes of all lines from an apex that pass within `tolerance` (vertical) of every later point included so far,
/// and where these points are not below `lowest`, not below it either.
class SlopeCone
{
public:
    SlopeCone() = default;
    SlopeCone(const Breakpoint& from, double verticalTolerance, double lowestValue) noexcept
        : apex(from), tolerance(verticalTolerance), lowest(lowestValue)
    {
    }

    /// Whether the line from the apex to p (not earlier) stays within the tolerance of the points included.
    [[nodiscard]] bool contains(const Breakpoint& p) const noexcept
    {
        const double dt = p.time - apex.time;
        if (dt <= 0.0)
            return true;
        const double slope = (p.value - apex.value) / dt;
        return lower <= slope && slope <= upper;
    }

    /// Narrows the cone to lines near p (not earlier). False, and the cone as it was, when no line is left.
    bool include(const Breakpoint& p) noexcept
    {
        const double dt = p.time - apex.time;
        const double dv = p.value - apex.value;
        if (dt <= 0.0)
            return std::abs(dv) <= tolerance;
        const double floor = std::min(lowest, p.value) - apex.value;
        const double newLower = std::max(lower, std::max(dv - tolerance, floor) / dt);
        const double newUpper = std::min(upper, (dv + tolerance) / dt);
        if (newLower > newUpper)
            return false;
        lower = newLower;
        upper = newUpper;
        return true;
    }

    /// The slope in the cone nearest to `slope`.
    [[nodiscard]] double nearest(double slope) const noexcept { return std::clamp(slope, lower, upper); }

private:
    Breakpoint apex;
    double tolerance = 0.0;
    double lowest = -std::numeric_limits<double>::infinity();
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
};

} // namespace pacini
