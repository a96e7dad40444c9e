#pragma once

// Incremental segment error: the squared error of a segment whose one end is fixed while the other moves on, in O(1)
// per step.

#include <pacini/simplify/DenseSamples.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pacini
{

/// Weighted squared vertical error of segments that start at one fixed sample. The sums are taken relative to that
/// sample, so that they do not cancel. The moving end may run forwards or backwards in time.
template <Samples S = DenseSamples>
class GrowingSegment
{
public:
    GrowingSegment() = default;
    GrowingSegment(const S& curve, std::size_t fixedEnd) noexcept : samples(curve), fixed(fixedEnd) {}

    /// The error of the samples included so far against the line from the fixed sample to sample `other`.
    [[nodiscard]] double errorTo(std::size_t other) const noexcept
    {
        const double slope = chordSlope(samples, fixed, other);
        return std::max(0.0, syy - slope * (2.0 * suy - slope * suu));
    }

    /// Adds sample m to the segment.
    void include(std::size_t m) noexcept
    {
        const double w = samples.weight(m);
        const double u = samples.time(m) - samples.time(fixed);
        const double y = samples.value(m) - samples.value(fixed);
        syy += w * y * y;
        suy += w * u * y;
        suu += w * u * u;
    }

private:
    S samples;
    std::size_t fixed = 0;
    double syy = 0.0, suy = 0.0, suu = 0.0;
};

/// Best place for a new point in a segment, and the reduction of the squared error.
struct SegmentSplit
{
    std::size_t index = 0;
    double gain = 0.0; ///< 0 when nothing can be gained (index is then the segment's first sample)
};

/// The best single split of the segment i-j, i < j; the lowest index on ties. `scratch` is working memory. O(j - i).
[[nodiscard]] inline SegmentSplit bestSplit(const DenseSamples& samples, std::size_t i, std::size_t j,
                                            std::vector<double>& scratch)
{
    scratch.resize(std::max(scratch.size(), j - i));
    GrowingSegment left(samples, i);
    for (std::size_t m = i + 1; m < j; ++m)
    {
        scratch[m - i] = left.errorTo(m);
        left.include(m);
    }
    SegmentSplit best{i, 0.0};
    const double whole = left.errorTo(j);
    GrowingSegment right(samples, j);
    for (std::size_t m = j - 1; m > i; --m)
    {
        const double gain = whole - (scratch[m - i] + right.errorTo(m));
        if (gain > 0.0 && gain >= best.gain)
            best = {m, gain};
        right.include(m);
    }
    return best;
}

} // namespace pacini
