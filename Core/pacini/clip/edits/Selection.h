#pragma once

// Selection of points and transients in a clip.

#include <pacini/clip/edits/Lane.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <vector>

namespace pacini
{

/// Ascending indices into the points of a curve or the transients of a clip.
using Indices = std::vector<std::size_t>;

/// Selected points of one lane.
struct LaneSelection
{
    Lane lane;
    Indices points;
    bool operator==(const LaneSelection&) const = default;
};

/// Selected points of all lanes, and selected transients.
struct Selection
{
    std::vector<LaneSelection> lanes;
    Indices transients;
    bool operator==(const Selection&) const = default;
};

/// The points of a curve inside a marquee, edges included. O(log n + points in the time range).
[[nodiscard]] inline Indices pointsInside(const Curve& curve, TimeRange times, ValueRange values)
{
    Indices found;
    const auto first = std::lower_bound(curve.begin(), curve.end(), times.from,
                                        [](const Breakpoint& p, double t) { return p.time < t; });
    for (auto p = first; p != curve.end() && p->time <= times.to; ++p)
        if (p->value >= values.low && p->value <= values.high)
            found.push_back(static_cast<std::size_t>(p - curve.begin()));
    return found;
}

/// The transients of a clip inside a marquee of times and amplitudes, edges included.
[[nodiscard]] inline Indices transientsInside(const Clip& clip, TimeRange times, ValueRange amplitudes)
{
    Indices found;
    for (std::size_t i = 0; i < clip.transients.size(); ++i)
    {
        const Transient& event = clip.transients[i];
        if (event.time >= times.from && event.time <= times.to && event.amplitude >= amplitudes.low &&
            event.amplitude <= amplitudes.high)
            found.push_back(i);
    }
    return found;
}

/// Every index of something with `count` elements.
[[nodiscard]] inline Indices allIndices(std::size_t count)
{
    Indices all(count);
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

/// Set union (shift-marquee adds).
[[nodiscard]] inline Indices unionOf(const Indices& a, const Indices& b)
{
    Indices both;
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return both;
}

/// Symmetric difference: elements of exactly one of the two (control-click toggles).
[[nodiscard]] inline Indices toggled(const Indices& a, const Indices& b)
{
    Indices either;
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(either));
    return either;
}

} // namespace pacini
