#include "OptimalSquared.h"
#include "TestCurves.h"
#include "support/Catch.h"

#include <pacini/simplify/CurveError.h>
#include <pacini/simplify/DouglasPeucker.h>
#include <pacini/simplify/Optimal.h>
#include <pacini/simplify/Visvalingam.h>

using namespace pacini;

namespace
{
struct Errors
{
    double max = 0.0;
    double squared = 0.0;
};

/// Vertical errors of a choice, in long double by reading the lines at each point.
Errors errorsOf(const Curve& dense, const KeptPoints& kept)
{
    using test::wide;
    long double max = 0.0L;
    long double squared = 0.0L;
    for (std::size_t k = 1; k < kept.size(); ++k)
        for (std::size_t m = kept[k - 1] + 1; m < kept[k]; ++m)
        {
            const auto &a = dense[kept[k - 1]], &b = dense[kept[k]], &p = dense[m];
            const long double part = (wide(p.time) - wide(a.time)) / (wide(b.time) - wide(a.time));
            const long double error = wide(a.value) + part * (wide(b.value) - wide(a.value)) - wide(p.value);
            max = std::max(max, std::abs(error));
            squared += error * error;
        }
    return {static_cast<double>(max), static_cast<double>(squared)};
}

Curve smallCurve(std::uint64_t seed, bool even)
{
    Random random(seed);
    Curve curve;
    double time = 0.0;
    for (int i = 0; i < 11; ++i)
    {
        curve.push_back({time, random.uniform(-1.0, 1.0)});
        time += even ? 1.0 : random.uniform(0.1, 2.0);
    }
    return curve;
}
} // namespace

TEST_CASE("Optimal simplification equals a search of all choices", "[simplify]")
{
    for (std::uint64_t seed = 0; seed < 24; ++seed)
    {
        const Curve dense = smallCurve(seed, seed % 2 == 0);
        CAPTURE(seed);
        std::vector<Errors> best(dense.size() + 1, {1e9, 1e9});
        test::forEachChoice(dense.size(),
                            [&](const KeptPoints& kept)
                            {
                                const auto errors = errorsOf(dense, kept);
                                for (std::size_t count = kept.size(); count <= dense.size(); ++count)
                                {
                                    best[count].max = std::min(best[count].max, errors.max);
                                    best[count].squared = std::min(best[count].squared, errors.squared);
                                }
                            });
        const DenseColumns columns(dense);
        for (std::size_t count = 2; count <= dense.size(); ++count)
        {
            CAPTURE(count);
            const auto least = optimalToCount(dense, count);
            CHECK(least.size() <= count);
            CHECK(errorsOf(dense, least).max == Approx(best[count].max).epsilon(1e-9).margin(1e-14));
            const auto squares = test::optimalSquared(columns.samples(), count);
            CHECK(squares.size() <= count);
            CHECK(errorsOf(dense, squares).squared == Approx(best[count].squared).epsilon(1e-9).margin(1e-14));
        }
        for (double bound : {0.0, 0.1, 0.5, 1.0})
        {
            CAPTURE(bound);
            std::size_t fewest = dense.size();
            std::size_t fewestSquared = dense.size();
            test::forEachChoice(dense.size(),
                                [&](const KeptPoints& kept)
                                {
                                    const auto errors = errorsOf(dense, kept);
                                    if (errors.max <= bound + 1e-12)
                                        fewest = std::min(fewest, kept.size());
                                    if (errors.squared <= bound + 1e-12)
                                        fewestSquared = std::min(fewestSquared, kept.size());
                                });
            const auto within = optimalToBound(dense, bound);
            CHECK(within.size() == fewest);
            CHECK(errorsOf(dense, within).max <= bound + 1e-12);
            CHECK(test::optimalSquared(columns.samples(), dense.size(), bound + 1e-12).size() == fewestSquared);
        }
    }
}

TEST_CASE("No other method has a lower maximum error than the optimum, or fewer points within a bound", "[simplify]")
{
    const Curve dense = test::curveOfValues(test::strikes(800, 9));
    for (std::size_t count : {5u, 20u, 60u})
    {
        const auto error = [&](const KeptPoints& kept)
        {
            return curveError(dense, curveOf(dense, kept)).max;
        };
        const double least = error(optimalToCount(dense, count));
        CHECK(least <= error(visvalingamToCount(dense, count)));
        CHECK(least <= error(douglasPeuckerToCount(dense, count)));
        CHECK(optimalToBound(dense, least * (1.0 + 1e-9)).size() <= count);
        CHECK(optimalToBound(dense, least * (1.0 - 1e-6)).size() > count);
    }
    for (double bound : {0.2, 0.05, 0.01})
    {
        const auto fewest = optimalToBound(dense, bound).size();
        CHECK(fewest <= visvalingamToBound(dense, bound).size());
        CHECK(fewest <= douglasPeuckerToBound(dense, bound).size());
    }
}

TEST_CASE("The search for a count ends on the smallest and keeps the count on the largest values there are",
          "[simplify]")
{
    for (double largest : {5e-324, 4e-323, 1e-310, 1e308, 1.79e308})
    {
        CAPTURE(largest);
        auto values = test::uniformNoise(200, 21);
        for (double& v : values)
            v = (2.0 * v - 1.0) * largest;
        const auto kept = optimalToCount(test::curveOfValues(values), 50);
        CHECK(kept.size() <= 50);
        if (largest > 1e-320)
            CHECK(kept.size() > 40);
    }
}

TEST_CASE("Weights decide where the optimum spends its points", "[simplify]")
{
    // Two equal bumps; the weighted one gets the one free point.
    std::vector<double> values{0, 1, 0, 0, 0, 1, 0};
    std::vector<double> weights{1, 1, 1, 1, 1, 9, 1};
    CHECK(test::optimalSquared({values, {}, weights}, 3) == KeptPoints{0, 5, 6});
    weights = {1, 9, 1, 1, 1, 1, 1};
    CHECK(test::optimalSquared({values, {}, weights}, 3) == KeptPoints{0, 1, 6});
}
