#pragma once

// The choice of points with the least squared error, found by trying all: the reference of the faster methods.

#include <pacini/simplify/DenseSamples.h>
#include <pacini/simplify/GrowingSegment.h>
#include <pacini/simplify/KeptPoints.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pacini::test
{

/// The points with the least weighted squared vertical error among all choices of at most `count` (2 at least); fewer
/// where that many already bring it down to `squaredErrorBound`. Bellman's dynamic programming, one row per number of
/// points: O(count n^2) time, O(count n) memory: for some thousand samples.
[[nodiscard]] inline KeptPoints optimalSquared(const DenseSamples& samples, std::size_t count,
                                               double squaredErrorBound = 0.0)
{
    const std::size_t n = samples.size();
    count = std::max<std::size_t>(count, 2);
    if (n < 3)
        return allPoints(n);
    constexpr double unreachable = std::numeric_limits<double>::infinity();
    std::vector<double> costs(n, unreachable);
    costs[0] = 0.0;
    std::vector<std::vector<std::uint32_t>> from;
    std::vector<double> next;
    std::size_t bestRow = 0;
    double best = unreachable;
    do
    {
        next.assign(n, unreachable);
        auto& back = from.emplace_back(n, 0u);
        for (std::size_t i = 0; i + 1 < n; ++i)
        {
            if (costs[i] == unreachable)
                continue;
            GrowingSegment segment(samples, i);
            for (std::size_t j = i + 1; j < n; ++j)
            {
                const double cost = costs[i] + segment.errorTo(j);
                if (cost < next[j])
                {
                    next[j] = cost;
                    back[j] = static_cast<std::uint32_t>(i);
                }
                segment.include(j);
            }
        }
        costs.swap(next);
        // One more point can be worse than one less where lines must pass through samples.
        if (costs[n - 1] < best)
        {
            best = costs[n - 1];
            bestRow = from.size();
        }
    } while (best > squaredErrorBound && from.size() + 1 < std::min(count, n));

    KeptPoints kept(bestRow + 1, n - 1);
    for (std::size_t k = bestRow; k > 0; --k)
        kept[k - 1] = from[k - 1][kept[k]];
    return kept;
}

} // namespace pacini::test
