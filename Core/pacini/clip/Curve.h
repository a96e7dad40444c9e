#pragma once

// A curve: breakpoints in time, joined by straight lines.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace pacini
{

/// One point of a curve: time in seconds, value in the curve's unit (linear amplitude or Hz).
struct Breakpoint
{
    double time = 0.0;
    double value = 0.0;
    bool operator==(const Breakpoint&) const = default;
};

/// Breakpoints in non-decreasing time; two points at one time make a step.
using Curve = std::vector<Breakpoint>;

/// The value at `time`: straight lines between points, the end values outside, 0 for an empty curve.
/// At a step the later value counts. O(log n).
[[nodiscard]] inline double valueAt(std::span<const Breakpoint> curve, double time) noexcept
{
    if (curve.empty())
        return 0.0;
    const auto next =
        std::upper_bound(curve.begin(), curve.end(), time, [](double t, const Breakpoint& p) { return t < p.time; });
    if (next == curve.begin())
        return curve.front().value;
    if (next == curve.end())
        return curve.back().value;
    const Breakpoint& a = *(next - 1);
    const Breakpoint& b = *next;
    return a.value + (b.value - a.value) * ((time - a.time) / (b.time - a.time));
}

/// Ends a curve at `end`. One point at `end`, on the curve, replaces the points after it.
inline void cutAfter(Curve& curve, double end)
{
    if (curve.empty() || curve.back().time <= end)
        return;
    const double value = valueAt(curve, end);
    while (!curve.empty() && curve.back().time >= end)
        curve.pop_back();
    curve.push_back({end, value});
}

/// A straight piece of a curve.
struct CurveLine
{
    double value = 0.0; ///< at `from`
    double rise = 0.0;  ///< over `span`
    double from = 0.0;
    double span = 1.0;
    double until = 0.0; ///< the curve leaves the line here

    [[nodiscard]] double at(double time) const noexcept { return value + rise * ((time - from) / span); }
};

/// Reads a curve at times that only move forward: O(1) per call on average. Does not own the curve.
class CurveReader
{
public:
    CurveReader() = default;
    explicit CurveReader(std::span<const Breakpoint> curveToRead) noexcept : curve(curveToRead) {}

    /// Same value as valueAt(curve, time); `time` must not be smaller than in the call before.
    [[nodiscard]] double at(double time) noexcept { return lineAt(time).at(time); }

    /// Returns the straight segment of the curve from `time` on, with a time limit as in at().
    [[nodiscard]] CurveLine lineAt(double time) noexcept
    {
        constexpr double never = std::numeric_limits<double>::infinity();
        if (curve.empty())
            return {0.0, 0.0, 0.0, 1.0, never};
        while (next < curve.size() && curve[next].time <= time)
            ++next;
        if (next == 0)
            return {curve.front().value, 0.0, 0.0, 1.0, curve.front().time};
        if (next == curve.size())
            return {curve.back().value, 0.0, 0.0, 1.0, never};
        const Breakpoint& a = curve[next - 1];
        const Breakpoint& b = curve[next];
        return {a.value, b.value - a.value, a.time, b.time - a.time, b.time};
    }

private:
    std::span<const Breakpoint> curve;
    std::size_t next = 0;
};

} // namespace pacini
