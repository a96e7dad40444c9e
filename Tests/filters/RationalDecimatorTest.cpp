#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/filters/RationalDecimator.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
std::vector<float> tone(int fs, double frequency, double seconds)
{
    std::vector<float> x(static_cast<std::size_t>(fs * seconds));
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = static_cast<float>(std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(i) / fs));
    return x;
}

std::vector<float> convert(const std::vector<float>& x, int fs, std::size_t chunk)
{
    RationalDecimator decimator(fs, 4000);
    std::vector<float> y;
    for (std::size_t i = 0; i < x.size(); i += chunk)
        decimator.push(std::span(x).subspan(i, std::min(chunk, x.size() - i)), y);
    decimator.finish(y);
    return y;
}
} // namespace

TEST_CASE("Decimated tones stay where they are in time, level and phase at every rate", "[filters]")
{
    for (int fs : {8000, 11025, 12345, 22050, 44100, 48000, 96000, 384000})
        for (double frequency : {20.0, 333.0, 1000.0, 1650.0})
        {
            CAPTURE(fs, frequency);
            const auto y = convert(tone(fs, frequency, 0.5), fs, 1000);
            REQUIRE(y.size() == 2000);
            double worst = 0.0;
            for (std::size_t n = 200; n < 1800; ++n)
                worst =
                    std::max(worst, std::abs(static_cast<double>(y[n]) - std::sin(2.0 * std::numbers::pi * frequency *
                                                                                  static_cast<double>(n) / 4000.0)));
            CHECK(worst < 2e-3);
        }
}

TEST_CASE("Tones above the stop frequency do not fold into the tactile range", "[filters]")
{
    for (int fs : {8000, 44100, 192000})
        for (double frequency : {2700.0, 3300.0, 3950.0})
        {
            CAPTURE(fs, frequency);
            const auto y = convert(tone(fs, frequency, 0.5), fs, 4096);
            for (std::size_t n = 200; n < 1800; ++n)
                REQUIRE(std::abs(y[n]) < 2e-3f);
        }
}

TEST_CASE("Decimation does not depend on how the input is cut and keeps its length", "[filters]")
{
    const auto x = tone(44100, 200.0, 0.2);
    const auto whole = convert(x, 44100, x.size());
    CHECK(whole.size() == 800);
    CHECK(convert(x, 44100, 1) == whole);
    CHECK(convert(x, 44100, 997) == whole);
    CHECK(convert({}, 44100, 1).empty());
    CHECK(convert({1.0f}, 44100, 1).size() == 1);
}

TEST_CASE("A decimator gives each frame as soon as the last input that it needs is there", "[filters]")
{
    for (const int fs : {8000, 11025, 44100})
    {
        CAPTURE(fs);
        RationalDecimator decimator(fs, 4000);
        CHECK(decimator.inputRate() == fs);
        // Kaiser's length for 60 dB between 1700 and 2600 Hz, rounded up to eight.
        const double order = (60.0 - 7.95) / (14.36 * 900.0 / fs);
        const auto taps = (static_cast<std::int64_t>(std::ceil(order)) + 1 + 7) / 8 * 8;
        std::vector<float> out;
        const auto x = tone(fs, 300.0, 0.1);
        for (std::size_t i = 0; i < x.size(); ++i)
        {
            decimator.push(std::span(x).subspan(i, 1), out);
            std::size_t expected = 0;
            while (static_cast<std::int64_t>(expected) * fs / 4000 + taps / 2 + 1 <= static_cast<std::int64_t>(i) + 1)
                ++expected;
            REQUIRE(out.size() == expected);
        }
        decimator.finish(out);
        CHECK(out.size() == (x.size() * 4000 + static_cast<std::size_t>(fs) - 1) / static_cast<std::size_t>(fs));
    }
}

TEST_CASE("A reset decimator is a new one, and equal rates change nothing", "[filters]")
{
    const auto x = tone(44100, 200.0, 0.1);
    RationalDecimator decimator(44100, 4000);
    std::vector<float> first, again, whole;
    decimator.push(x, first);
    decimator.reset();
    decimator.push(x, again);
    CHECK(again == first);
    decimator.finish(again);
    CHECK(again == convert(x, 44100, x.size()));
    decimator.reset();
    std::vector<float> none;
    decimator.finish(none);
    CHECK(none.empty());
    RationalDecimator same(4000, 4000);
    same.push(x, whole);
    same.finish(whole);
    CHECK(whole == x);
}

TEST_CASE("What a decimator makes of a click is what it made before", "[filters]")
{
    const auto answer = [](int fs, const RationalDecimatorParams& params)
    {
        RationalDecimator decimator(fs, 4000, params);
        std::vector<float> x(static_cast<std::size_t>(fs / 100), 0.0f), y;
        x[x.size() / 2] = 1.0f;
        decimator.push(x, y);
        decimator.finish(y);
        return std::vector<double>(y.begin(), y.end());
    };
    checkPinned("filters/decimator from 44.1 kHz", answer(44100, {}), 3e-6);
    checkPinned("filters/decimator from 8 kHz", answer(8000, {}), 3e-6);
    checkPinned("filters/decimator, 90 dB", answer(48000, {1000_Hz, 1500_Hz, 90_dB}), 1e-5);
    checkPinned("filters/decimator, 20 dB", answer(12345, {1000_Hz, 3000_Hz, 20_dB}), 3e-6);
}
