#pragma once

// The largest vertical deviation of a stretch of a dense curve from one straight line.

#include <pacini/clip/Curve.h>

#include <cmath>
#include <cstddef>
#include <span>

namespace pacini
{

/// A deviation (value units, 0 or more) and the point where it occurs.
struct Deviation
{
    double value = 0.0;
    std::size_t index = 0;
};

/// The largest |vertical distance| of the points strictly between i and j from the line i-j; the lowest index on ties;
/// {0, i} when there is none. Where i and j share one time, the distance from point i's value counts. i < j < size. O(j
/// - i).
[[nodiscard]] inline Deviation maxDeviation(std::span<const Breakpoint> dense, std::size_t i, std::size_t j) noexcept
{
    const Breakpoint a = dense[i];
    const double duration = dense[j].time - a.time;
    const double slope = duration > 0.0 ? (dense[j].value - a.value) / duration : 0.0;
    Deviation largest{0.0, i};
    for (std::size_t m = i + 1; m < j; ++m)
    {
        const double deviation = std::abs(dense[m].value - (a.value + slope * (dense[m].time - a.time)));
        if (deviation > largest.value)
            largest = {deviation, m};
    }
    return largest;
}

} // namespace pacini
