#pragma once

// Greedy budget correction: meets a budget of points exactly, from an allocation that is close to it, one point at a
// time.

#include <pacini/simplify/DenseSamples.h>
#include <pacini/simplify/GrowingSegment.h>
#include <pacini/simplify/KeptPoints.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// A curve that takes part in a shared budget.
struct BudgetCurve
{
    DenseSamples samples;
    double weight = 1.0;     ///< of its squared errors, above 0
    std::size_t minimum = 2; ///< points that it keeps at least (all of them when it has fewer)

    /// The minimum that really holds: the end points are always kept.
    [[nodiscard]] std::size_t leastPoints() const noexcept
    {
        return std::min(std::max<std::size_t>(minimum, 2), samples.size());
    }
};

/// All points of an allocation; `kept` has one entry per curve.
[[nodiscard]] inline std::size_t pointsOf(std::span<const KeptPoints> kept) noexcept
{
    std::size_t sum = 0;
    for (const KeptPoints& k : kept)
        sum += k.size();
    return sum;
}

/// The sum of weight x squared error over all curves; `kept` has one entry per curve.
[[nodiscard]] inline double weightedError(std::span<const BudgetCurve> curves,
                                          std::span<const KeptPoints> kept) noexcept
{
    double sum = 0.0;
    for (std::size_t c = 0; c < curves.size(); ++c)
        sum += curves[c].weight * squaredError(curves[c].samples, kept[c]);
    return sum;
}

/// Adds to `kept` (one entry per curve) the points that lower the weighted squared error most, until there are `budget`
/// in all or nothing is left to gain. Each is the best split of one segment. O(n + added x segment length).
inline void addBestPoints(std::span<const BudgetCurve> curves, std::size_t budget, std::span<KeptPoints> kept)
{
    struct Candidate
    {
        double gain;
        std::size_t curve, first, split, last;
        bool operator<(const Candidate& other) const noexcept { return gain < other.gain; }
    };
    std::vector<Candidate> heap;
    std::vector<double> scratch;
    const auto consider = [&](std::size_t c, std::size_t first, std::size_t last)
    {
        const SegmentSplit split = bestSplit(curves[c].samples, first, last, scratch);
        if (split.gain <= 0.0)
            return;
        heap.push_back({curves[c].weight * split.gain, c, first, split.index, last});
        std::push_heap(heap.begin(), heap.end());
    };
    std::size_t points = pointsOf(kept);
    if (points >= budget)
        return;
    for (std::size_t c = 0; c < curves.size(); ++c)
        for (std::size_t k = 1; k < kept[c].size(); ++k)
            consider(c, kept[c][k - 1], kept[c][k]);
    for (; points < budget && !heap.empty(); ++points)
    {
        std::pop_heap(heap.begin(), heap.end());
        const Candidate best = heap.back();
        heap.pop_back();
        kept[best.curve].push_back(best.split);
        consider(best.curve, best.first, best.split);
        consider(best.curve, best.split, best.last);
    }
    for (KeptPoints& k : kept)
        std::sort(k.begin(), k.end());
}

/// Removes from `kept` (one entry per curve) the inner points that raise the weighted squared error least, until
/// `budget` are left in all or every curve is at its least. O(n + removed x segment length).
inline void removeWorstPoints(std::span<const BudgetCurve> curves, std::size_t budget, std::span<KeptPoints> kept)
{
    struct Point
    {
        std::size_t curve, sample, before, after; ///< neighbours as indices into `points`
    };
    struct Candidate
    {
        double harm;
        std::size_t point, before, after; ///< out of date when the point's neighbours are no longer these
        bool operator<(const Candidate& other) const noexcept { return harm > other.harm; }
    };
    std::vector<Point> points;
    std::vector<Candidate> heap;
    std::vector<std::size_t> left;
    const auto consider = [&](std::size_t p)
    {
        const Point& point = points[p];
        if (point.before == p || point.after == p)
            return;
        const BudgetCurve& curve = curves[point.curve];
        const std::size_t first = points[point.before].sample;
        const std::size_t last = points[point.after].sample;
        const double harm = squaredError(curve.samples, first, last) -
                            squaredError(curve.samples, first, point.sample) -
                            squaredError(curve.samples, point.sample, last);
        heap.push_back({curve.weight * harm, p, point.before, point.after});
        std::push_heap(heap.begin(), heap.end());
    };
    std::size_t total = pointsOf(kept);
    if (total <= budget)
        return;
    for (std::size_t c = 0; c < curves.size(); ++c)
    {
        const std::size_t start = points.size();
        const std::size_t count = kept[c].size();
        for (std::size_t k = 0; k < count; ++k)
            points.push_back({c, kept[c][k], start + (k == 0 ? 0 : k - 1), start + std::min(k + 1, count - 1)});
        left.push_back(count);
    }
    for (std::size_t p = 0; p < points.size(); ++p)
        consider(p);
    while (total > budget && !heap.empty())
    {
        std::pop_heap(heap.begin(), heap.end());
        const Candidate worst = heap.back();
        heap.pop_back();
        const Point point = points[worst.point];
        if (point.before != worst.before || point.after != worst.after ||
            left[point.curve] <= curves[point.curve].leastPoints())
            continue;
        points[point.before].after = point.after;
        points[point.after].before = point.before;
        points[worst.point].before = points[worst.point].after = worst.point;
        --left[point.curve];
        --total;
        consider(point.before);
        consider(point.after);
    }
    std::size_t p = 0;
    for (std::size_t c = 0; c < curves.size(); ++c)
    {
        const std::size_t count = kept[c].size();
        KeptPoints remaining;
        for (std::size_t k = 0; k < count; ++k, ++p)
            if (k == 0 || k + 1 == count || points[p].before != p)
                remaining.push_back(points[p].sample);
        kept[c] = std::move(remaining);
    }
}

} // namespace pacini
