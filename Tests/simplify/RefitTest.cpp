#include "TestCurves.h"
#include "support/Catch.h"

#include <pacini/simplify/CurveError.h>
#include <pacini/simplify/DouglasPeucker.h>
#include <pacini/simplify/Refit.h>

using namespace pacini;

namespace
{
double squares(const Curve& dense, const Curve& curve, const std::vector<double>& weights = {})
{
    double sum = 0.0;
    for (std::size_t m = 0; m < dense.size(); ++m)
    {
        const double error = valueAt(curve, dense[m].time) - dense[m].value;
        sum += (weights.empty() ? 1.0 : weights[m]) * error * error;
    }
    return sum;
}
} // namespace

TEST_CASE("No small change of a refitted vertex lowers the squared error", "[simplify]")
{
    const Curve dense = test::curveOfValues(test::strikes(600, 4));
    const Curve vertices = curveOf(dense, douglasPeuckerToCount(dense, 15));
    std::vector<double> weights = test::uniformNoise(dense.size(), 8);
    for (const auto& w : {std::vector<double>{}, weights})
    {
        const Curve best = refit(dense, vertices, w);
        const double least = squares(dense, best, w);
        CHECK(least < squares(dense, vertices, w));
        for (std::size_t k = 0; k < best.size(); ++k)
            for (double change : {-1e-3, 1e-3})
            {
                CHECK(best[k].time == vertices[k].time);
                Curve changed = best;
                changed[k].value += change;
                CHECK(squares(dense, changed, w) > least);
            }
    }
}

TEST_CASE("Refit gives back a curve whose points lie on the vertices' lines", "[simplify]")
{
    const Curve truth{{0, 0.5}, {0.1, 0.9}, {0.1, 0.2}, {0.5, 0.0}};
    Curve dense;
    CurveReader reader(truth);
    for (int i = 0; i <= 100; ++i)
        dense.push_back({0.1 * i / 100.0, 0.5 + 0.4 * i / 100.0});
    for (int i = 0; i <= 100; ++i)
        dense.push_back({0.1 + 0.4 * i / 100.0, 0.2 - 0.2 * i / 100.0});
    dense[100].time = 0.1;
    const Curve wrong{{0, 0}, {0.1, 0}, {0.1, 0}, {0.5, 1}};
    const Curve fitted = refit(dense, wrong);
    for (std::size_t k = 0; k < truth.size(); ++k)
        CHECK(fitted[k].value == Approx(truth[k].value).margin(1e-9));
}

TEST_CASE("Refitted values never fall below the floor, and the others make the best of it", "[simplify]")
{
    // A sharp decay to zero: the unbounded fit swings below zero after it.
    Curve dense;
    for (int i = 0; i <= 400; ++i)
        dense.push_back({0.001 * i, std::exp(-0.05 * i)});
    const Curve vertices{{0, 1}, {0.06, 0.05}, {0.12, 0.0}, {0.25, 0.0}, {0.4, 0.0}};
    const Curve free = refit(dense, vertices);
    CHECK(std::any_of(free.begin(), free.end(), [](const Breakpoint& p) { return p.value < 0.0; }));
    RefitParams params;
    params.lowest = 0.0;
    const Curve bounded = refit(dense, vertices, {}, params);
    Curve clamped = free;
    for (Breakpoint& p : clamped)
        p.value = std::max(p.value, 0.0);
    for (const Breakpoint& p : bounded)
        CHECK(p.value >= 0.0);
    CHECK(squares(dense, bounded) < squares(dense, clamped));
    CHECK(squares(dense, bounded) >= squares(dense, free));
}

TEST_CASE("Refit within a bound keeps the bound and lowers the squared error", "[simplify]")
{
    const Curve dense = test::curveOfValues(test::strikes(2000, 14));
    for (double bound : {0.1, 0.03, 0.005})
    {
        const Curve vertices = curveOf(dense, douglasPeuckerToBound(dense, bound));
        RefitParams params;
        params.maxError = bound;
        const Curve fitted = refit(dense, vertices, {}, params);
        CHECK(curveError(dense, fitted).max <= bound * (1.0 + 1e-12));
        CHECK(curveError(dense, fitted).rms < curveError(dense, vertices).rms);
    }
}

TEST_CASE("Vertices that no point sees keep their values", "[simplify]")
{
    const Curve dense{{0, 1}, {1, 1}, {2, 1}};
    const Curve vertices{{0, 5}, {2, 7}, {10, 3}, {11, 4}};
    const Curve fitted = refit(dense, vertices);
    CHECK(fitted[0].value == Approx(1.0));
    CHECK(fitted[1].value == Approx(1.0));
    CHECK(fitted[2].value == Approx(3.0));
    CHECK(fitted[3].value == Approx(4.0));
    CHECK(refit(dense, {}).empty());
    CHECK(refit({}, vertices) == vertices);
    const std::vector<double> nothing(3, 0.0);
    CHECK(refit(dense, vertices, nothing) == vertices);
}
