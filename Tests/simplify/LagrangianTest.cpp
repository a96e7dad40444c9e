#include "TestCurves.h"
#include "support/Catch.h"
#include "support/HeapGuard.h"

#include <pacini/simplify/Lagrangian.h>

#include <limits>

using namespace pacini;

namespace
{
/// Squared error of one segment in long double, sample by sample.
long double longError(const DenseSamples& s, std::size_t i, std::size_t j)
{
    const long double span = static_cast<long double>(s.time(j)) - s.time(i);
    const long double slope = span > 0.0L ? (static_cast<long double>(s.values[j]) - s.values[i]) / span : 0.0L;
    long double sum = 0.0L;
    for (std::size_t m = i + 1; m < j; ++m)
    {
        const long double e = s.values[m] - s.values[i] - slope * (static_cast<long double>(s.time(m)) - s.time(i));
        sum += s.weight(m) * e * e;
    }
    return sum;
}

long double longCost(const DenseSamples& s, const KeptPoints& kept, long double pointCost)
{
    long double cost = pointCost * static_cast<long double>(kept.size());
    for (std::size_t k = 1; k < kept.size(); ++k)
        cost += longError(s, kept[k - 1], kept[k]);
    return cost;
}

/// The least cost of all paths with segments of up to `longest` samples: plain dynamic programming in long double, with
/// sums that grow from each start and no pruning.
long double leastCost(const DenseSamples& s, long double pointCost, std::size_t longest)
{
    const std::size_t n = s.size();
    std::vector<long double> cost(n, std::numeric_limits<long double>::max());
    cost[0] = pointCost;
    for (std::size_t i = 0; i + 1 < n; ++i)
    {
        long double syy = 0.0L, suy = 0.0L, suu = 0.0L;
        for (std::size_t j = i + 1; j < std::min(n, i + longest + 1); ++j)
        {
            const long double u = static_cast<long double>(s.time(j)) - s.time(i);
            const long double y = static_cast<long double>(s.values[j]) - s.values[i];
            const long double slope = u > 0.0L ? y / u : 0.0L;
            cost[j] = std::min(cost[j], cost[i] + syy - slope * (2.0L * suy - slope * suu) + pointCost);
            syy += s.weight(j) * y * y;
            suy += s.weight(j) * u * y;
            suu += s.weight(j) * u * u;
        }
    }
    return cost[n - 1];
}
} // namespace

TEST_CASE("The segmentation is the cheapest of all choices on short curves", "[simplify]")
{
    LagrangianSegmenter segmenter(16);
    KeptPoints kept;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        Random random(seed);
        std::vector<double> values, times, weights;
        double time = -3.0;
        for (int i = 0; i < 12; ++i)
        {
            values.push_back(random.uniform(-1.0, 1.0));
            times.push_back(time += random.uniform(0.01, 1.0));
            weights.push_back(random.uniform(0.0, 2.0));
        }
        const DenseSamples samples{values, seed % 2 == 0 ? std::span<double>() : times,
                                   seed % 4 < 2 ? std::span<double>() : weights};
        for (double pointCost : {1e-4, 0.05, 0.3, 2.0})
        {
            CAPTURE(seed, pointCost);
            long double least = std::numeric_limits<long double>::max();
            test::forEachChoice(values.size(), [&](const KeptPoints& choice)
                                { least = std::min(least, longCost(samples, choice, pointCost)); });
            const std::size_t count = segmenter.solve(samples, pointCost, kept);
            CHECK(count == kept.size());
            CHECK(static_cast<double>(longCost(samples, kept, pointCost)) ==
                  Approx(static_cast<double>(least)).epsilon(1e-12));
        }
    }
}

TEST_CASE("The search leaves out no better start: its cost is that of the plain dynamic programming", "[simplify]")
{
    KeptPoints kept;
    for (const auto& [name, dense] : test::testCurves(700))
    {
        const DenseColumns columns(dense);
        const DenseSamples samples = columns.samples();
        const std::vector<double> weights = test::uniformNoise(dense.size(), 77);
        for (double relativeCost : {1e-6, 1e-4, 1e-2, 1.0})
            for (bool weighted : {false, true})
            {
                if (name == "irregular" && !weighted)
                    continue; // steps: the two put the middle of a step at different places, see below
                DenseSamples s = samples;
                if (weighted)
                    s.weights = weights;
                const double pointCost = relativeCost * (name == "sine" ? 4e4 : 1.0);
                CAPTURE(name, pointCost, weighted);
                if (name == "irregular")
                    s.times = {};
                LagrangianSegmenter whole(dense.size());
                whole.solve(s, pointCost, kept);
                CHECK(static_cast<double>(longCost(s, kept, pointCost)) ==
                      Approx(static_cast<double>(leastCost(s, pointCost, dense.size()))).epsilon(1e-10));
                for (std::size_t longest : {1u, 8u, 30u, 100u})
                {
                    LagrangianSegmenter limited(longest);
                    limited.solve(s, pointCost, kept);
                    CHECK(longCost(s, kept, pointCost) <= leastCost(s, pointCost, longest) * (1.0L + 1e-10L));
                }
            }
    }
}

TEST_CASE("Even times given as numbers or left out make the same choice", "[simplify]")
{
    const auto values = test::strikes(3000, 21);
    std::vector<double> times(values.size()), ones(values.size(), 1.0);
    for (std::size_t i = 0; i < times.size(); ++i)
        times[i] = 1e5 + 0.001 * static_cast<double>(i);
    LagrangianSegmenter segmenter(100);
    KeptPoints even, given;
    for (double pointCost : {1e-5, 1e-3, 1e-1})
    {
        segmenter.solve({values, {}, {}}, pointCost, even);
        segmenter.solve({values, times, {}}, pointCost, given);
        CHECK(even == given);
        segmenter.solve({values, {}, ones}, pointCost, given);
        CHECK(even == given);
    }
}

TEST_CASE("A million samples lose nothing to rounding, on an offset of a thousand times the signal", "[simplify]")
{
    auto values = test::strikes(1'000'000, 31);
    const auto ripple = test::uniformNoise(values.size(), 32);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] += 1000.0 + 0.05 * ripple[i];
    const DenseSamples samples{values, {}, {}};
    LagrangianSegmenter segmenter(64);
    KeptPoints kept;
    // A price at which no segment wants to be longer than 64 samples, so that both searches see the same segments.
    const double pointCost = 1e-4;
    segmenter.solve(samples, pointCost, kept);
    std::size_t longest = 0;
    for (std::size_t k = 1; k < kept.size(); ++k)
        longest = std::max(longest, kept[k] - kept[k - 1]);
    REQUIRE(longest <= 64);
    const auto expected = static_cast<double>(leastCost(samples, pointCost, 64));
    CHECK(static_cast<double>(longCost(samples, kept, pointCost)) == Approx(expected).epsilon(1e-10));
    CHECK(kept.front() == 0);
    CHECK(kept.back() == values.size() - 1);
}

TEST_CASE("Straight stretches of any length need no breakpoints inside", "[simplify]")
{
    LagrangianSegmenter segmenter(16);
    KeptPoints kept;
    std::vector<double> values(50'000, 0.0);
    CHECK(segmenter.solve({values, {}, {}}, 1e-6, kept) == 2);
    values[20'000] = 1.0;
    segmenter.solve({values, {}, {}}, 1e-6, kept);
    CHECK(kept == KeptPoints{0, 19'999, 20'000, 20'001, 49'999});
    // A single bit that flips now and then, far below the price of a point.
    std::fill(values.begin(), values.end(), 0.0);
    for (std::size_t i = 500; i < values.size(); i += 1000)
        values[i] = 1e-6;
    CHECK(segmenter.solve({values, {}, {}}, 1e-6, kept) == 2);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = i < 30'000 ? 0.5 * static_cast<double>(i) : 15'000.0 - 0.25 * static_cast<double>(i - 30'000);
    segmenter.solve({values, {}, {}}, 1e-6, kept);
    CHECK(kept == KeptPoints{0, 30'000, 49'999});

    std::vector<double> times(values.size());
    for (std::size_t i = 0; i < times.size(); ++i)
        times[i] = static_cast<double>(i) * 0.5 + (i >= 10'000 ? 64.0 : 0.0);
    std::fill(values.begin(), values.end(), 0.75);
    CHECK(segmenter.solve({values, times, {}}, 1e-6, kept) == 2);
}

TEST_CASE("Silence between sounds costs no points beyond its ends, however short the window", "[simplify]")
{
    LagrangianSegmenter segmenter(16);
    KeptPoints kept;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
    {
        Random random(seed);
        std::vector<double> values;
        while (values.size() < 3000)
        {
            for (int i = 0; i < 12; ++i)
                values.push_back(random.uniform(0.0, 1.0) * (12 - i) / 12.0);
            values.insert(values.end(), 100 + static_cast<std::size_t>(random.uniform(0.0, 300.0)), 0.0);
        }
        const DenseSamples samples{values, {}, {}};
        for (double pointCost : {1e-5, 1e-4, 1e-3})
        {
            CAPTURE(seed, pointCost);
            segmenter.solve(samples, pointCost, kept);
            CHECK(static_cast<double>(longCost(samples, kept, pointCost)) ==
                  Approx(static_cast<double>(leastCost(samples, pointCost, values.size()))).epsilon(1e-10));
        }
    }
}

TEST_CASE("A noise floor far below the price of a point is crossed in one line", "[simplify]")
{
    auto values = test::uniformNoise(40'000, 3);
    for (double& v : values)
        v *= 1e-5;
    const auto hits = test::strikes(400, 12);
    std::copy(hits.begin(), hits.end(), values.begin() + 20'000);
    LagrangianSegmenter segmenter(64);
    KeptPoints kept;
    segmenter.solve({values, {}, {}}, 1e-3, kept);
    const auto quietBefore = std::count_if(kept.begin(), kept.end(), [](std::size_t i) { return i < 19'990; });
    const auto quietAfter = std::count_if(kept.begin(), kept.end(), [](std::size_t i) { return i > 20'500; });
    CHECK(quietBefore <= 2);
    CHECK(quietAfter <= 3);
}

TEST_CASE("A step stays a step", "[simplify]")
{
    Curve dense;
    for (int i = 0; i <= 50; ++i)
        dense.push_back({0.01 * i, 0.0});
    for (int i = 50; i <= 120; ++i)
        dense.push_back({0.01 * i, 1.0});
    const DenseColumns columns(dense);
    LagrangianSegmenter segmenter;
    KeptPoints kept;
    segmenter.solve(columns.samples(), 1e-3, kept);
    CHECK(kept == KeptPoints{0, 50, 51, 121});
}

TEST_CASE("Dearer points are fewer points", "[simplify]")
{
    const auto values = test::strikes(4000, 41);
    LagrangianSegmenter segmenter(512);
    KeptPoints kept;
    std::size_t before = values.size() + 1;
    for (double pointCost = 1e-9; pointCost < 1e3; pointCost *= 3.0)
    {
        const auto count = segmenter.solve({values, {}, {}}, pointCost, kept);
        CHECK(count <= before);
        before = count;
    }
    CHECK(before == 2);
}

TEST_CASE("A used segmenter gives what a fresh one gives, without allocating", "[simplify]")
{
    const auto values = test::strikes(3000, 51);
    const auto other = test::uniformNoise(5000, 52);
    KeptPoints kept, expected;
    LagrangianSegmenter(64).solve({values, {}, {}}, 1e-3, expected);
    LagrangianSegmenter used(64);
    used.solve({other, {}, {}}, 1e-2, kept);
    kept.reserve(values.size());
    const test::HeapGuard guard;
    used.solve({values, {}, {}}, 1e-3, kept);
    CHECK(guard.traffic() == 0);
    CHECK(kept == expected);
}

TEST_CASE("Curves of no, one and two samples are kept whole", "[simplify]")
{
    LagrangianSegmenter segmenter;
    KeptPoints kept{7};
    const std::vector<double> values{1.0, 5.0};
    CHECK(segmenter.solve({{}, {}, {}}, 1.0, kept) == 0);
    CHECK(kept.empty());
    CHECK(segmenter.solve({std::span(values).first(1), {}, {}}, 1.0, kept) == 1);
    CHECK(segmenter.solve({values, {}, {}}, 1.0, kept) == 2);
}
