// The brightness that views show of a sound follows its frequency, and is not there in silence.

#include "document/view/SoundBrightness.h"

#include "support/Catch.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace pacini;

namespace
{
/// 100 Hz for a second, silence for one, 400 Hz for one.
std::vector<float> twoTones(int rate)
{
    std::vector<float> samples(static_cast<std::size_t>(3 * rate));
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
        const double t = static_cast<double>(i) / rate;
        const double f = t < 1.0 ? 100.0 : t < 2.0 ? 0.0 : 400.0;
        samples[i] = static_cast<float>(0.5 * std::sin(2.0 * std::numbers::pi * f * t));
    }
    return samples;
}

constexpr Hertz low{30.0}, high{1000.0};
} // namespace

TEST_CASE("The brightness of a sound follows its frequency at any sample rate")
{
    const std::atomic<bool> goOn{false};
    for (const int rate : {2000, 8000, 44100, 96000})
    {
        CAPTURE(rate);
        const auto samples = twoTones(rate);
        const Curve curve = brightnessOf(samples, rate, low, high, goOn);
        REQUIRE_FALSE(curve.empty());
        for (const Breakpoint& p : curve)
        {
            CAPTURE(p.time);
            if (p.time > 0.05 && p.time < 0.95)
                CHECK(p.value == Approx(100.0).margin(4.0));
            else if (p.time > 1.05 && p.time < 1.95)
                CHECK(p.value == 0.0);
            else if (p.time > 2.05 && p.time < 2.95)
                CHECK(p.value == Approx(400.0).margin(4.0));
        }
        CHECK(brightnessIn(curve, 0.5, 0.6).least == Approx(100.0).margin(4.0));
        CHECK(brightnessIn(curve, 0.5, 2.5).greatest == Approx(400.0).margin(4.0));
        CHECK(brightnessIn(curve, 1.4, 1.5).greatest == 0.0);
        CHECK(brightnessIn(curve, 0.5, 0.5001).greatest == Approx(100.0).margin(4.0)); // between two points
        CHECK(brightnessIn(curve, 10.0, 11.0).greatest == 0.0);
    }
}

TEST_CASE("Silence, nothing, broken samples and a stop have no brightness")
{
    std::atomic<bool> stop{false};
    CHECK(brightnessOf(std::span<const float>(), 48000, low, high, stop).empty());
    const std::vector<float> silence(48000);
    CHECK(brightnessOf(silence, 48000, low, high, stop).empty());
    std::vector<float> broken = twoTones(48000);
    for (std::size_t i = 0; i < broken.size(); i += 1000)
        broken[i] = i % 2000 == 0 ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
    for (const Breakpoint& p : brightnessOf(broken, 48000, low, high, stop))
        CHECK((std::isfinite(p.value) && p.value >= 0.0 && p.value <= 1000.0));
    stop = true;
    const auto tones = twoTones(48000);
    CHECK(brightnessOf(tones, 48000, low, high, stop).empty());
}
