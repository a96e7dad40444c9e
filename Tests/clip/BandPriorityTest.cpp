#include "support/Catch.h"

#include <pacini/clip/BandPriority.h>

#include <vector>

using namespace pacini;

TEST_CASE("The energy of a curve is the integral of its square over the whole time", "[clip]")
{
    const std::vector<Breakpoint> curve{{0.25, 0.5}, {0.5, 0.1}, {0.5, 0.9}, {1.125, 0.3}, {1.5, 0.3}};
    const double duration = 2.0;
    double sum = 0.0;
    constexpr int pieces = 16000;
    for (int i = 0; i < pieces; ++i)
    {
        const double value = valueAt(curve, duration * (i + 0.5) / pieces);
        sum += value * value * duration / pieces;
    }
    CHECK(curveEnergy(curve, duration) == Approx(sum).epsilon(1e-6));
    CHECK(curveEnergy({}, 3.0) == 0.0);
    const std::vector<Breakpoint> constant{{0.5, 0.2}};
    CHECK(curveEnergy(constant, 3.0) == Approx(0.04 * 3.0));
}

TEST_CASE("Bands are ranked by their energy, equal ones in their order", "[clip]")
{
    CHECK(prioritiesByEnergy(std::vector{0.1, 0.5, 0.1, 0.7, 0.0}) == std::vector{2, 1, 3, 0, 4});
    CHECK(prioritiesByEnergy({}).empty());
}
