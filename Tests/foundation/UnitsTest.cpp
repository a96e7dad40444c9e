#include "support/Catch.h"

#include <pacini/foundation/BandSpacing.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Units.h>

#include <cmath>
#include <limits>

using namespace pacini;

TEST_CASE("Units are what their literals say", "[foundation]")
{
    CHECK((180_Hz).value == 180.0);
    CHECK((0.5_Hz).value == 0.5);
    CHECK((2_kHz).value == 2000.0);
    CHECK((1.5_kHz).value == 1500.0);
    CHECK((3_s).value == 3.0);
    CHECK((0.25_s).value == 0.25);
    CHECK((10_ms).value == Approx(0.01).epsilon(1e-15));
    CHECK((0.5_ms).value == Approx(0.0005).epsilon(1e-15));
    CHECK((6_dB).value == 6.0);
    CHECK((0.25_dB).value == 0.25);
    CHECK(Hertz().value == 0.0);
    CHECK(Seconds().value == 0.0);
    CHECK(Decibels().value == 0.0);
    CHECK(100_Hz < 0.2_kHz);
    CHECK(10_ms < 0.02_s);
    CHECK((20_ms).frames(48000.0) == Approx(960.0));
    CHECK((0.3_ms).frames(1000.0) == Approx(0.3)); // not rounded
}

TEST_CASE("Decibels are twenty logarithms of an amplitude ratio", "[foundation]")
{
    CHECK((0_dB).gain() == 1.0);
    CHECK((20_dB).gain() == Approx(10.0).epsilon(1e-14));
    CHECK(Decibels(-40.0).gain() == Approx(0.01).epsilon(1e-14));
    CHECK((6_dB).gain() == Approx(1.9952623149688795).epsilon(1e-14));
    CHECK(Decibels::fromGain(1.0).value == 0.0);
    CHECK(Decibels::fromGain(10.0).value == Approx(20.0).epsilon(1e-14));
    CHECK(Decibels::fromGain(0.5).value == Approx(-6.020599913279624).epsilon(1e-14));
    CHECK(Decibels::fromGain(0.0).value == -std::numeric_limits<double>::infinity());
}

TEST_CASE("Clamping takes the nearest end, and the lower one for what is no number", "[foundation]")
{
    CHECK(clampTo(2.0, 1.0, 3.0) == 2.0);
    CHECK(clampTo(0.5, 1.0, 3.0) == 1.0);
    CHECK(clampTo(3.5, 1.0, 3.0) == 3.0);
    CHECK(clampTo(1.0, 1.0, 3.0) == 1.0);
    CHECK(clampTo(3.0, 1.0, 3.0) == 3.0);
    CHECK(clampTo(std::numeric_limits<double>::quiet_NaN(), 1.0, 3.0) == 1.0);
    CHECK(clampTo(std::numeric_limits<double>::infinity(), 1.0, 3.0) == 3.0);
    CHECK(clampTo(-7, 0, 5) == 0);
    CHECK(clampTo(7, 0, 5) == 5);
}

TEST_CASE("Positions on a scale are equal ratios or equal widths, beyond its ends too", "[foundation]")
{
    const auto logarithmic = BandSpacing::logarithmic;
    CHECK(onScale(logarithmic, 50.0, 800.0, 0.0) == 50.0);
    CHECK(onScale(logarithmic, 50.0, 800.0, 0.25) == Approx(100.0).epsilon(1e-14));
    CHECK(onScale(logarithmic, 50.0, 800.0, 1.0) == Approx(800.0).epsilon(1e-14));
    CHECK(onScale(logarithmic, 50.0, 800.0, 1.5) == Approx(3200.0).epsilon(1e-14));
    CHECK(onScale(logarithmic, 50.0, 800.0, -0.25) == Approx(25.0).epsilon(1e-14));
    const auto linear = BandSpacing::linear;
    CHECK(onScale(linear, 50.0, 850.0, 0.0) == 50.0);
    CHECK(onScale(linear, 50.0, 850.0, 0.25) == 250.0);
    CHECK(onScale(linear, 50.0, 850.0, 1.0) == 850.0);
    CHECK(onScale(linear, 50.0, 850.0, 1.5) == 1250.0);
    CHECK(onScale(linear, 50.0, 850.0, -0.25) == -150.0);
}
