#include "MethodSignals.h"
#include "support/BlockContract.h"
#include "support/Catch.h"

#include <pacini/analysis/methods/PitchShift.h>

#include <algorithm>
#include <functional>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("Pitch shift moves a tone by its interval and keeps its level and length", "[methods]")
{
    for (const double fs : {8000.0, 44100.0, 96000.0})
        for (const double semitones : {-24.0, -12.0, -7.0, 5.0})
            for (const double f : {60.0, 93.0, 440.0, 1000.0, 2500.0})
            {
                const auto sound = sine(static_cast<std::size_t>(1.5 * fs), f, fs, 0.5);
                const auto out = pitchShift(sound, fs, {semitones});
                REQUIRE(out.size() == sound.size());
                const double expected = f * std::pow(2.0, semitones / 12.0);
                const auto steady = between(out, 0.4, 1.1, fs);
                CAPTURE(fs, semitones, f);
                CHECK(strongestFrequency(steady, 0.8 * expected, 1.15 * expected, fs) ==
                      Approx(expected).epsilon(0.003));
                CHECK(20.0 * std::log10(rms(steady) * std::sqrt(2.0) / 0.5) == Approx(0.0).margin(0.35));
            }
}

TEST_CASE("Pitch shift adds nothing to a steady tone that is felt", "[methods]")
{
    const double fs = 44100.0;
    const auto out = pitchShift(sine(66150, 480.0, fs), fs);
    const auto steady = between(out, 0.5, 1.0, fs); // 60 periods of 120 Hz
    const double tone = amplitudeAt(steady, 120.0, fs) / std::sqrt(2.0);
    const double all = rms(steady);
    CHECK(std::sqrt(std::max(0.0, all * all - tone * tone)) < 0.004 * tone); // -48 dB
}

TEST_CASE("Pitch shift keeps onsets in place", "[methods]")
{
    const double fs = 44100.0;
    const std::vector<double> onsets{0.3, 0.7, 1.11, 1.52};
    std::vector<float> sound(static_cast<std::size_t>(2.0 * fs), 0.0f);
    for (const double at : onsets)
        for (std::size_t n = 0; n < 4410; ++n)
        {
            const double t = static_cast<double>(n) / fs;
            sound[static_cast<std::size_t>(at * fs) + n] +=
                static_cast<float>(std::exp(-t / 0.03) * std::sin(2.0 * std::numbers::pi * 600.0 * t));
        }
    const auto out = pitchShift(sound, fs);
    for (const double at : onsets)
    {
        // Where 10 % of the energy around the event has come.
        const auto part = between(out, at - 0.1, at + 0.2, fs);
        double whole = 0.0;
        for (const float v : part)
            whole += static_cast<double>(v) * static_cast<double>(v);
        double sum = 0.0;
        std::size_t n = 0;
        for (; sum < 0.1 * whole; ++n)
            sum += static_cast<double>(part[n]) * static_cast<double>(part[n]);
        CAPTURE(at);
        CHECK(std::abs(static_cast<double>(n) / fs - 0.1) < 0.006);
    }
}

TEST_CASE("A chord comes out as the lower chord", "[methods]")
{
    const double fs = 16000.0;
    const std::vector<double> partials{200.0, 300.0, 420.0, 800.0};
    std::vector<float> sound(32000, 0.0f);
    for (const double f : partials)
    {
        const auto tone = sine(sound.size(), f, fs, 0.2);
        std::transform(sound.begin(), sound.end(), tone.begin(), sound.begin(), std::plus<>());
    }
    const auto out = pitchShift(sound, fs, {-12.0});
    const auto steady = between(out, 0.5, 1.5, fs);
    for (const double f : partials)
    {
        CAPTURE(f);
        CHECK(amplitudeAt(steady, f / 2.0, fs) == Approx(0.2).epsilon(0.06));
    }
}

TEST_CASE("Pitch shift by nothing changes nothing, and a constant has no pitch", "[methods]")
{
    const auto sound = noise(9000, 3);
    const auto same = pitchShift(sound, 16000.0, {0.0});
    for (std::size_t i = 0; i < sound.size(); ++i)
        REQUIRE(std::abs(same[i] - sound[i]) < 1e-4f);
    const auto constant = pitchShift(std::vector<float>(16000, 0.5f), 16000.0);
    for (std::size_t i = 4000; i < 12000; ++i)
        REQUIRE(constant[i] == Approx(0.5).margin(0.001));
}

TEST_CASE("What a shift upwards would fold is left out", "[methods]")
{
    const double fs = 16000.0;
    const auto out = pitchShift(sine(16000, 5000.0, fs), fs, {12.0});
    CHECK(rms(between(out, 0.2, 0.8, fs)) < 1e-3);
}
