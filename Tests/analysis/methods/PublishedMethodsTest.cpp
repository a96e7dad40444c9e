// The translations that people rated: hapticgen, freqshift, percept and pitchmatch. How close they are to the
// vibrations that were rated is measured by Tests/human/check_methods.py.

#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/analysis/methods/Method.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

using namespace pacini;
using test::rms;

namespace
{
constexpr Method published[] = {Method::hapticGen, Method::frequencyShift, Method::percept, Method::pitchMatch};

std::vector<float> tone(double frequency, double amplitude, double fs, double seconds)
{
    std::vector<float> x(static_cast<std::size_t>(seconds * fs));
    for (std::size_t n = 0; n < x.size(); ++n)
        x[n] =
            static_cast<float>(amplitude * std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(n) / fs));
    return x;
}

/// Zero crossings from below to above, per second.
double frequencyOf(std::span<const float> x, double fs)
{
    std::size_t count = 0;
    for (std::size_t n = 1; n < x.size(); ++n)
        count += x[n - 1] < 0.0f && x[n] >= 0.0f ? 1u : 0u;
    return static_cast<double>(count) * fs / static_cast<double>(x.size());
}

std::span<const float> middle(const std::vector<float>& x)
{
    return std::span(x).subspan(x.size() / 4, x.size() / 2);
}
} // namespace

TEST_CASE("hapticgen puts the level on a sine that rises with it, at every rate", "[analysis][methods]")
{
    for (const double fs : {8000.0, 44100.0, 192000.0})
    {
        // A tone's level is its amplitude, 1: nothing is left to amplify; 200 + 100 (1 - .3) Hz.
        const auto loud = hapticGen(tone(1000.0, 0.1, fs, 1.0), fs);
        CHECK(rms(middle(loud)) == Approx(std::sqrt(0.5)).epsilon(0.01));
        CHECK(frequencyOf(middle(loud), fs) == Approx(270.0).epsilon(0.01));
        // Half of it is silent, then half as strong.
        auto x = tone(1000.0, 0.5, fs, 1.0);
        for (std::size_t n = 0; n < x.size() / 2; ++n)
            x[n] *= 0.5f;
        const auto y = hapticGen(x, fs);
        const auto early = std::span(y).subspan(y.size() / 8, y.size() / 4);
        CHECK(rms(early) == Approx(0.5 * std::sqrt(0.5)).epsilon(0.01));
        CHECK(frequencyOf(early, fs) == Approx(220.0).epsilon(0.02));
    }
    // One strong sample: its 10 ms are amplified by 1.2 at most.
    std::vector<float> click(48000);
    click[24000] = 1.0f;
    CHECK(peakOf(hapticGen(click, 48000.0)) <= 1.2 * std::sqrt(2.0 / 480.0));
}

TEST_CASE("freqshift brings tones above the range of touch into it by octaves", "[analysis][methods]")
{
    constexpr double fs = 44100.0;
    // Of 500 Hz only the octave below passes; of 1 kHz only two octaves below.
    CHECK(frequencyOf(middle(frequencyShift(tone(500.0, 0.3, fs, 2.0), fs)), fs) == Approx(250.0).epsilon(0.05));
    CHECK(frequencyOf(middle(frequencyShift(tone(1000.0, 0.3, fs, 2.0), fs)), fs) == Approx(250.0).epsilon(0.02));
    // A third of half of full power each, the least of it outside of the band.
    CHECK(rms(middle(frequencyShift(tone(1000.0, 0.3, fs, 2.0), fs))) == Approx(std::sqrt(0.5 / 3.0)).epsilon(0.1));
    CHECK(rms(frequencyShift(tone(4000.0, 0.3, fs, 2.0), fs)) < 0.01);
    const auto noisy = frequencyShift(test::noise(44100, 5, 0.9), fs);
    CHECK(peakOf(noisy) <= 1.0);
}

TEST_CASE("percept is two sines of 175 and 210 Hz at a level of .15", "[analysis][methods]")
{
    for (const double fs : {16000.0, 44100.0, 48000.0})
    {
        const auto x = test::noise(static_cast<std::size_t>(2.0 * fs), 7, 0.5); // rough all the time
        const auto y = perceptTranslation(x, fs);
        REQUIRE(y.size() == x.size());
        CHECK(rms(y) == Approx(0.15).epsilon(0.001));
        const double f = frequencyOf(middle(y), fs);
        CHECK(f > 170.0);
        CHECK(f < 215.0);
    }
    // One sine of whole periods in a frame has no second peak to be rough with: nothing is felt.
    CHECK(peakOf(perceptTranslation(tone(64.0 * 44100.0 / 4096.0, 0.5, 44100.0, 40960.0 / 44100.0), 44100.0)) == 0.0);
}

TEST_CASE("pitchmatch follows loudness, and gives no amplitude where nothing is heard", "[analysis][methods]")
{
    constexpr double fs = 44100.0;
    auto x = tone(1000.0, 0.8, fs, 2.0);
    for (std::size_t n = 0; n < x.size() / 4; ++n)
        x[n] = 0.0f;
    for (std::size_t n = x.size() / 4; n < x.size() / 2; ++n)
        x[n] *= 0.1f; // 20 dB: a quarter of the loudness
    const auto y = pitchMatch(x, fs);
    const auto quarter = [&](std::size_t k)
    {
        return rms(std::span(y).subspan(k * y.size() / 4 + y.size() / 16, y.size() / 8));
    };
    CHECK(quarter(0) == 0.0);
    CHECK(quarter(1) / quarter(2) == Approx(0.25).epsilon(0.15));
    CHECK(quarter(2) == Approx(quarter(3)).epsilon(0.02));
    CHECK(peakOf(y) == Approx(1.0).epsilon(0.01));
    const double f = frequencyOf(middle(y), fs);
    CHECK(f >= 49.0);
    CHECK(f <= 399.0);
}

TEST_CASE("Published translations do not depend on the level, and are as long as any sound", "[analysis][methods]")
{
    for (const Method method : published)
    {
        INFO(methodInfo(method).name);
        const auto x = test::noise(12000, 3, 0.02);
        auto louder = x;
        for (float& v : louder)
            v *= 8.0f;
        const auto y = translateToSignal(method, x, 24000.0);
        const auto z = translateToSignal(method, louder, 24000.0);
        REQUIRE(y.size() == x.size());
        for (std::size_t n = 0; n < y.size(); ++n)
            REQUIRE(y[n] == Approx(z[n]).margin(1e-4));
        for (const std::size_t frames : {0u, 1u, 2u, 79u, 441u})
            CHECK(translateToSignal(method, test::noise(frames, 9, 0.5), 8000.0).size() == frames);
        CHECK(peakOf(translateToSignal(method, std::vector<float>(5000), 44100.0)) == 0.0);
        auto broken = test::noise(9000, 4, 0.5);
        broken[100] = std::numeric_limits<float>::quiet_NaN();
        broken[200] = std::numeric_limits<float>::infinity();
        auto mended = broken;
        mended[100] = mended[200] = 0.0f;
        CHECK(translateToSignal(method, broken, 768000.0) == translateToSignal(method, mended, 768000.0));
    }
}
