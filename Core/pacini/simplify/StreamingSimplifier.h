#pragma once

// Streaming simplification of a curve while it is being made, with a bounded delay.

#include <pacini/simplify/SwingFilter.h>
#include <pacini/simplify/WindowedLagrangian.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <variant>

namespace pacini
{

/// Criterion of a streaming simplifier.
enum class StreamingRule
{
    tolerance, ///< a bound of the vertical error: swing filter
    rate,      ///< a number of points per input point: best plan within the delay
};

/// Parameters of a streaming simplifier.
struct StreamingParams
{
    StreamingRule rule = StreamingRule::tolerance;
    double tolerance = 0.01;                                  ///< value units, 0 or more
    double pointsPerInput = 0.02;                             ///< 0 to 1
    std::size_t maxDelay = 250;                               ///< input points, 1 or more
    double lowest = -std::numeric_limits<double>::infinity(); ///< vertices stay above it if the points do, e.g. 0
    bool operator==(const StreamingParams&) const = default;
};

/// Takes points one by one and hands over vertices less than maxDelay points later: after each push(), the last vertex
/// is less than maxDelay points old, and up to it the curve is final. So a vertex comes at least every maxDelay points,
/// also in silence. The result depends on the points only, not on when they arrive. [any] thread, one at a time; push()
/// and finish() do not allocate.
class StreamingSimplifier
{
public:
    StreamingSimplifier() { prepare({}); }

    /// Allocates the window and starts a new curve.
    void prepare(const StreamingParams& params)
    {
        if (params.rule == StreamingRule::tolerance)
            method.emplace<SwingFilter>(params.tolerance, params.maxDelay, params.lowest);
        else
            method.emplace<WindowedLagrangian>(params.pointsPerInput, params.maxDelay);
    }

    /// Forgets the curve so far.
    void reset() noexcept
    {
        with([](auto& m) { m.reset(); });
    }

    /// The next point, times in order; sink(const Breakpoint&) receives the finished vertices. A point whose value or
    /// time is not finite or beyond +-1e100, where squares would not be finite, is ignored, as is one that goes back in
    /// time.
    template <typename Sink>
    void push(const Breakpoint& point, Sink&& sink) noexcept
    {
        constexpr double largest = 1e100;
        if (!(std::abs(point.time) <= largest && std::abs(point.value) <= largest))
            return;
        with([&](auto& m) { m.push(point, sink); });
    }

    /// Ends the curve: the last point is its last vertex. The next push() starts a new curve.
    template <typename Sink>
    void finish(Sink&& sink) noexcept
    {
        with([&](auto& m) { m.finish(sink); });
    }

private:
    template <typename Use>
    void with(Use use) noexcept
    {
        if (auto* swing = std::get_if<SwingFilter>(&method))
            use(*swing);
        else
            use(*std::get_if<WindowedLagrangian>(&method));
    }

    std::variant<SwingFilter, WindowedLagrangian> method{SwingFilter(0.0, 1, 0.0)};
};

} // namespace pacini
