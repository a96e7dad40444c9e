#include "support/Catch.h"
#include "support/Golden.h"

#include <pacini/clip/Quantiser.h>

#include <limits>

using namespace pacini;

TEST_CASE("The uniform quantiser gives the golden codes and values", "[clip][golden]")
{
    const auto golden = test::golden("quantise_size");
    for (const auto& c : golden["quantise"])
    {
        const UniformQuantiser quantiser(c["bits"].get<int>(), 0.0, 1.0);
        for (std::size_t i = 0; i < c["v"].size(); ++i)
        {
            CHECK(quantiser.code(c["v"][i].get<double>()) == c["code"][i].get<std::int64_t>());
            CHECK(quantiser.value(c["code"][i].get<std::int64_t>()) ==
                  Approx(c["value"][i].get<double>()).margin(1e-12));
        }
    }
}

TEST_CASE("Levels and pitches return to their own code and stay within half a step", "[clip]")
{
    for (int bits = 4; bits <= 16; ++bits)
    {
        CAPTURE(bits);
        const LevelQuantiser levels(bits);
        const PitchQuantiser pitches(bits);
        const double stepDecibels = 72.0 / ((1 << bits) - 2);
        CHECK(levels.code(0.0) == 0);
        CHECK(levels.value(0) == 0.0);
        CHECK(levels.value(levels.code(1.0)) == 1.0);
        for (double a = 1.0; a > 3e-4; a *= 0.93)
        {
            const auto code = levels.code(a);
            REQUIRE(levels.code(levels.value(code)) == code);
            REQUIRE(std::abs(20.0 * std::log10(levels.value(code) / a)) <= 0.51 * stepDecibels);
        }
        for (double f = 1.0; f < 3000.0; f *= 1.07)
        {
            const auto code = pitches.code(f);
            REQUIRE(pitches.code(pitches.value(code)) == code);
            REQUIRE(std::abs(std::log2(pitches.value(code) / f)) <= 0.51 * 4.0 / (3.0 * (1 << bits)));
        }
    }
}

TEST_CASE("Levels outside the range saturate instead of wrapping", "[clip]")
{
    const LevelQuantiser levels(6);
    CHECK(levels.code(-1.0) == 0);
    CHECK(levels.code(1e-30) == 0);
    CHECK(levels.code(1e300) > levels.topCode());
    CHECK(levels.value(levels.code(4.0)) == Approx(4.0).epsilon(0.07));
}

TEST_CASE("Pitches that are none get the lowest code", "[clip]")
{
    const PitchQuantiser pitches(6);
    const auto lowest = pitches.code(PitchQuantiser::lowest);
    for (double hertz : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()})
        CHECK(pitches.code(hertz) == lowest);
    CHECK(pitches.code(std::numeric_limits<double>::infinity()) == pitches.code(PitchQuantiser::highest));
}

TEST_CASE("Codes far outside the range come back as the limits", "[clip]")
{
    const LevelQuantiser levels(4);
    const PitchQuantiser pitches(4);
    const std::int64_t huge = std::int64_t{1} << 40;
    CHECK(levels.value(huge) == LevelQuantiser::highest);
    CHECK(levels.value(-huge) == 0.0);
    CHECK(pitches.value(huge) == PitchQuantiser::highest);
    CHECK(pitches.value(-huge) == PitchQuantiser::lowest);
}
