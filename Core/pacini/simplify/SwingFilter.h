#pragma once

// Swing filter: streaming simplification within a tolerance.

#include <pacini/simplify/SlopeCone.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pacini
{

/// Turns points that arrive one by one into connected lines that pass within a tolerance of every one of them.
///
/// The swing filter of Elmeleegy, Elmagarmid, Cecchet, Aref and Zwaenepoel, "Online piece-wise linear approximation of
/// numerical streams with precision guarantees", 2009: from the last vertex, a cone holds the slopes that pass all
/// points so far; when it closes, a vertex is put at the point before, with the least-squares slope limited to the
/// cone. O(1) time and memory per point. Chosen over their slide filter, which needs fewer but unconnected lines (two
/// values per break, and a convex hull of unbounded size): a curve of breakpoints is connected.
///
/// Added here: a bounded delay, steps (points at one time), a floor and exact end points.
class SwingFilter
{
public:
    /// `verticalTolerance` 0 or more, in value units; `maxDelayPoints` 1 or more; vertices are not below `lowestValue`
    /// as long as the points are not (0 for amplitudes).
    SwingFilter(double verticalTolerance, std::size_t maxDelayPoints, double lowestValue) noexcept
        : tolerance(verticalTolerance), maxDelay(maxDelayPoints), lowest(lowestValue)
    {
    }

    void reset() noexcept { *this = SwingFilter(tolerance, maxDelay, lowest); }

    /// Takes the next point and hands finished vertices to sink(Breakpoint), at most 2. Afterwards the last
    /// vertex is less than maxDelayPoints points old. Points that are not finite or go back in time are ignored.
    template <typename Sink>
    void push(const Breakpoint& p, Sink&& sink) noexcept
    {
        if (!std::isfinite(p.time) || !std::isfinite(p.value) || (started && p.time < last.time))
            return;
        if (!started)
        {
            started = true;
            startFrom(p, sink);
            last = p;
            return;
        }
        if (!cone.include(p))
        {
            // The line ends at the point before; where that was the apex itself, p is the other side of a step.
            if (pending > 0)
                startFrom(lineAtLast(), sink);
            if (!cone.include(p))
            {
                startFrom(p, sink);
                last = p;
                return;
            }
        }
        last = p;
        const double dt = p.time - apex.time;
        if (dt <= 0.0)
            return;
        sumXY += dt * (p.value - apex.value);
        sumXX += dt * dt;
        if (++pending >= maxDelay)
            startFrom(lineAtLast(), sink);
    }

    /// Ends the curve exactly at the last point; at most 2 vertices.
    template <typename Sink>
    void finish(Sink&& sink) noexcept
    {
        if (!started)
            return;
        if (pending > 0 && !cone.contains(last))
            startFrom(lineAtLast(), sink);
        if (!(apex == last))
            startFrom(last, sink);
        started = false;
    }

private:
    template <typename Sink>
    void startFrom(const Breakpoint& vertex, Sink&& sink) noexcept
    {
        sink(vertex);
        apex = vertex;
        cone = SlopeCone(vertex, tolerance, lowest);
        sumXY = 0.0;
        sumXX = 0.0;
        pending = 0;
    }

    /// The line at the last point; the limit by the floor only removes rounding.
    [[nodiscard]] Breakpoint lineAtLast() const noexcept
    {
        const double slope = sumXX > 0.0 ? sumXY / sumXX : 0.0;
        const double value = apex.value + cone.nearest(slope) * (last.time - apex.time);
        return {last.time, std::max(value, std::min(lowest, last.value))};
    }

    double tolerance;
    std::size_t maxDelay;
    double lowest;
    bool started = false;
    Breakpoint apex; ///< last vertex
    Breakpoint last; ///< last point taken
    SlopeCone cone;
    double sumXY = 0.0, sumXX = 0.0; ///< least squares of the slope through the apex
    std::size_t pending = 0;         ///< points after the apex in time
};

} // namespace pacini
