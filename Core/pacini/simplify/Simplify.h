#pragma once

// Curve simplification by any method: reduces a dense curve to few breakpoints.

#include <pacini/clip/Curve.h>
#include <pacini/foundation/Result.h>
#include <pacini/simplify/BudgetSpread.h>
#include <pacini/simplify/ComputableCurve.h>
#include <pacini/simplify/DenseSamples.h>
#include <pacini/simplify/DouglasPeucker.h>
#include <pacini/simplify/KeptPoints.h>
#include <pacini/simplify/Lagrangian.h>
#include <pacini/simplify/Optimal.h>
#include <pacini/simplify/Refit.h>
#include <pacini/simplify/StreamingSimplifier.h>
#include <pacini/simplify/Visvalingam.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// A dense curve after Visvalingam's elimination; each point represents the samples halfway to its neighbours.
class ThinnedSamples
{
public:
    /// Keeps `count` points (2 at least) of `dense`.
    ThinnedSamples(std::span<const Breakpoint> dense, std::size_t count) : points(visvalingamToCount(dense, count))
    {
        for (std::size_t k = 0; k < points.size(); ++k)
        {
            values.push_back(dense[points[k]].value);
            times.push_back(dense[points[k]].time);
            const std::size_t before = points[k == 0 ? 0 : k - 1];
            const std::size_t after = points[std::min(k + 1, points.size() - 1)];
            weights.push_back(0.5 * static_cast<double>(after - before));
        }
    }

    [[nodiscard]] DenseSamples samples() const noexcept { return {values, times, weights}; }

    /// Turns indices into samples() to indices into the dense curve.
    void toDense(KeptPoints& kept) const noexcept
    {
        for (std::size_t& k : kept)
            k = points[k];
    }

private:
    KeptPoints points;
    std::vector<double> values, times, weights;
};

/// At most `count` points (2 at least) with about the least squared vertical error (BudgetSpread on one curve).
///
/// Where the dense curve has more than 24 samples per point wanted, it is thinned to that first. On the envelopes of 6
/// recordings at 1 kHz the RMS error was then within 1 % (5 points/s) and 3 % (10) of the search over all samples,
/// which took 30 and 12 times as long. Segments of up to 8 times the mean length are searched exactly.
[[nodiscard]] inline KeptPoints lagrangianToCount(std::span<const Breakpoint> curve, std::size_t count)
{
    const ComputableCurve computable(curve);
    const auto dense = computable.points();
    constexpr std::size_t samplesPerPoint = 24;
    constexpr std::size_t maxSegmentLength = 8 * samplesPerPoint;
    count = std::max<std::size_t>(count, 2);
    if (dense.size() <= count)
        return allPoints(dense.size());
    const auto solve = [count](const DenseSamples& samples)
    {
        const BudgetCurve priced{samples, 1.0, 2};
        return BudgetSpread(maxSegmentLength).spread(std::span(&priced, 1), count).value().kept.front();
    };
    if (dense.size() / count <= samplesPerPoint)
        return solve(DenseColumns(dense).samples());
    const ThinnedSamples thinned(dense, count * samplesPerPoint);
    KeptPoints kept = solve(thinned.samples());
    thinned.toDense(kept);
    return kept;
}

/// Few points with a maximum vertical error of at most `maxError` (0 or more): of the solutions at a ladder of prices
/// per point, each repaired by splits where it breaks the bound, the one with the fewest points. Least squares is not
/// made for a bound of the maximum; optimalToBound needs fewer points.
[[nodiscard]] inline KeptPoints lagrangianToBound(std::span<const Breakpoint> curve, double maxError)
{
    const ComputableCurve computable(curve);
    const auto dense = computable.points();
    maxError = computable.scaled(maxError);
    const std::size_t n = dense.size();
    KeptPoints best = douglasPeuckerToBound(dense, maxError);
    if (best.size() < 3 || !(maxError > 0.0)) // none has fewer; beyond that the square of the bound may be infinite
        return best;
    const DenseColumns columns(dense);
    LagrangianSegmenter segmenter;
    KeptPoints kept;
    // A segment of n samples with the bound as its largest error has a squared error of about n/4 bound^2.
    for (double price = 16.0; price >= 1.0 / 16.0; price *= 0.5)
    {
        segmenter.solve(columns.samples(), price * maxError * maxError, kept);
        if (kept.size() > best.size())
            break;
        KeptPoints repaired = splitWorst(dense, kept, n, maxError);
        if (repaired.size() <= best.size())
            best = std::move(repaired);
    }
    return best;
}

/// Simplification method.
enum class SimplifyMethod
{
    visvalingam,    ///< removal by triangle area: the thesis' method
    douglasPeucker, ///< splitting at the largest deviation: fastest
    optimal,        ///< least maximum error, exactly: slow on long curves
    streaming,      ///< one pass with a bounded delay
    lagrangian,     ///< least squared error, by dynamic programming: best curve for its points
};

/// Method, and the number of points or the error that bounds it.
struct SimplifyParams
{
    SimplifyMethod method = SimplifyMethod::lagrangian;
    std::optional<std::size_t> count; ///< at most this many points; below 2 counts as 2
    std::optional<double> maxError;   ///< largest vertical error in value units, 0 or more
    bool refit = false;               ///< least-squares vertex values; end points may then move in value
    double lowest = -std::numeric_limits<double>::infinity(); ///< floor of values that are not dense points, e.g. 0
    std::size_t streamingDelay = 250; ///< points, for the streaming method; raised where the count demands it
    bool operator==(const SimplifyParams&) const = default;
};

namespace detail
{

/// The streaming method over a whole curve.
[[nodiscard]] inline Curve streamThrough(std::span<const Breakpoint> dense, StreamingParams params)
{
    const ComputableCurve computable(dense);
    params.tolerance = computable.scaled(params.tolerance);
    params.lowest = computable.scaled(params.lowest);
    Curve curve;
    StreamingSimplifier simplifier;
    simplifier.prepare(params);
    const auto sink = [&curve](const Breakpoint& p)
    {
        curve.push_back(p);
    };
    for (const Breakpoint& p : computable.points())
        simplifier.push(p, sink);
    simplifier.finish(sink);
    return computable.unscaled(curve);
}

[[nodiscard]] inline Curve simplifyToCount(std::span<const Breakpoint> dense, const SimplifyParams& params,
                                           std::size_t count)
{
    switch (params.method)
    {
    case SimplifyMethod::visvalingam:
        return curveOf(dense, visvalingamToCount(dense, count));
    case SimplifyMethod::douglasPeucker:
        return curveOf(dense, douglasPeuckerToCount(dense, count));
    case SimplifyMethod::optimal:
        return curveOf(dense, optimalToCount(dense, count));
    case SimplifyMethod::streaming:
    {
        if (count == 2)
            return {dense.front(), dense.back()};
        const double rate = static_cast<double>(count - 2) / static_cast<double>(dense.size());
        const auto longest = static_cast<std::size_t>(std::ceil(2.0 / rate));
        return streamThrough(dense,
                             {StreamingRule::rate, 0.0, rate, std::max(params.streamingDelay, longest), params.lowest});
    }
    case SimplifyMethod::lagrangian:
        break;
    }
    return curveOf(dense, lagrangianToCount(dense, count));
}

[[nodiscard]] inline Curve simplifyToBound(std::span<const Breakpoint> dense, const SimplifyParams& params)
{
    switch (params.method)
    {
    case SimplifyMethod::visvalingam:
        return curveOf(dense, visvalingamToBound(dense, *params.maxError));
    case SimplifyMethod::douglasPeucker:
        return curveOf(dense, douglasPeuckerToBound(dense, *params.maxError));
    case SimplifyMethod::optimal:
        return curveOf(dense, optimalToBound(dense, *params.maxError));
    case SimplifyMethod::streaming:
        return streamThrough(dense,
                             {StreamingRule::tolerance, *params.maxError, 0.0, params.streamingDelay, params.lowest});
    case SimplifyMethod::lagrangian:
        break;
    }
    return curveOf(dense, lagrangianToBound(dense, *params.maxError));
}

[[nodiscard]] inline Result<void> checkSimplifyInput(std::span<const Breakpoint> dense, const SimplifyParams& params)
{
    if (!params.count && !params.maxError)
        return Error{ErrorCode::invalidArgument, "params", "need a count or a maxError"};
    if (params.maxError && !(*params.maxError >= 0.0 && std::isfinite(*params.maxError)))
        return Error{ErrorCode::invalidArgument, "params.maxError", "is not 0 or more"};
    if (params.streamingDelay < 1)
        return Error{ErrorCode::invalidArgument, "params.streamingDelay", "is below 1 point"};
    if (dense.size() >= std::numeric_limits<std::uint32_t>::max())
        return Error{ErrorCode::tooLarge, "curve", "has more than 2^32 - 2 points"};
    for (std::size_t i = 0; i < dense.size(); ++i)
    {
        if (!std::isfinite(dense[i].time) || !std::isfinite(dense[i].value))
            return Error{ErrorCode::notFinite, "curve[" + std::to_string(i) + "]", "is not a finite point"};
        if (i > 0 && dense[i].time < dense[i - 1].time)
            return Error{ErrorCode::invalidData, "curve[" + std::to_string(i) + "].time",
                         "is earlier than the point before it"};
    }
    return {};
}

} // namespace detail

/// The simplified curve, first and last time included.
///
/// With maxError alone: so few points that no point of `dense` is further away (vertically, both sides of a step apart)
/// than that, to within rounding. With count alone: the method's best with at most that many points; a curve that
/// has no more is returned as it is, so a second pass changes nothing. With both: the bound, but never more points
/// than count. Curves of 0, 1 and 2 points come back as they are. The kept points are points of `dense`, unless refit
/// or the streaming method within a bound choose other values. With refit, a maxError that was met stays met.
///
/// invalidArgument: neither count nor bound, or a bound that is not 0 or more. notFinite, invalidData: `curve[i]` is
/// NaN or infinite, or earlier than the point before it. tooLarge: 2^32 - 1 points or more.
[[nodiscard]] inline Result<Curve> simplify(std::span<const Breakpoint> dense, const SimplifyParams& params)
{
    if (auto checked = detail::checkSimplifyInput(dense, params); !checked)
        return checked.error();
    const std::size_t count = params.count ? std::max<std::size_t>(*params.count, 2) : dense.size();
    if (dense.size() < 3 || (!params.maxError && dense.size() <= count))
        return Curve(dense.begin(), dense.end());

    Curve curve;
    bool holdsBound = params.maxError.has_value();
    if (holdsBound)
        curve = detail::simplifyToBound(dense, params);
    if (!holdsBound || curve.size() > count)
    {
        holdsBound = false;
        curve = detail::simplifyToCount(dense, params, count);
    }
    if (!params.refit)
        return curve;
    const ComputableCurve computable(dense);
    RefitParams fit;
    fit.lowest = computable.scaled(params.lowest);
    if (holdsBound)
        fit.maxError = computable.scaled(*params.maxError);
    return computable.unscaled(refit(computable.points(), computable.scaled(curve), {}, fit));
}

} // namespace pacini
