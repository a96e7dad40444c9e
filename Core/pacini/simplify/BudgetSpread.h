#pragma once

// Budget allocation: one budget of breakpoints for several curves.

#include <pacini/foundation/Result.h>
#include <pacini/simplify/GreedyBudget.h>
#include <pacini/simplify/KeptPoints.h>
#include <pacini/simplify/Lagrangian.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// Result of budget allocation: the share of each curve, and the price per point, a good first guess for a similar
/// task.
struct BudgetShares
{
    std::vector<KeptPoints> kept; ///< per curve
    double pointCost = 0.0;       ///< weighted squared error that one point more would save, roughly
};

/// Spreads a budget of points over curves so that the sum of weight x squared vertical errors is as low as possible.
///
/// Every curve is simplified at the same price per point (Everett, "Generalized Lagrange multiplier method", 1963: at
/// one price no point can be moved to where it helps more). The price that meets the budget is found on the lower
/// convex hull of error over points: close to the budget, of two prices on either side of it, the next one tried is the
/// slope between their results (Shoham and Gersho, "Efficient bit allocation for an arbitrary set of quantizers",
/// 1988), which ends when the hull has no corner in between. From the corner below, points are added where they help
/// most; from the corner above, removed where they harm least; the better of the two is taken. Where there are only a
/// few points per curve, equal shares are tried as well.
///
/// An object is a workspace and can be used again.
class BudgetSpread
{
public:
    /// Segments longer than `maxSegmentLength` samples are found only by LagrangianSegmenter's rules for quiet
    /// stretches: choose it several times longer than the mean segment.
    explicit BudgetSpread(std::size_t maxSegmentLength = 256) : segmenter(maxSegmentLength) {}

    /// The kept points of each curve, at most `budget` in all: fewer only where no single point more would lower the
    /// error. `firstPointCost` above 0 starts the search. invalidArgument: a weight that is not above 0, or a budget
    /// below the sum of the minima.
    Result<BudgetShares> spread(std::span<const BudgetCurve> curves, std::size_t budget, double firstPointCost = 0.0)
    {
        std::size_t least = 0;
        std::size_t most = 0;
        for (std::size_t c = 0; c < curves.size(); ++c)
        {
            if (!(curves[c].weight > 0.0) || !std::isfinite(curves[c].weight))
                return Error{ErrorCode::invalidArgument, "curves[" + std::to_string(c) + "].weight", "is not above 0"};
            least += curves[c].leastPoints();
            most += curves[c].samples.size();
        }
        if (budget < least)
            return Error{ErrorCode::invalidArgument, "budget",
                         "is below the " + std::to_string(least) + " points that the curves need at least"};
        Bracket found{leastAllocation(curves), {}, false, false};
        Allocation& best = found.few;
        if (budget >= most)
            for (std::size_t c = 0; c < curves.size(); ++c)
                best.kept[c] = allPoints(curves[c].samples.size());
        else if (best.points < budget && best.error > 0.0)
            search(curves, budget, firstPointCost, found);
        addBestPoints(curves, budget, best.kept);
        if (found.hasMany)
        {
            removeWorstPoints(curves, budget, found.many.kept);
            if (weightedError(curves, found.many.kept) < weightedError(curves, best.kept))
                best = std::move(found.many);
        }
        if (budget < most && budget < coarse * curves.size())
            tryEqualShares(curves, budget, best);
        return BudgetShares{std::move(best.kept), best.pointCost};
    }

private:
    struct Allocation
    {
        double pointCost = 0.0;
        std::size_t points = 0;
        double error = 0.0;
        std::vector<KeptPoints> kept;
    };

    /// Below so many points per curve the hull has few corners, and single points no longer make up for it.
    static constexpr std::size_t coarse = 8;

    /// A curve that has `count` points to itself.
    [[nodiscard]] KeptPoints alone(const BudgetCurve& curve, std::size_t count) const
    {
        const std::size_t n = curve.samples.size();
        if (count <= 2 || n < 3)
            return n < 3 ? allPoints(n) : KeptPoints{0, n - 1};
        const BudgetCurve one{curve.samples, 1.0, 2};
        return BudgetSpread(*this).spread(std::span(&one, 1), count).value().kept.front();
    }

    /// Every curve at its minimum: the end of the hull where points are dearest.
    Allocation leastAllocation(std::span<const BudgetCurve> curves)
    {
        Allocation allocation;
        for (const BudgetCurve& curve : curves)
            allocation.kept.push_back(alone(curve, curve.leastPoints()));
        minima = allocation.kept;
        total(curves, allocation);
        return allocation;
    }

    void tryEqualShares(std::span<const BudgetCurve> curves, std::size_t budget, Allocation& best) const
    {
        if (curves.size() < 2)
            return;
        Allocation equal;
        for (const BudgetCurve& curve : curves)
            equal.kept.push_back(alone(curve, std::max(curve.leastPoints(), budget / curves.size())));
        if (pointsOf(equal.kept) > budget)
            return;
        addBestPoints(curves, budget, equal.kept);
        if (weightedError(curves, equal.kept) < weightedError(curves, best.kept))
            best.kept = std::move(equal.kept);
    }

    static void total(std::span<const BudgetCurve> curves, Allocation& allocation)
    {
        allocation.points = pointsOf(allocation.kept);
        allocation.error = weightedError(curves, allocation.kept);
    }

    void allocate(std::span<const BudgetCurve> curves, double pointCost, Allocation& allocation)
    {
        allocation.pointCost = pointCost;
        allocation.kept.resize(curves.size());
        for (std::size_t c = 0; c < curves.size(); ++c)
            if (segmenter.solve(curves[c].samples, pointCost / curves[c].weight, allocation.kept[c]) <
                curves[c].leastPoints())
                allocation.kept[c] = minima[c];
        total(curves, allocation);
    }

    /// Corners of the hull on both sides of the budget.
    struct Bracket
    {
        Allocation few;  ///< within the budget; the least allocation until a better one is found
        Allocation many; ///< over the budget
        bool hasFew = false;
        bool hasMany = false;

        [[nodiscard]] bool complete() const noexcept { return hasFew && hasMany; }
        [[nodiscard]] bool contains(std::size_t points) const noexcept
        {
            return (!hasFew || points > few.points) && (!hasMany || points < many.points);
        }
    };

    void search(std::span<const BudgetCurve> curves, std::size_t budget, double firstPointCost, Bracket& found)
    {
        constexpr int maxTries = 60;
        // Stop this close below: single points then lose nothing visible.
        const std::size_t enough = budget - budget / 64;
        const double wanted = 0.5 * static_cast<double>(budget + enough);
        const double wholeError = found.few.error;
        double price = firstPointCost > 0.0 ? firstPointCost : 0.01 * wholeError / wanted;
        bool onHull = false;
        Allocation tried;
        for (int i = 0; i < maxTries && price > 0.0 && found.few.points < enough; ++i)
        {
            allocate(curves, price, tried);
            const bool corner = found.contains(tried.points);
            if (onHull && !corner)
                return;
            const double ratio = static_cast<double>(tried.points) / wanted;
            if (tried.points <= budget && tried.error <= found.few.error)
            {
                std::swap(found.few, tried);
                found.hasFew = true;
            }
            else if (tried.points > budget && (!found.hasMany || tried.points <= found.many.points))
            {
                std::swap(found.many, tried);
                found.hasMany = true;
            }
            if (found.few.error <= 1e-15 * wholeError)
                return;
            // Far from the budget, the number of points goes roughly like a power of the price; on smooth curves, whose
            // error falls with the fourth power of the points, with exponent -1/5.
            onHull = found.complete() && !(corner && found.many.points - found.few.points > budget / 8);
            if (onHull)
                price =
                    (found.few.error - found.many.error) / static_cast<double>(found.many.points - found.few.points);
            else if (found.complete())
                price = betweenPrices(found.few, found.many, wanted);
            else
                price *= ratio > 1.0 ? std::clamp(std::pow(ratio, 4.0), 1.5, 1e4)
                                     : std::clamp(std::pow(ratio, 4.0), 1e-4, 0.7);
        }
    }

    /// The price where a power law through both results meets `wanted` points.
    static double betweenPrices(const Allocation& few, const Allocation& many, double wanted) noexcept
    {
        const auto fewest = static_cast<double>(few.points);
        const auto most = static_cast<double>(many.points);
        const double share = std::log(most / wanted) / std::log(most / fewest);
        return many.pointCost * std::pow(few.pointCost / many.pointCost, share);
    }

    LagrangianSegmenter segmenter;
    std::vector<KeptPoints> minima;
};

} // namespace pacini
