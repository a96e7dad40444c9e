#include "devices/HdRumble.h"

#include "devices/DecodeRumble.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::devices;

namespace
{
RumbleBytes rumbleOf(int b0, int b1, int b2, int b3)
{
    return {static_cast<std::byte>(b0), static_cast<std::byte>(b1), static_cast<std::byte>(b2),
            static_cast<std::byte>(b3)};
}

// The 159 frequencies as a ladder of equal ratios from 320 Hz, which has code 0x100 in the high range: no logarithm.
long double ladderFrequency(int step)
{
    long double frequency = 320.0L;
    const long double ratio = std::sqrt(std::sqrt(std::sqrt(std::sqrt(std::sqrt(2.0L)))));
    for (int i = 160; i < step; ++i)
        frequency *= ratio;
    for (int i = 160; i > step; --i)
        frequency /= ratio;
    return frequency;
}

// The amplitudes as three ladders that start from the table's entries for 15, 16 and 32.
std::vector<long double> ladderAmplitudes()
{
    const long double quarter = std::sqrt(std::sqrt(2.0L));
    const long double sixteenth = std::sqrt(std::sqrt(quarter));
    const long double thirtySecond = std::sqrt(sixteenth);
    std::vector<long double> ladder{0.0L, 0.007843L};
    for (long double a = 0.112491L / (8.0L * quarter); ladder.size() < 16; a *= quarter) // down from 15
        ladder.push_back(a);
    for (long double a = 0.117471L; ladder.size() < 32; a *= sixteenth)
        ladder.push_back(a);
    for (long double a = 0.229908L; ladder.size() < 128; a *= thirtySecond)
        ladder.push_back(a);
    return ladder;
}

RumbleTones onlyHigh(double frequency, double amplitude)
{
    return {{Hertz(frequency), amplitude}, {160_Hz, 0.0}};
}

RumbleTones onlyLow(double frequency, double amplitude)
{
    return {{320_Hz, 0.0}, {Hertz(frequency), amplitude}};
}
} // namespace

TEST_CASE("HD rumble writes all 159 frequencies of the published table with its bytes", "[devices]")
{
    int rows = 0;
    for (int step = 0x41; step <= 0xDF; ++step, ++rows)
    {
        const auto frequency = static_cast<double>(ladderFrequency(step));
        CAPTURE(step, frequency);
        if (step > 0x60)
        {
            // The high range counts up by 4 from 0x004 at 81.75 Hz to 0x1FC at 1252.57 Hz.
            const RumbleBytes bytes = encodeRumble(onlyHigh(frequency, 1.0));
            const int code = 4 + 4 * (step - 0x61);
            CHECK(bytes[0] == static_cast<std::byte>(code % 256));
            CHECK(bytes[1] == static_cast<std::byte>(200 + code / 256));
            CHECK(decodeRumble(bytes)->high.frequency.value == Approx(frequency).epsilon(1e-9));
        }
        if (step < 0xC0)
        {
            const RumbleBytes bytes = encodeRumble(onlyLow(frequency, 1.0));
            CHECK(bytes[2] == static_cast<std::byte>(1 + step - 0x41));
            CHECK(decodeRumble(bytes)->low.frequency.value == Approx(frequency).epsilon(1e-9));
        }
    }
    REQUIRE(rows == 159);
}

TEST_CASE("HD rumble gives the rows printed in the published tables", "[devices]")
{
    const std::vector<std::pair<int, double>> lowRows{
        {0x01, 40.875885}, {0x02, 41.77095}, {0x05, 44.57547}, {0x0A, 49.674313}};
    for (const auto& [code, frequency] : lowRows)
    {
        CAPTURE(code, frequency);
        CHECK(encodeRumble(onlyLow(frequency, 1.0)) == rumbleOf(0x00, 0x01, code, 0x72));
        CHECK(decodeRumble(rumbleOf(0x00, 0x01, code, 0x72))->low.frequency.value == Approx(frequency).epsilon(1e-6));
    }
    const std::vector<std::pair<int, double>> highRows{
        {0xE0, 1076.347412}, {0xEC, 1148.61377}, {0xF4, 1199.467285}, {0xFC, 1252.572266}};
    for (const auto& [code, frequency] : highRows)
    {
        CAPTURE(code, frequency);
        CHECK(encodeRumble(onlyHigh(frequency, 1.0)) == rumbleOf(code, 0xC9, 0x40, 0x40));
        CHECK(decodeRumble(rumbleOf(code, 0xC9, 0x40, 0x40))->high.frequency.value == Approx(frequency).epsilon(1e-6));
    }
    struct Amplitude
    {
        int high, flag, low;
        double value;
    };
    const std::vector<Amplitude> amplitudes{
        {0x02, 0x80, 0x40, 0.007843}, {0x04, 0x00, 0x41, 0.011823}, {0x06, 0x80, 0x41, 0.014061},
        {0x12, 0x80, 0x44, 0.039771}, {0x1E, 0x80, 0x47, 0.112491}, {0x20, 0x00, 0x48, 0.117471},
        {0x30, 0x00, 0x4C, 0.166129}, {0x3E, 0x80, 0x4F, 0.224982}, {0x40, 0x00, 0x50, 0.229908},
        {0x42, 0x80, 0x50, 0.234943}, {0xB4, 0x00, 0x6D, 0.807554}, {0xC6, 0x80, 0x71, 0.981378}};
    for (const Amplitude& row : amplitudes)
    {
        CAPTURE(row.value);
        CHECK(encodeRumble(onlyHigh(320.0, row.value)) == rumbleOf(0x00, row.high | 1, 0x40, 0x40));
        CHECK(encodeRumble(onlyLow(160.0, row.value)) == rumbleOf(0x00, 0x01, row.flag | 0x40, row.low));
    }
}

TEST_CASE("HD rumble's amplitudes are within 1e-5 of the table's where they are safe, and each has its code",
          "[devices]")
{
    const auto ladder = ladderAmplitudes();
    for (int code = 0; code < 128; ++code)
    {
        CAPTURE(code);
        const auto expected = static_cast<double>(ladder[static_cast<std::size_t>(code)]);
        const RumbleBytes bytes = rumbleOf(0x00, code * 2 + 1, 0x40 + code % 2 * 128, 0x40 + code / 2);
        const RumbleTones tones = decodeRumble(bytes).value();
        CHECK(std::abs(tones.high.amplitude - expected) < (code <= 100 ? 1e-5 : 2e-4));
        CHECK(tones.low.amplitude == tones.high.amplitude);
        CHECK(rumbleAmplitudeCode(expected) == std::min(code, 100));
        CHECK(rumbleAmplitudeCode(rumbleAmplitude(code)) == std::min(code, 100));
        if (code > 0)
            CHECK(rumbleAmplitude(code) > rumbleAmplitude(code - 1));
    }
    CHECK(rumbleAmplitude(100) == Approx(1.002867).margin(1e-5));
    CHECK(rumbleAmplitude(127) == Approx(1.799701).margin(2e-4));
    CHECK(rumbleAmplitude(128) == rumbleAmplitude(127));
    CHECK(rumbleAmplitude(-1) == 0.0);
}

TEST_CASE("HD rumble takes the nearest code and never falls when an amplitude rises", "[devices]")
{
    int before = 0;
    for (int i = 0; i <= 11000; ++i)
    {
        const double amplitude = i * 1e-4;
        const int code = rumbleAmplitudeCode(amplitude);
        CAPTURE(amplitude, code);
        REQUIRE(code >= before);
        before = code;
        const double error = std::abs(rumbleAmplitude(code) - std::min(amplitude, rumbleAmplitude(100)));
        // Half a step of the coarsest row is 9 %; below the smallest code it is half of that.
        REQUIRE(error <= std::max(0.0040, 0.095 * amplitude));
        if (amplitude > 0.235)
            REQUIRE(error <= 0.011 * amplitude);
    }
}

TEST_CASE("HD rumble read back and written again gives the same bytes", "[devices]")
{
    for (int step = lowestHighStep; step <= highestHighStep; ++step)
        for (int code = 1; code <= 100; code += 3)
        {
            const auto tones = onlyHigh(rumbleFrequency(step).value, rumbleAmplitude(code));
            const RumbleBytes bytes = encodeRumble(tones);
            CHECK(encodeRumble(decodeRumble(bytes).value()) == bytes);
        }
    for (int high = 1; high <= 100; ++high)
        for (int low = 1; low <= 100; ++low)
        {
            const double sum = rumbleAmplitude(high) + rumbleAmplitude(low);
            const RumbleBytes bytes = rumbleOf(0xA8, 2 * high + 1, 0x63 + low % 2 * 128, 0x40 + low / 2);
            CAPTURE(high, low);
            const bool same = encodeRumble(decodeRumble(bytes).value()) == bytes;
            CHECK((same || sum > 1.0));
            CHECK((!same || sum <= rumbleAmplitude(safeAmplitudeCode)));
        }
}

TEST_CASE("HD rumble never asks an actuator for more than the strongest safe code", "[devices]")
{
    const double strongest = rumbleAmplitude(safeAmplitudeCode);
    for (int i = 0; i <= 60; ++i)
        for (int j = 0; j <= 60; ++j)
        {
            const double high = i * 0.037;
            const double low = j * 0.041;
            const RumbleTones tones = decodeRumble(encodeRumble({{300_Hz, high}, {100_Hz, low}})).value();
            CAPTURE(high, low);
            CHECK(tones.high.amplitude + tones.low.amplitude <= strongest);
            if (high + low > 1.0 && high > 0.0 && low > 0.0)
            {
                // The sum is used up, and the balance stays.
                CHECK(tones.high.amplitude + tones.low.amplitude > 0.96);
                CHECK(tones.high.amplitude ==
                      Approx(std::min(high, 1.0) / (std::min(high, 1.0) + std::min(low, 1.0))).margin(0.03));
            }
        }
}

TEST_CASE("HD rumble that is silent is the neutral packet", "[devices]")
{
    CHECK(neutralRumble == rumbleOf(0x00, 0x01, 0x40, 0x40));
    CHECK(encodeRumble({}) == neutralRumble);
    CHECK(decodeRumble(neutralRumble).value().high.frequency.value == Approx(320.0));
    CHECK(decodeRumble(neutralRumble).value().low.frequency.value == Approx(160.0));
    CHECK(encodeRumble({{900_Hz, 0.0}, {50_Hz, 0.003}}) == neutralRumble);
    CHECK(encodeRumble({{900_Hz, -1.0}, {50_Hz, std::nan("")}}) == neutralRumble);
}

TEST_CASE("HD rumble brings numbers that it cannot play into its range", "[devices]")
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    CHECK(encodeRumble(onlyHigh(20.0, 1.0)) == rumbleOf(0x04, 0xC8, 0x40, 0x40));
    CHECK(encodeRumble(onlyHigh(infinity, infinity)) == rumbleOf(0xFC, 0xC9, 0x40, 0x40));
    CHECK(encodeRumble(onlyLow(-5.0, 1.0)) == rumbleOf(0x00, 0x01, 0x01, 0x72));
    CHECK(encodeRumble(onlyLow(std::nan(""), 1.0)) == rumbleOf(0x00, 0x01, 0x01, 0x72));
    CHECK(encodeRumble(onlyLow(5000.0, 7.0)) == rumbleOf(0x00, 0x01, 0x7F, 0x72));
}

TEST_CASE("HD rumble refuses bytes that the tables do not have", "[devices]")
{
    CHECK_FALSE(decodeRumble(rumbleOf(0x00, 0x00, 0x40, 0x40)).has_value());
    CHECK_FALSE(decodeRumble(rumbleOf(0x02, 0x01, 0x40, 0x40)).has_value());
    CHECK_FALSE(decodeRumble(rumbleOf(0x00, 0x01, 0x80, 0x40)).has_value());
    CHECK_FALSE(decodeRumble(rumbleOf(0x00, 0x01, 0x40, 0x3F)).has_value());
    CHECK_FALSE(decodeRumble(rumbleOf(0x00, 0x01, 0x40, 0x80)).has_value());
}
