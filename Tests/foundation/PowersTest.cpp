#include "support/Catch.h"

#include <pacini/foundation/Powers.h>

#include <array>
#include <cmath>

using namespace pacini;

TEST_CASE("Powers of several numbers are those of the library", "[foundation]")
{
    for (const double exponent : {0.3, -3.0, -0.5, 1.0, 2.5, 3.0})
        for (double digits = -75.0; digits <= 90.0; digits += 0.0173)
        {
            std::array<double, 4> x{};
            for (std::size_t i = 0; i < x.size(); ++i)
                x[i] = std::pow(10.0, digits - 0.01 * static_cast<double>(i));
            auto y = x;
            raiseAll(y, exponent);
            for (std::size_t i = 0; i < x.size(); ++i)
                REQUIRE(std::abs(y[i] / std::pow(x[i], exponent) - 1.0) < 1e-10);
        }
}

TEST_CASE("A power of nothing is nothing, beside numbers that are something", "[foundation]")
{
    std::array<double, 2> x{0.0, 16.0};
    raiseAll(x, 0.5);
    CHECK(x[0] >= 0.0);
    CHECK(x[0] < 1e-40);
    CHECK(x[1] == Approx(4.0).epsilon(1e-10));
}
