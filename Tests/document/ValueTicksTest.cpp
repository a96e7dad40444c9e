// Marks of value axes.

#include "document/view/ValueTicks.h"

#include "support/Catch.h"

using namespace pacini;

TEST_CASE("Marks are at round values, apart from each other and from the edges")
{
    const auto levels = valueTicks({ValueScale::decibels, 0.001, 1.0, 96.0}, 16.0);
    REQUIRE(levels.size() == 4); // -48, -36, -24 and -12 dB
    CHECK(levels.front() == Approx(std::pow(10.0, -48.0 / 20.0)));
    CHECK(levels.back() == Approx(std::pow(10.0, -12.0 / 20.0)));
    CHECK(valueTicks({ValueScale::linear, 0.0, 1.0, 100.0}, 20.0) ==
          std::vector<double>{0.2, 0.4, 0.6000000000000001, 0.8});
    CHECK(valueTicks({ValueScale::logarithmic, 20.0, 1500.0, 120.0}, 16.0) ==
          std::vector<double>{50.0, 100.0, 200.0, 500.0, 1000.0});
    for (const ValueScale scale : {ValueScale::linear, ValueScale::decibels, ValueScale::logarithmic})
        for (const double height : {1.0, 8.0, 31.0, 64.0, 333.0})
            for (const double high : {0.7, 1.0, 1.9, 440.0})
            {
                const ValueAxis axis{scale, high / 800.0, high, height};
                const auto ticks = valueTicks(axis, 14.0);
                for (std::size_t i = 0; i < ticks.size(); ++i)
                {
                    CAPTURE(height, high, ticks[i]);
                    CHECK(axis.yOf(ticks[i]) >= 7.0 - 1e-9);
                    CHECK(axis.yOf(ticks[i]) <= height - 7.0 + 1e-9);
                    if (i > 0)
                        CHECK(axis.yOf(ticks[i - 1]) - axis.yOf(ticks[i]) >= 14.0 - 0.1);
                }
            }
}
