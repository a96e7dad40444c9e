#pragma once

// Scaling by a power of two: brings signals of any level into the middle of the number range.

#include <algorithm>
#include <cmath>
#include <span>

namespace pacini
{

/// The power of two at or below the largest finite magnitude of `x`, so that x / peakScale(x) peaks between 1 and 2 and
/// is otherwise unchanged; 1 for silence. Not below 1e-300, so that dividing is safe.
template <typename Sample>
[[nodiscard]] double peakScale(std::span<const Sample> x) noexcept
{
    Sample peak = 0;
    for (const Sample v : x)
        if (std::isfinite(v))
            peak = std::max(peak, std::abs(v));
    return peak > Sample(0) ? std::max(std::exp2(std::ilogb(peak)), 1e-300) : 1.0;
}

} // namespace pacini
