#pragma once

// Line simplification by Ramer, Douglas and Peucker: keeps the most important point first.

#include <pacini/simplify/ComputableCurve.h>
#include <pacini/simplify/Deviation.h>
#include <pacini/simplify/KeptPoints.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Adds points to `kept` (ascending, with the first and last point), always at the largest deviation of the whole
/// curve, until `count` points are kept or no deviation is above `maxError`; the lower index first on ties.
/// deviation(dense, i, j) is the largest between two points: the vertical one where nothing else is asked for.
template <typename Largest = decltype(&maxDeviation)>
[[nodiscard]] KeptPoints splitWorst(std::span<const Breakpoint> dense, KeptPoints kept, std::size_t count,
                                    double maxError, const Largest& deviation = &maxDeviation)
{
    struct Segment
    {
        Deviation worst;
        std::size_t first, last;
    };
    const auto lessUrgent = [](const Segment& a, const Segment& b)
    {
        return a.worst.value < b.worst.value || (a.worst.value == b.worst.value && a.first > b.first);
    };
    std::vector<Segment> heap;
    const auto add = [&](std::size_t first, std::size_t last)
    {
        const Deviation worst = deviation(dense, first, last);
        if (worst.value > maxError)
        {
            heap.push_back({worst, first, last});
            std::push_heap(heap.begin(), heap.end(), lessUrgent);
        }
    };
    for (std::size_t k = 1; k < kept.size(); ++k)
        add(kept[k - 1], kept[k]);
    while (kept.size() < count && !heap.empty())
    {
        std::pop_heap(heap.begin(), heap.end(), lessUrgent);
        const Segment segment = heap.back();
        heap.pop_back();
        kept.push_back(segment.worst.index);
        add(segment.first, segment.worst.index);
        add(segment.worst.index, segment.last);
    }
    std::sort(kept.begin(), kept.end());
    return kept;
}

/// At most `count` points (2 at least), found by splitting the segment with the largest vertical deviation at that
/// point. Ramer, "An iterative procedure for the polygonal approximation of plane curves", 1972; Douglas and Peucker,
/// "Algorithms for the reduction of the number of points...", 1973; by count instead of by tolerance, and with vertical
/// distances, because a curve's axes have different units. Fewer points when no deviation is left. O(n log n) as a
/// rule, O(n count) at worst.
[[nodiscard]] inline KeptPoints douglasPeuckerToCount(std::span<const Breakpoint> dense, std::size_t count)
{
    if (dense.size() < 3)
        return allPoints(dense.size());
    return splitWorst(ComputableCurve(dense).points(), {0, dense.size() - 1}, count, 0.0);
}

/// The same split until no point deviates by more than `maxError` (0 or more).
[[nodiscard]] inline KeptPoints douglasPeuckerToBound(std::span<const Breakpoint> dense, double maxError)
{
    if (dense.size() < 3)
        return allPoints(dense.size());
    const ComputableCurve computable(dense);
    return splitWorst(computable.points(), {0, dense.size() - 1}, dense.size(), computable.scaled(maxError));
}

} // namespace pacini
