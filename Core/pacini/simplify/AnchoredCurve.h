#pragma once

// Simplification with anchors: few points of a dense curve, some of which must be there.

#include <pacini/clip/Curve.h>
#include <pacini/simplify/BudgetSpread.h>
#include <pacini/simplify/DenseSamples.h>
#include <pacini/simplify/DouglasPeucker.h>
#include <pacini/simplify/KeptPoints.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Budget and tolerance of a curve with anchors.
struct AnchoredCurveParams
{
    std::size_t count = 2;  ///< at most this many points, anchors among them; more only where the anchors are more
    double tolerance = 0.0; ///< value units: no more points than keep the curve within this
    bool operator==(const AnchoredCurveParams&) const = default;
};

namespace detail
{
/// A dense curve with points at all anchors.
struct AnchoredDense
{
    Curve curve;
    std::vector<std::size_t> anchors; ///< indices of the points that stay; the first and the last are among them
    std::vector<std::size_t> sources; ///< for each point the one of the dense curve that it is or comes after
};

[[nodiscard]] inline AnchoredDense withAnchors(std::span<const Breakpoint> dense, std::span<const double> times)
{
    AnchoredDense result{{}, {0}, {}};
    Curve& curve = result.curve;
    curve.reserve(dense.size() + times.size());
    std::size_t next = 0;
    const auto take = [&]
    {
        curve.push_back(dense[next]);
        result.sources.push_back(next++);
    };
    const auto anchorLast = [&]
    {
        if (result.anchors.back() != curve.size() - 1)
            result.anchors.push_back(curve.size() - 1);
    };
    for (const double time : times)
    {
        if (!(time > dense.front().time && time < dense.back().time))
            continue;
        while (dense[next].time <= time)
            take();
        if (curve.back().time < time)
        {
            const Breakpoint a = curve.back();
            const Breakpoint& b = dense[next];
            curve.push_back({time, a.value + (b.value - a.value) * ((time - a.time) / (b.time - a.time))});
            result.sources.push_back(next - 1);
        }
        anchorLast();
    }
    while (next < dense.size())
        take();
    anchorLast();
    return result;
}
} // namespace detail

/// Points of `dense` (times in order) that keep its first and last time and have one at each of `anchors` (in order;
/// those outside of the curve's time do not count). If the tolerance can be kept with at most `count` points, as few as
/// Douglas and Peucker's splitting needs between the anchors; else `count`, spread over the stretches between anchors
/// so that the sum of `weights` x squared errors is least (see BudgetSpread). `weights` is empty or has one entry of 0
/// or more per dense point; inserted points count like their neighbour. Curves of up to two points come back as they
/// are, with the anchors.
[[nodiscard]] inline Curve anchoredCurve(std::span<const Breakpoint> dense, std::span<const double> anchors,
                                         const AnchoredCurveParams& params, std::span<const double> weights = {})
{
    if (dense.size() < 2)
        return {dense.begin(), dense.end()};
    const auto [curve, fixed, sources] = detail::withAnchors(dense, anchors);
    KeptPoints kept = splitWorst(curve, fixed, curve.size(), params.tolerance);
    if (kept.size() <= params.count || kept.size() == fixed.size())
        return curveOf(curve, kept);

    std::vector<double> values, times, importance;
    for (std::size_t i = 0; i < curve.size(); ++i)
    {
        values.push_back(curve[i].value);
        times.push_back(curve[i].time);
        if (!weights.empty())
            importance.push_back(weights[sources[i]]);
    }
    std::vector<BudgetCurve> stretches;
    for (std::size_t k = 1; k < fixed.size(); ++k)
    {
        const std::size_t first = fixed[k - 1], size = fixed[k] - first + 1;
        const auto part = [&](const std::vector<double>& column)
        {
            return column.empty() ? std::span<const double>() : std::span(column).subspan(first, size);
        };
        stretches.push_back({{part(values), part(times), part(importance)}, 1.0, 2});
    }
    const std::size_t joints = fixed.size() - 2; // ends of two stretches
    const auto shares = BudgetSpread().spread(stretches, std::max(params.count, fixed.size()) + joints);
    kept = {0};
    for (std::size_t k = 0; k < stretches.size(); ++k)
        for (std::size_t i = 1; i < shares->kept[k].size(); ++i)
            kept.push_back(fixed[k] + shares->kept[k][i]);
    return curveOf(curve, kept);
}

} // namespace pacini
