#pragma once

// Optimal simplification: the reference for the other methods, and the best choice for short curves.

#include <pacini/simplify/ComputableCurve.h>
#include <pacini/simplify/DenseSamples.h>
#include <pacini/simplify/Deviation.h>
#include <pacini/simplify/GrowingSegment.h>
#include <pacini/simplify/KeptPoints.h>
#include <pacini/simplify/SlopeCone.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// The fewest points with a maximum vertical error of at most `maxError` (0 or more, to within the rounding of the
/// values); among those the ones with the least squared error. Shortest path over the segments that hold the bound,
/// which a cone of slopes per start finds: Imai and Iri, "Computational-geometric methods for polygonal approximations
/// of a curve", 1986. O(n s), s the mean length over which a line can hold the bound; O(n^2) for a straight curve.
[[nodiscard]] inline KeptPoints optimalToBound(std::span<const Breakpoint> curve, double maxError)
{
    const std::size_t n = curve.size();
    if (n < 3)
        return allPoints(n);
    const ComputableCurve computable(curve);
    const auto dense = computable.points();
    maxError = computable.scaled(maxError);
    const DenseColumns columns(dense);
    const DenseSamples samples = columns.samples();
    double largest = 0.0;
    for (const Breakpoint& p : dense)
        largest = std::max(largest, std::abs(p.value));
    const double tolerance = maxError + 4.0 * std::numeric_limits<double>::epsilon() * largest;

    struct Reach
    {
        std::size_t points = std::numeric_limits<std::size_t>::max();
        double squared = 0.0;
    };
    std::vector<Reach> reach(n);
    std::vector<std::uint32_t> from(n, 0);
    reach[0] = {1, 0.0};
    for (std::size_t i = 0; i + 1 < n; ++i)
    {
        SlopeCone cone(dense[i], tolerance, -std::numeric_limits<double>::infinity());
        GrowingSegment segment(samples, i);
        for (std::size_t j = i + 1; j < n; ++j)
        {
            if (cone.contains(dense[j]))
            {
                const std::size_t points = reach[i].points + 1;
                const double squared = reach[i].squared + segment.errorTo(j);
                if (points < reach[j].points || (points == reach[j].points && squared < reach[j].squared))
                {
                    reach[j] = {points, squared};
                    from[j] = static_cast<std::uint32_t>(i);
                }
            }
            if (!cone.include(dense[j]))
                break;
            segment.include(j);
        }
    }
    KeptPoints kept;
    followBack(from, kept);
    return kept;
}

/// At most `count` points (2 at least) with the least possible maximum vertical error, to 1e-12 of it: bisection of the
/// bound, which ends on an error that really occurs. Some 50 times the cost of optimalToBound.
[[nodiscard]] inline KeptPoints optimalToCount(std::span<const Breakpoint> curve, std::size_t count)
{
    const std::size_t n = curve.size();
    count = std::max<std::size_t>(count, 2);
    if (n <= count)
        return allPoints(n);
    const ComputableCurve computable(curve);
    const auto dense = computable.points();
    KeptPoints best = optimalToBound(dense, 0.0);
    if (best.size() <= count)
        return best;
    best = {0, n - 1};
    double low = 0.0;
    double high = maxDeviation(dense, 0, n - 1).value;
    while (high - low > 1e-12 * high)
    {
        const double middle = 0.5 * (low + high);
        if (!(middle > low && middle < high))
            break; // nothing lies between them
        KeptPoints kept = optimalToBound(dense, middle);
        if (kept.size() > count)
        {
            low = middle;
            continue;
        }
        double error = 0.0;
        for (std::size_t k = 1; k < kept.size(); ++k)
            error = std::max(error, maxDeviation(dense, kept[k - 1], kept[k]).value);
        high = std::min(middle, error);
        best = std::move(kept);
    }
    return best;
}

} // namespace pacini
