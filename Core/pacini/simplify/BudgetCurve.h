#pragma once

// Input of budget allocation: curves that share one budget of points, and what an allocation to them costs.

#include <pacini/simplify/DenseSamples.h>
#include <pacini/simplify/KeptPoints.h>

#include <algorithm>
#include <cstddef>
#include <span>
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

} // namespace pacini
