#pragma once

// Optimal simplification at a price per point: dynamic programming over the whole curve.

#include <pacini/simplify/DenseSamples.h>
#include <pacini/simplify/GrowingSegment.h>
#include <pacini/simplify/KeptPoints.h>
#include <pacini/simplify/SegmentCost.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <vector>

namespace pacini
{

/// Keeps the points that minimise  sum of w (vertical error)^2 + pointCost * points,  first and last point included.
///
/// Dynamic programming (Bellman, "On the approximation of curves by line segments using dynamic programming", 1961;
/// the price per point is the Lagrangian form of a point budget: Everett 1963, Shoham and Gersho, "Efficient bit
/// allocation for an arbitrary set of quantizers", 1988):
///     cost(0) = pointCost,  cost(j) = min over i < j of cost(i) + error(i, j) + pointCost.
/// Chosen over greedy removal or splitting because it is the optimum for its number of points, in linear time.
///
/// Exact for all segments of up to maxSegmentLength samples. Starts are tried from the newest back and the search ends
/// as soon as no older start can win (SegmentCost::lowerBound), so its cost follows the real segment lengths. Two
/// things keep long quiet stretches from being cut every maxSegmentLength samples:
///  - samples that lie exactly on one line (digital silence, ramps of exact numbers) are one run: any start in it
///    reaches its end without error, so the cheapest is remembered and the run is not searched at all;
///  - one start beyond the window, the cheapest of a long run or else the oldest of the window, is carried along for as
///    long as going through it costs at most one point more than the best (noise floors, slow decays, single bits
///    that flip in silence). It can only improve the result.
///
/// An object is a workspace: solve() allocates only when a curve is longer than all before. One thread at a time.
template <Samples S>
class LagrangianSegmenterOf
{
public:
    /// Segments of at least `maxSegmentLength` samples (1 or more) are searched exactly.
    explicit LagrangianSegmenterOf(std::size_t maxSegmentLength = 256)
        : even(maxSegmentLength), general(maxSegmentLength), costs(even.span() + 2 * SegmentCost<true>::block)
    {
    }

    /// After this, solve() does not allocate for up to `samples` samples, if `kept` has room for as many points.
    void reserve(std::size_t samples) { from.resize(std::max(from.size(), samples)); }

    /// Fills `kept` with the optimum for `pointCost` (above 0, in squared value units) and returns its number of
    /// points. Fewer than 3 samples are all kept. At most 2^32 - 1 samples, all finite. O(n).
    std::size_t solve(const S& samples, double pointCost, KeptPoints& kept)
    {
        assert(samples.size() < std::numeric_limits<std::uint32_t>::max());
        if (samples.size() < 3)
        {
            kept.clear();
            for (std::size_t i = 0; i < samples.size(); ++i)
                kept.push_back(i);
            return kept.size();
        }
        reserve(samples.size());
        if (samples.evenlySpaced() && !samples.weighted())
            sweep(even, samples, pointCost);
        else
            sweep(general, samples, pointCost);
        followBack(std::span(from).first(samples.size()), kept);
        return kept.size();
    }

private:
    /// The longest stretch of samples exactly on one line that ends at the newest sample, and its cheapest start.
    struct StraightRun
    {
        std::size_t first = 0;
        std::size_t cheapest = 0;
        double cost = 0.0;

        /// Takes in sample j, given the cost of the sample before; false when it starts a new run.
        bool advance(const S& samples, std::size_t j, double costBefore) noexcept
        {
            const bool goesOn = j >= 2 && onOneLine(samples, j);
            if (!goesOn)
                first = j - 1;
            if (!goesOn || costBefore < cost)
            {
                cheapest = j - 1;
                cost = costBefore;
            }
            return goesOn;
        }

        static bool onOneLine(const S& samples, std::size_t j) noexcept
        {
            const double rise = samples.value(j) - samples.value(j - 1);
            const double riseBefore = samples.value(j - 1) - samples.value(j - 2);
            if (samples.evenlySpaced())
                return rise == riseBefore;
            const double run = samples.time(j) - samples.time(j - 1);
            const double runBefore = samples.time(j - 1) - samples.time(j - 2);
            return run > 0.0 && runBefore > 0.0 && rise * runBefore == riseBefore * run;
        }
    };

    /// The start beyond the window.
    struct FarStart
    {
        bool alive = false;
        std::size_t start = 0;
        double cost = 0.0;
        GrowingSegment<S> segment;

        void become(const S& samples, std::size_t newStart, std::size_t j, double costOfStart) noexcept
        {
            *this = {true, newStart, costOfStart, GrowingSegment(samples, newStart)};
            for (std::size_t m = start + 1; m <= j; ++m)
                segment.include(m);
        }
    };

    template <bool Even>
    void sweep(SegmentCost<Even, S>& segments, const S& samples, double pointCost) noexcept
    {
        constexpr std::size_t block = SegmentCost<Even, S>::block;
        const std::size_t span = segments.span();
        segments.begin(samples);
        segments.advance();
        segments.setCost(pointCost);
        StraightRun run;
        FarStart distant;
        for (std::size_t j = 1; j < samples.size(); ++j)
        {
            const StraightRun before = run;
            if (!run.advance(samples, j, segments.costAt(0)) && j - before.first > span &&
                (!distant.alive || before.cost < distant.cost))
                distant.become(samples, before.cheapest, j - 1, before.cost);
            segments.advance();
            double best = run.cost;
            std::size_t bestStart = run.cheapest;

            // Starts older than the run, in blocks; which start won is looked up once, after the search.
            std::size_t bestLag = 0;
            const std::size_t runLength = j - run.first;
            std::size_t lag = runLength;
            bool searchedAll = runLength >= span;
            while (lag < span)
            {
                lag += block;
                double* const via = costs.data() + (costs.size() - lag);
                segments.costsVia(lag, via);
                const double least = leastOf(via);
                bestLag = least < best ? lag : bestLag;
                best = std::min(least, best);
                searchedAll = lag >= span;
                if (!searchedAll && segments.lowerBound(lag) >= best)
                    break;
            }
            if (bestLag != 0)
                bestStart = j - bestLag + placeOf(best, costs.data() + (costs.size() - bestLag));

            if (distant.alive)
            {
                distant.segment.include(j);
                const double via = distant.cost + distant.segment.errorTo(j);
                if (via < best)
                {
                    best = via;
                    bestStart = distant.start;
                }
                distant.alive = via <= best + pointCost;
            }
            if (!distant.alive && searchedAll && runLength < span && j >= span)
                distant.become(samples, j - span, j, segments.costAt(span));

            segments.setCost(best + pointCost);
            from[j] = static_cast<std::uint32_t>(bestStart);
        }
    }

    /// The least of a block, as a tree of fixed size without branches.
    static double leastOf(const double* via) noexcept
    {
        constexpr std::size_t block = SegmentCost<true>::block;
        double least[block / 2];
        for (std::size_t k = 0; k < block / 2; ++k)
            least[k] = via[k + block / 2] < via[k] ? via[k + block / 2] : via[k];
        for (std::size_t half = block / 4; half >= 1; half /= 2)
            for (std::size_t k = 0; k < half; ++k)
                least[k] = least[k + half] < least[k] ? least[k + half] : least[k];
        return least[0];
    }

    static std::size_t placeOf(double least, const double* via) noexcept
    {
        std::size_t place = 0;
        for (std::size_t k = 0; k < SegmentCost<true>::block; ++k)
            place = via[k] == least ? k : place;
        return place;
    }

    SegmentCost<true, S> even;
    SegmentCost<false, S> general;
    std::vector<double> costs; ///< costs via the starts of the window, by falling lag
    std::vector<std::uint32_t> from;
};

/// The segmenter for DenseSamples.
using LagrangianSegmenter = LagrangianSegmenterOf<DenseSamples>;

} // namespace pacini
