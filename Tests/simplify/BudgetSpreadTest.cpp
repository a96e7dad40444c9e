#include "OptimalSquared.h"
#include "TestCurves.h"
#include "support/Catch.h"

#include <pacini/simplify/BudgetSpread.h>
#include <pacini/simplify/Optimal.h>

#include <algorithm>
#include <limits>

using namespace pacini;

namespace
{
std::vector<KeptPoints> equalSplit(const std::vector<BudgetCurve>& curves, std::size_t budget)
{
    std::vector<KeptPoints> kept;
    for (const BudgetCurve& curve : curves)
    {
        BudgetSpread spread;
        kept.push_back(spread.spread(std::span(&curve, 1), budget / curves.size()).value().kept.front());
    }
    return kept;
}

std::vector<BudgetCurve> curvesOf(const std::vector<std::vector<double>>& values)
{
    std::vector<BudgetCurve> curves(values.size());
    for (std::size_t c = 0; c < curves.size(); ++c)
        curves[c].samples.values = values[c];
    return curves;
}

/// Bands of one sound: the same strikes at different levels and with different ripple.
std::vector<std::vector<double>> bandsOf(std::size_t bands, std::size_t n, std::uint64_t seed)
{
    Random random(seed);
    std::vector<std::vector<double>> values;
    for (std::size_t b = 0; b < bands; ++b)
    {
        values.push_back(test::strikes(n, seed * 100 + b));
        const double level = std::pow(10.0, random.uniform(-2.0, 0.0));
        for (double& v : values.back())
            v *= level;
    }
    return values;
}
} // namespace

TEST_CASE("A shared budget beats equal shares on curves of unequal complexity", "[simplify]")
{
    const auto busy = test::strikes(3000, 1);
    std::vector<double> calm(3000), loudCalm(3000);
    for (std::size_t i = 0; i < calm.size(); ++i)
    {
        calm[i] = 0.02 * std::sin(0.002 * static_cast<double>(i));
        loudCalm[i] = 0.5 + 0.3 * std::sin(0.004 * static_cast<double>(i));
    }
    const std::vector<BudgetCurve> curves{{{busy, {}, {}}}, {{calm, {}, {}}}, {{loudCalm, {}, {}}}};
    BudgetSpread spread;
    const auto shared = spread.spread(curves, 90).value();
    CHECK(pointsOf(shared.kept) == 90);
    CHECK(shared.kept[0].size() > 50);
    CHECK(shared.pointCost > 0.0);
    CHECK(weightedError(curves, shared.kept) < 0.25 * weightedError(curves, equalSplit(curves, 90)));
}

TEST_CASE("A shared budget never loses against equal shares", "[simplify]")
{
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
    {
        const auto values = bandsOf(6, 1000, seed);
        auto curves = curvesOf(values);
        for (std::size_t budget : {18u, 40u, 48u, 90u, 300u})
        {
            CAPTURE(seed, budget);
            BudgetSpread spread;
            const auto shared = spread.spread(curves, budget).value().kept;
            CHECK(pointsOf(shared) <= budget);
            CHECK(weightedError(curves, shared) <= weightedError(curves, equalSplit(curves, budget)) * (1.0 + 1e-9));
        }
    }
}

TEST_CASE("A shared budget comes within 2 % of the exact optimum", "[simplify]")
{
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
    {
        const auto values = bandsOf(3, 150, seed);
        auto curves = curvesOf(values);
        for (std::size_t c = 0; c < curves.size(); ++c)
            curves[c].weight = 0.5 + static_cast<double>(c);
        constexpr std::size_t budget = 40;
        // Exact: the best error of each curve at each number of points, then the best sum for the budget.
        std::vector<double> best(budget + 1, 0.0);
        for (std::size_t c = 0; c < curves.size(); ++c)
        {
            std::vector<double> next(budget + 1, std::numeric_limits<double>::infinity());
            for (std::size_t own = 2; own <= budget; ++own)
            {
                const double error =
                    curves[c].weight * squaredError(curves[c].samples, test::optimalSquared(curves[c].samples, own));
                for (std::size_t all = own; all <= budget; ++all)
                    next[all] = std::min(next[all], best[all - own] + error);
            }
            best = next;
        }
        BudgetSpread spread;
        const auto shared = spread.spread(curves, budget).value().kept;
        CAPTURE(seed);
        CHECK(pointsOf(shared) <= budget);
        const double error = weightedError(curves, shared);
        CHECK(error >= best[budget] * (1.0 - 1e-9));
        CHECK(error <= best[budget] * 1.02);
    }
}

TEST_CASE("Weights, minima and limits of the budget are kept", "[simplify]")
{
    const auto values = bandsOf(3, 500, 9);
    auto curves = curvesOf(values);
    BudgetSpread spread;
    const auto even = spread.spread(curves, 45).value().kept;
    curves[2].weight = 1e4;
    const auto favoured = spread.spread(curves, 45).value().kept;
    CHECK(favoured[2].size() > even[2].size());
    CHECK(pointsOf(favoured) <= 45);

    curves[0].minimum = 11;
    curves[1].minimum = 7;
    const auto minima = spread.spread(curves, 45).value().kept;
    CHECK(minima[0].size() >= 11);
    CHECK(minima[1].size() >= 7);
    CHECK(pointsOf(minima) <= 45);
    const auto least = spread.spread(curves, 20).value().kept;
    CHECK(least[0].size() == 11);
    CHECK(least[1].size() == 7);
    CHECK(least[2].size() == 2);

    const auto all = spread.spread(curves, 5000).value().kept;
    for (const auto& kept : all)
        CHECK(kept == allPoints(500));
    CHECK(spread.spread({}, 0).value().kept.empty());
}

TEST_CASE("Points are removed as a search of all that are left would, one after the other", "[simplify]")
{
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
    {
        CAPTURE(seed);
        const std::vector<std::vector<double>> values{test::uniformNoise(24, seed), test::uniformNoise(17, seed + 100)};
        auto curves = curvesOf(values);
        curves[1].weight = 0.6;
        curves[1].minimum = 7;
        std::vector<KeptPoints> wanted{{}, {}};
        for (std::size_t c = 0; c < 2; ++c)
            for (std::size_t i = 0; i < values[c].size(); ++i)
                wanted[c].push_back(i);
        for (std::size_t budget = 40; budget >= 9; --budget)
        {
            double least = std::numeric_limits<double>::infinity();
            std::size_t curve = 0, place = 0;
            for (std::size_t c = 0; c < 2; ++c)
                for (std::size_t k = 1; k + 1 < wanted[c].size() && wanted[c].size() > curves[c].leastPoints(); ++k)
                {
                    auto without = wanted;
                    without[c].erase(without[c].begin() + static_cast<std::ptrdiff_t>(k));
                    if (const double error = weightedError(curves, without); error < least)
                    {
                        least = error;
                        curve = c;
                        place = k;
                    }
                }
            wanted[curve].erase(wanted[curve].begin() + static_cast<std::ptrdiff_t>(place));
            std::vector<KeptPoints> kept{{}, {}};
            for (std::size_t c = 0; c < 2; ++c)
                for (std::size_t i = 0; i < values[c].size(); ++i)
                    kept[c].push_back(i);
            removeWorstPoints(curves, budget, kept);
            REQUIRE(kept == wanted);
        }
    }
}

TEST_CASE("Points are added where a search of all would put the next one", "[simplify]")
{
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
    {
        CAPTURE(seed);
        const std::vector<std::vector<double>> values{test::uniformNoise(24, seed), test::uniformNoise(17, seed + 100)};
        auto curves = curvesOf(values);
        curves[0].weight = 0.6;
        std::vector<KeptPoints> wanted{{0, 23}, {0, 16}};
        for (std::size_t budget = 5; budget <= 20; ++budget)
        {
            double least = weightedError(curves, wanted);
            auto best = wanted;
            for (std::size_t c = 0; c < 2; ++c)
                for (std::size_t i = 1; i + 1 < values[c].size(); ++i)
                {
                    auto with = wanted;
                    const auto place = std::lower_bound(with[c].begin(), with[c].end(), i);
                    if (*place == i)
                        continue;
                    with[c].insert(place, i);
                    if (const double error = weightedError(curves, with); error < least)
                    {
                        least = error;
                        best = with;
                    }
                }
            wanted = best;
            std::vector<KeptPoints> kept{{0, 23}, {0, 16}};
            addBestPoints(curves, budget, kept);
            REQUIRE(kept == wanted);
        }
    }
}

TEST_CASE("Curves that need no points leave them to the others", "[simplify]")
{
    const std::vector<double> silence(2000, 0.0), one{0.5}, none;
    const auto busy = test::strikes(2000, 3);
    const std::vector<BudgetCurve> curves{{{silence, {}, {}}}, {{busy, {}, {}}}, {{one, {}, {}}}, {{none, {}, {}}}};
    BudgetSpread spread;
    const auto kept = spread.spread(curves, 50).value().kept;
    CHECK(kept[0] == KeptPoints{0, 1999});
    CHECK(kept[1].size() == 47);
    CHECK(kept[2] == KeptPoints{0});
    CHECK(kept[3].empty());
    const std::vector<BudgetCurve> silent{{{silence, {}, {}}}};
    CHECK(spread.spread(silent, 50).value().kept[0] == KeptPoints{0, 1999});
}

TEST_CASE("A good first price changes nothing but the time", "[simplify]")
{
    const auto values = bandsOf(4, 800, 15);
    auto curves = curvesOf(values);
    BudgetSpread spread;
    const auto first = spread.spread(curves, 100).value();
    const auto again = spread.spread(curves, 100, first.pointCost).value();
    CHECK(pointsOf(again.kept) == pointsOf(first.kept));
    CHECK(weightedError(curves, again.kept) <= weightedError(curves, first.kept) * 1.02);
}

TEST_CASE("Impossible budgets and weights are errors", "[simplify]")
{
    const auto values = test::strikes(100, 1);
    std::vector<BudgetCurve> curves{{{values, {}, {}}}, {{values, {}, {}}}};
    BudgetSpread spread;
    const auto small = spread.spread(curves, 3);
    REQUIRE(!small);
    CHECK(small.error().code == ErrorCode::invalidArgument);
    CHECK(small.error().where == "budget");
    for (double weight : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    {
        curves[1].weight = weight;
        const auto result = spread.spread(curves, 30);
        REQUIRE(!result);
        CHECK(result.error().where == "curves[1].weight");
    }
}
