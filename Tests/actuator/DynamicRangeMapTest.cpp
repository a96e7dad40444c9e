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

TEST_CASE("Ranges and peaks beyond what the curve takes count as the ends of what it takes", "[actuator]")
{
    // Halfway down a clip's range, in dB, is halfway down from its peak to the threshold.
    const auto middle = [](double actuatorRange, double clipRange, double peakLevel)
    {
        const DynamicRangeMap map({Decibels(actuatorRange), Decibels(clipRange), amplitude(peakLevel)});
        return level(map(amplitude(peakLevel - 0.5 * clipRange)));
    };
    CHECK(middle(20.0, 200.0, 120.0) == Approx(50.0));
    CHECK(middle(199.0, 199.9, -120.0) == Approx(-159.5));
    CHECK(middle(1.0, 100.0, 0.0) == Approx(-0.5));
    CHECK(middle(0.999 * 200.0, 200.0, 0.0) == Approx(-99.9));

    const auto same = [](const DynamicRangeParams& beyond, const DynamicRangeParams& end)
    {
        const DynamicRangeMap a(beyond), b(end);
        for (double l = -400.0; l < 200.0; l += 0.37)
            if (a(amplitude(l)) != b(amplitude(l)))
                return false;
        return true;
    };
    CHECK(same({20_dB, 200_dB, 1e9}, {20_dB, 200_dB, 1e6}));
    CHECK(same({200_dB, 200_dB, 1e-9}, {200_dB, 200_dB, 1e-6}));
    CHECK(same({0.1_dB, 60_dB, 1.0}, {1_dB, 60_dB, 1.0}));
    CHECK(same({500_dB, 200_dB, 1e-3}, {200_dB, 200_dB, 1e-3}));
    CHECK(same({20_dB, 500_dB, 1.0}, {20_dB, 200_dB, 1.0}));
    CHECK(same({0.6_dB, 0.1_dB, 0.9}, {1_dB, 1_dB, 0.9}));
}

TEST_CASE("Below its floor a clip fades as smoothly as it began", "[actuator]")
{
    // A rise of half a period: what it lacks at one end it has at the other, and its ends are level.
    const DynamicRangeMap map({20_dB, 60_dB, 1.0});
    const double floor = amplitude(-60.0), threshold = amplitude(-20.0);
    for (const double d : {0.05, 0.1, 0.2, 0.25})
        CHECK(map((0.5 + d) * floor) + map((1.0 - d) * floor) == Approx(threshold));
    CHECK(map(0.505 * floor) < 0.001 * threshold);
    CHECK(map(0.505 * floor) > 0.0);
    CHECK(map(0.499 * floor) == 0.0);
}

TEST_CASE("By default every amplitude stays, and any narrower actuator or wider clip is compressed", "[actuator]")
{
    CHECK(DynamicRangeMap().isIdentity());
    CHECK(DynamicRangeMap()(0.25) == 0.25);
    CHECK(DynamicRangeMap(DynamicRangeParams{}).isIdentity());
    DynamicRangeParams params;
    params.actuatorRange = 59.9_dB;
    CHECK_FALSE(DynamicRangeMap(params).isIdentity());
    params.clipPeak = 1.1;
    CHECK(DynamicRangeMap(params).isIdentity());
    params.clipPeak = 0.9;
    params.actuatorRange = 60_dB;
    CHECK_FALSE(DynamicRangeMap(params).isIdentity());
}
