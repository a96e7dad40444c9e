#include "support/Catch.h"

#include <pacini/filters/RationalDecimator.h>

#include <numbers>

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
