#include "support/Catch.h"

#include <pacini/foundation/Gaussian.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

using namespace pacini;

TEST_CASE("Random numbers are SplitMix64", "[foundation]")
{
    // The published vectors of the generator, seed 1234567 and 0.
    Random random(1234567);
    for (const std::uint64_t expected : {6457827717110365317ull, 3203168211198807973ull, 9817491932198370423ull,
                                         4593380528125082431ull, 16408922859458223821ull})
        CHECK(random.next() == expected);
    CHECK(Random(0).next() == 0xE220A8397B1DCDAFull);
}

TEST_CASE("Uniform numbers are the upper 53 bits, spread evenly from the lower end to below the upper one",
          "[foundation]")
{
    Random whole(42), unit(42), ranged(42);
    double sum = 0.0, least = 1.0, largest = 0.0;
    const int count = 20000;
    for (int i = 0; i < count; ++i)
    {
        const double expected = std::ldexp(static_cast<double>(whole.next() >> 11), -53);
        const double x = unit.uniform();
        REQUIRE(x == expected);
        REQUIRE(ranged.uniform(-3.0, 5.0) == Approx(-3.0 + 8.0 * x).margin(1e-14));
        sum += x;
        least = std::min(least, x);
        largest = std::max(largest, x);
    }
    CHECK(sum / count == Approx(0.5).margin(0.01));
    CHECK(least < 0.001);
    CHECK(largest > 0.999);
    CHECK(largest < 1.0);
}

TEST_CASE("Gaussian numbers are Box and Muller's and have mean 0 and deviation 1", "[foundation]")
{
    Gaussian gaussian(9);
    Random random(9);
    const int count = 100000;
    double sum = 0.0, squares = 0.0, fourth = 0.0;
    for (int i = 0; i < count; ++i)
    {
        const double u = random.uniform();
        const double v = random.uniform();
        const double x = gaussian.next();
        REQUIRE(x == Approx(std::sqrt(-2.0 * std::log1p(-u)) * std::cos(2.0 * std::numbers::pi * v)).margin(1e-7));
        sum += x;
        squares += x * x;
        fourth += x * x * x * x;
    }
    CHECK(sum / count == Approx(0.0).margin(0.01));
    CHECK(squares / count == Approx(1.0).margin(0.02));
    CHECK(fourth / count == Approx(3.0).margin(0.15));
}
