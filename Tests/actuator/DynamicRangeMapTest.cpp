#include "support/Catch.h"

#include <pacini/actuator/DynamicRangeMap.h>
#include <pacini/foundation/Random.h>

#include <cmath>
#include <limits>

using namespace pacini;

namespace
{

double level(double amplitude)
{
    return 20.0 * std::log10(amplitude);
}

double amplitude(double level)
{
    return std::pow(10.0, level / 20.0);
}

} // namespace

TEST_CASE("A clip's range becomes the actuator's by a straight line in dB", "[actuator]")
{
    const DynamicRangeMap map({20_dB, 60_dB, 1.0});
    CHECK_FALSE(map.isIdentity());
    CHECK(map(1.0) == 1.0);
    CHECK(level(map(amplitude(-30.0))) == Approx(-10.0));
    CHECK(level(map(amplitude(-59.999))) == Approx(-20.0).margin(0.001));
    CHECK(map(amplitude(-66.03)) == 0.0);
    CHECK(map(0.0) == 0.0);

    const DynamicRangeMap quiet({30_dB, 60_dB, amplitude(-10.0)}); // -70 .. -10 dB onto -30 .. -10 dB
    CHECK(level(quiet(amplitude(-10.0))) == Approx(-10.0));
    CHECK(level(quiet(amplitude(-40.0))) == Approx(-20.0));
    CHECK(level(quiet(amplitude(-5.0))) == Approx(-5.0));
}

TEST_CASE("An actuator with the range of the clip plays it unchanged", "[actuator]")
{
    for (const double range : {60.0, 80.0, 140.0})
    {
        const DynamicRangeMap map({Decibels(range), 60_dB, 1.0});
        CHECK(map.isIdentity());
        for (const double a : {0.0, 1e-9, 1e-4, 0.3, 1.0, 2.0})
            CHECK(map(a) == a);
    }
    CHECK_FALSE(DynamicRangeMap({60_dB, 60_dB, 0.5}).isIdentity());
}

TEST_CASE("The range map never falls, never jumps and shows what is above the clip's floor", "[actuator]")
{
    Random random(6);
    for (int i = 0; i < 60; ++i)
    {
        const DynamicRangeParams params{Decibels(random.uniform(1.0, 90.0)), Decibels(random.uniform(10.0, 90.0)),
                                        amplitude(random.uniform(-100.0, 6.0))};
        const double actuatorRange = params.actuatorRange.value, clipRange = params.clipRange.value;
        CAPTURE(actuatorRange, clipRange, params.clipPeak);
        const DynamicRangeMap map(params);
        const double peakLevel = level(params.clipPeak);
        double before = map(amplitude(peakLevel - clipRange - 20.0));
        for (double l = peakLevel - clipRange - 20.0; l < peakLevel + 20.0; l += 0.01)
        {
            const double y = map(amplitude(l));
            REQUIRE(y >= before * (1.0 - 1e-12));
            // no step is larger than 1 % of full scale or of itself
            REQUIRE(y - before <= 0.01 * std::max(y, amplitude(-actuatorRange)));
            if (l > peakLevel - clipRange + 0.01 && !map.isIdentity())
                REQUIRE(y >= amplitude(-actuatorRange) * (1.0 - 1e-9));
            before = y;
        }
    }
}

TEST_CASE("Amplitudes and parameters that make no sense do no harm", "[actuator]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double odd : {nan, infinity, -infinity, 0.0, -1.0, 1e300})
        for (const auto& params :
             {DynamicRangeParams{Decibels(odd), 60_dB, 1.0}, DynamicRangeParams{20_dB, Decibels(odd), 1.0},
              DynamicRangeParams{20_dB, 60_dB, odd}, DynamicRangeParams{20_dB, 60_dB, 1.0}})
        {
            const DynamicRangeMap map(params);
            for (const double a : {nan, -infinity, -1.0, 0.0})
                CHECK(map(a) == 0.0);
            CHECK(std::isfinite(map(0.3)));
            CHECK(std::isfinite(map(1e-300)));
        }
}
