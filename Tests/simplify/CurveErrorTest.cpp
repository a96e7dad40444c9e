#include "TestCurves.h"
#include "support/Catch.h"

#include <pacini/simplify/CurveError.h>

using namespace pacini;

TEST_CASE("Errors of known differences are exact", "[simplify]")
{
    const Curve dense{{0, 0}, {1, 1}, {2, 0}};
    const Curve flat{{0, 0}, {2, 0}};
    CHECK(curveError(dense, flat).max == 1.0);
    CHECK(curveError(dense, flat).rms == Approx(std::sqrt(1.0 / 3.0)));
    // The integral of a triangle of height 1 squared is duration / 3, however its points are spread.
    CHECK(curveError(dense, flat, ErrorMean::time).rms == Approx(std::sqrt(1.0 / 3.0)));
    const Curve crowded{{0, 0}, {1e-3, 1e-3}, {2e-3, 2e-3}, {1, 1}, {2, 0}};
    CHECK(curveError(crowded, flat, ErrorMean::time).rms == Approx(std::sqrt(1.0 / 3.0)));
    CHECK(curveError(crowded, flat).rms == Approx(std::sqrt((1.0 + 1e-6 + 4e-6) / 5.0)));
    // Vertices between the dense points count over time only.
    const Curve spike{{0, 0}, {0.9, 0}, {1, 1}, {1.5, 2}, {2, 0}};
    CHECK(curveError(dense, spike).max == 0.0);
    CHECK(curveError(dense, spike, ErrorMean::time).max == Approx(1.5));
}

TEST_CASE("Both sides of a step are compared, and nothing is lost or invented there", "[simplify]")
{
    const Curve step{{0, 0}, {1, 0}, {1, 1}, {2, 1}};
    for (auto mean : {ErrorMean::points, ErrorMean::time})
    {
        CHECK(curveError(step, step, mean).max == 0.0);
        CHECK(curveError(step, Curve{{0, 0}, {1, 0}, {1, 0.5}, {2, 1}}, mean).max == 0.5);
        CHECK(curveError(step, Curve{{0, 0}, {1, 0.5}, {1, 1}, {2, 1}}, mean).max == 0.5);
        CHECK(curveError(step, Curve{{0, 0}, {1, 0}, {2, 1}}, mean).max == 1.0);
        // A point in the middle of a step lasts no time.
        CHECK(curveError(Curve{{0, 0}, {1, 0}, {1, 7}, {1, 1}, {2, 1}}, step, mean).max == 0.0);
    }
    const Curve startsWithStep{{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    CHECK(curveError(startsWithStep, startsWithStep).max == 0.0);
    CHECK(curveError(startsWithStep, startsWithStep, ErrorMean::time).max == 0.0);
    CHECK(curveError(startsWithStep, Curve{{0, 1}, {1, 1}}).max == 1.0);
}

TEST_CASE("The error over time equals a fine numerical integral", "[simplify]")
{
    for (std::uint64_t seed = 0; seed < 5; ++seed)
    {
        const Curve dense = test::irregular(40, seed);
        const Curve other = test::irregular(9, seed + 100);
        const double start = dense.front().time;
        const double duration = dense.back().time - start;
        double sum = 0.0;
        double largest = 0.0;
        constexpr int steps = 2'000'000;
        CurveReader a(dense), b(other);
        for (int i = 0; i < steps; ++i)
        {
            const double time = start + duration * (i + 0.5) / steps;
            const double error = a.at(time) - b.at(time);
            sum += error * error;
            largest = std::max(largest, std::abs(error));
        }
        const auto error = curveError(dense, other, ErrorMean::time);
        CHECK(error.rms == Approx(std::sqrt(sum / steps)).epsilon(1e-4));
        CHECK(error.max == Approx(largest).epsilon(1e-3));
        CHECK(error.max >= largest);
    }
}

TEST_CASE("Empty and single-point curves have an error too", "[simplify]")
{
    CHECK(curveError({}, Curve{{0, 1}}).max == 0.0);
    CHECK(curveError(Curve{{0, 3}}, {}).max == 3.0);
    CHECK(curveError(Curve{{0, 3}}, {}, ErrorMean::time).rms == 3.0);
    CHECK(curveError(Curve{{0, 3}, {2, 3}}, {}, ErrorMean::time).rms == Approx(3.0));
    CHECK(curveError(Curve{{5, 3}}, Curve{{0, 1}, {1, 2}}).max == 1.0);
}
