#pragma once

// Curve simplification, one door to all methods: turns a dense curve into few breakpoints.

#include <pacini/clip/Curve.h>
#include <pacini/foundation/Result.h>
#include <pacini/simplify/ComputableCurve.h>
#include <pacini/simplify/DouglasPeucker.h>
#include <pacini/simplify/KeptPoints.h>
#include <pacini/simplify/LagrangianTargets.h>
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

namespace pacini
{

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
