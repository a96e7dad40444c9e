#pragma once

// Line simplification by Visvalingam and Whyatt: removes the least important point first.

#include <pacini/simplify/ComputableCurve.h>
#include <pacini/simplify/Deviation.h>
#include <pacini/simplify/KeptPoints.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

namespace detail
{

/// The area of the triangle a, b, c: the effect of removing b.
[[nodiscard]] inline double triangleArea(const Breakpoint& a, const Breakpoint& b, const Breakpoint& c) noexcept
{
    return 0.5 * std::abs((b.time - a.time) * (c.value - a.value) - (c.time - a.time) * (b.value - a.value));
}

/// The inner points of a curve as a binary heap with the least area on top (the lower index on ties). It knows the
/// place of each point, so that a changed area moves within the heap: it never holds a stale entry.
class AreaHeap
{
public:
    /// All inner points of `dense`, at least 3 points. O(n).
    explicit AreaHeap(std::span<const Breakpoint> dense) : areas(dense.size(), 0.0), places(dense.size(), none)
    {
        heap.reserve(dense.size() - 2);
        for (std::size_t i = 1; i + 1 < dense.size(); ++i)
        {
            areas[i] = triangleArea(dense[i - 1], dense[i], dense[i + 1]);
            places[i] = heap.size();
            heap.push_back(i);
        }
        for (std::size_t at = heap.size() / 2; at-- > 0;)
            sink(at);
    }

    [[nodiscard]] bool empty() const noexcept { return heap.empty(); }
    [[nodiscard]] std::size_t top() const noexcept { return heap.front(); }

    void pop() noexcept
    {
        places[heap.front()] = none;
        const std::size_t last = heap.back();
        heap.pop_back();
        if (heap.empty())
            return;
        put(0, last);
        sink(0);
    }

    /// Sets the area of `point`, which comes back if it had been popped.
    void update(std::size_t point, double area)
    {
        areas[point] = area;
        if (places[point] == none)
        {
            heap.push_back(point);
            places[point] = heap.size() - 1;
        }
        rise(places[point]);
        sink(places[point]);
    }

private:
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    [[nodiscard]] bool before(std::size_t a, std::size_t b) const noexcept
    {
        return areas[a] < areas[b] || (areas[a] == areas[b] && a < b);
    }

    void put(std::size_t at, std::size_t point) noexcept
    {
        heap[at] = point;
        places[point] = at;
    }

    void rise(std::size_t at) noexcept
    {
        const std::size_t point = heap[at];
        for (; at > 0 && before(point, heap[(at - 1) / 2]); at = (at - 1) / 2)
            put(at, heap[(at - 1) / 2]);
        put(at, point);
    }

    void sink(std::size_t at) noexcept
    {
        const std::size_t point = heap[at];
        for (std::size_t child = 2 * at + 1; child < heap.size(); child = 2 * at + 1)
        {
            if (child + 1 < heap.size() && before(heap[child + 1], heap[child]))
                ++child;
            if (!before(heap[child], point))
                break;
            put(at, heap[child]);
            at = child;
        }
        put(at, point);
    }

    std::vector<double> areas;
    std::vector<std::size_t> places;
    std::vector<std::size_t> heap;
};

/// Removes points in order of area while more than `count` are left. `mayRemove(before, point, after)` can refuse one,
/// which then waits until a neighbour has gone.
template <typename MayRemove>
[[nodiscard]] KeptPoints eliminate(std::span<const Breakpoint> dense, std::size_t count, MayRemove mayRemove)
{
    const std::size_t n = dense.size();
    if (n < 3)
        return allPoints(n);
    AreaHeap heap(dense);
    std::vector<std::pair<std::size_t, std::size_t>> neighbours(n);
    for (std::size_t i = 0; i < n; ++i)
        neighbours[i] = {i == 0 ? 0 : i - 1, i + 1};
    std::vector<bool> removed(n, false);
    for (std::size_t left = n; left > count && !heap.empty();) // the ends are not in the heap
    {
        const std::size_t point = heap.top();
        heap.pop();
        const auto [before, after] = neighbours[point];
        if (!mayRemove(before, point, after))
            continue;
        removed[point] = true;
        --left;
        neighbours[before].second = after;
        neighbours[after].first = before;
        for (const std::size_t p : {before, after})
            if (p != 0 && p != n - 1)
                heap.update(p, triangleArea(dense[neighbours[p].first], dense[p], dense[neighbours[p].second]));
    }
    KeptPoints kept;
    for (std::size_t i = 0; i < n; ++i)
        if (!removed[i])
            kept.push_back(i);
    return kept;
}

} // namespace detail

/// The `count` points (2 at least) that are left when the point of the smallest triangle with its neighbours is removed
/// again and again; the lower index goes first on ties. Visvalingam and Whyatt, "Line generalisation by repeated
/// elimination of points", 1993; areas as they are, not raised to that of the point removed before. O(n log n).
/// A curve of no more than `count` points is kept whole.
[[nodiscard]] inline KeptPoints visvalingamToCount(std::span<const Breakpoint> dense, std::size_t count)
{
    const ComputableCurve computable(dense);
    return detail::eliminate(computable.points(), count, [](std::size_t, std::size_t, std::size_t) { return true; });
}

/// The same order of removal, but no removal that would bring the maximum vertical error above `maxError` (0 or more).
/// Near O(n log n): a segment's error is bounded by its parts' and the removed point's own deviation, and the points
/// are only looked at where that bound is too large.
[[nodiscard]] inline KeptPoints visvalingamToBound(std::span<const Breakpoint> curve, double maxError)
{
    const ComputableCurve computable(curve);
    const auto dense = computable.points();
    maxError = computable.scaled(maxError);
    std::vector<double> bound(dense.size(), 0.0); // of the segment that starts here
    const auto mayRemove = [&](std::size_t before, std::size_t point, std::size_t after)
    {
        const Breakpoint& a = dense[before];
        const double duration = dense[after].time - a.time;
        const double slope = duration > 0.0 ? (dense[after].value - a.value) / duration : 0.0;
        const double moved = std::abs(dense[point].value - (a.value + slope * (dense[point].time - a.time)));
        double merged = std::max(bound[before], bound[point]) + moved;
        if (merged > maxError)
            merged = maxDeviation(dense, before, after).value;
        if (merged > maxError)
            return false;
        bound[before] = merged;
        return true;
    };
    return detail::eliminate(dense, 2, mayRemove);
}

} // namespace pacini
