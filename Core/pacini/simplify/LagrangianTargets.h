#pragma once

// Least-squares simplification of one curve to a number of points or to an error bound.

#include <pacini/simplify/BudgetSpread.h>
#include <pacini/simplify/ComputableCurve.h>
#include <pacini/simplify/DouglasPeucker.h>
#include <pacini/simplify/KeptPoints.h>
#include <pacini/simplify/Lagrangian.h>
#include <pacini/simplify/ThinnedSamples.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace pacini
{

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
    if (n < 3 || !(maxError > 0.0))
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

} // namespace pacini
