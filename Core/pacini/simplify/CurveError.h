#pragma once

// Error measures of simplification: deviation of a simplified curve from the dense one.

#include <pacini/clip/Curve.h>
#include <pacini/simplify/HatBasis.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace pacini
{

/// Vertical errors in the curve's value units, 0 or more.
struct CurveError
{
    double max = 0.0;
    double rms = 0.0;
};

/// Domain of the mean in the RMS error.
enum class ErrorMean
{
    points, ///< the dense curve's points, each counts the same
    time,   ///< time: the exact integral between the two curves, however their points are spread
};

namespace detail
{

[[nodiscard]] inline CurveError errorOverPoints(std::span<const Breakpoint> dense, std::span<const Breakpoint> curve)
{
    CurveError error;
    double sum = 0.0;
    std::size_t count = 0;
    forEachPlace(dense, curve,
                 [&](std::size_t m, const HatPlace& place)
                 {
                     const double e = std::abs(place.of(curve) - dense[m].value);
                     error.max = std::max(error.max, e);
                     sum += e * e;
                     ++count;
                 });
    error.rms = std::sqrt(sum / static_cast<double>(count));
    return error;
}

[[nodiscard]] inline CurveError errorOverTime(std::span<const Breakpoint> dense, std::span<const Breakpoint> curve)
{
    // Between neighbouring times of either curve the difference is a straight line from e0 to e1, and the integral of
    // its square is dt (e0^2 + e0 e1 + e1^2) / 3.
    HatReader denseReader(dense);
    HatReader curveReader(curve);
    const auto end = std::numeric_limits<double>::infinity();
    CurveError error;
    double sum = 0.0;
    double time = dense.front().time;
    std::size_t d = 0;
    std::size_t c = 0;
    while (time < dense.back().time)
    {
        const double e0 = curveReader.after(time).of(curve) - denseReader.after(time).of(dense);
        while (d < dense.size() && dense[d].time <= time)
            ++d;
        while (c < curve.size() && curve[c].time <= time)
            ++c;
        const double next = std::min(dense[d].time, c < curve.size() ? curve[c].time : end);
        const double e1 = curveReader.before(next).of(curve) - denseReader.before(next).of(dense);
        error.max = std::max({error.max, std::abs(e0), std::abs(e1)});
        sum += (next - time) * (e0 * e0 + e0 * e1 + e1 * e1) / 3.0;
        time = next;
    }
    error.rms = std::sqrt(sum / (dense.back().time - dense.front().time));
    return error;
}

} // namespace detail

/// Maximum and RMS vertical error of `simplified` against `dense` (times in order, any number of points), over the
/// dense curve's time: an empty `dense` gives 0; an empty `simplified` reads as 0. Both sides of a step are compared.
/// Over time the maximum is that of the whole lines; a dense curve without duration counts its points. O(n + m).
[[nodiscard]] inline CurveError curveError(std::span<const Breakpoint> dense, std::span<const Breakpoint> simplified,
                                           ErrorMean mean = ErrorMean::points)
{
    if (dense.empty())
        return {};
    const Breakpoint zero;
    const auto curve = simplified.empty() ? std::span<const Breakpoint>(&zero, 1) : simplified;
    if (mean == ErrorMean::time && dense.back().time > dense.front().time)
        return detail::errorOverTime(dense, curve);
    return detail::errorOverPoints(dense, curve);
}

} // namespace pacini
