#pragma once

// Pre-thinning of very dense curves, for the methods whose time grows with the samples per point.

#include <pacini/simplify/DenseSamples.h>
#include <pacini/simplify/KeptPoints.h>
#include <pacini/simplify/Visvalingam.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// What Visvalingam's elimination leaves of a dense curve; each point stands for the samples halfway to its neighbours.
class ThinnedSamples
{
public:
    /// Keeps `count` points (2 at least) of `dense`.
    ThinnedSamples(std::span<const Breakpoint> dense, std::size_t count) : points(visvalingamToCount(dense, count))
    {
        for (std::size_t k = 0; k < points.size(); ++k)
        {
            values.push_back(dense[points[k]].value);
            times.push_back(dense[points[k]].time);
            const std::size_t before = points[k == 0 ? 0 : k - 1];
            const std::size_t after = points[std::min(k + 1, points.size() - 1)];
            weights.push_back(0.5 * static_cast<double>(after - before));
        }
    }

    [[nodiscard]] DenseSamples samples() const noexcept { return {values, times, weights}; }

    /// Turns indices into samples() to indices into the dense curve.
    void toDense(KeptPoints& kept) const noexcept
    {
        for (std::size_t& k : kept)
            k = points[k];
    }

private:
    KeptPoints points;
    std::vector<double> values, times, weights;
};

} // namespace pacini
