#include "support/Catch.h"
#include "support/Measure.h"
#include "support/Render.h"

#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/EnvelopeLeveller.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
constexpr std::size_t hop = 64;

/// Levels a signal whose analytic form is given by `at(n)` to the constant `wanted`; returns the magnitudes that come
/// out.
template <typename At>
std::vector<double> level(At&& at, double wanted, std::size_t hops, double fs = 4000.0)
{
    EnvelopeLeveller leveller(fs, hop);
    std::vector<double> magnitudes, re(hop), im(hop), target(hop, wanted);
    for (std::size_t h = 0; h < hops; ++h)
    {
        for (std::size_t i = 0; i < hop; ++i)
        {
            const auto z = at(h * hop + i);
            re[i] = z.first;
            im[i] = z.second;
        }
        leveller.process(std::array{LevelledPart{re, im}},
                         [&](std::size_t) { return std::span<const double>(target); });
        for (std::size_t i = 0; i < hop; ++i)
            magnitudes.push_back(std::hypot(re[i], im[i]));
    }
    return magnitudes;
}
} // namespace

TEST_CASE("A steady sinusoid comes out at the wanted level", "[synthesis]")
{
    const auto m = level(
        [](std::size_t n) {
            return std::pair(0.3 * std::cos(0.2 * static_cast<double>(n)),
                             0.3 * std::sin(0.2 * static_cast<double>(n)));
        },
        0.5, 20);
    for (std::size_t n = 200; n < m.size(); ++n)
        REQUIRE(m[n] == Approx(0.5).epsilon(1e-4));
}

TEST_CASE("Neighbouring bands do not beat up to 50 times a second, and stay rough from 150 on", "[synthesis]")
{
    // How far the power of the rendered sum of two bands swings at their distance, over its mean: 1 when they are
    // equal.
    const auto swing = [](double beat, double ratio, bool levelled)
    {
        Clip clip;
        clip.duration = 3.0;
        clip.envelope = {{0.0, 0.5}};
        for (const auto& [frequency, amplitude] : {std::pair(300.0, 0.4), std::pair(300.0 + beat, 0.4 * ratio)})
            clip.bands.push_back({frequency, frequency, frequency, 0, {{0.0, amplitude}}, {}});
        DecoderParams params;
        params.sampleRate = 8000.0;
        params.followEnvelope = levelled;
        Decoder decoder(clip, params);
        auto power = test::render(decoder, 4096);
        for (float& v : power)
            v *= v;
        const auto steady = std::span<const float>(power).subspan(4000, 16000); // 2 s: whole beats
        return 2.0 * std::abs(test::spectrumAt(steady, beat, 8000.0)) / std::abs(test::spectrumAt(steady, 0.0, 8000.0));
    };
    for (const double ratio : {1.0, 0.7})
    {
        CAPTURE(ratio);
        for (const double beat : {2.0, 5.0, 8.0, 15.0, 20.0, 30.0, 40.0, 50.0, 80.0, 100.0, 150.0, 200.0})
        {
            CAPTURE(beat);
            CHECK(swing(beat, ratio, false) > 0.9);
            const double left = swing(beat, ratio, true);
            CHECK(left < (beat <= 30.0 ? 0.02 : beat <= 50.0 ? 0.09 : beat <= 100.0 ? 0.6 : 1.01));
            if (beat >= 150.0)
                CHECK(left > 0.8);
        }
    }
}

TEST_CASE("Slow beats of two sinusoids are levelled, fast ones stay", "[synthesis]")
{
    const auto depth = [](double beat)
    {
        const auto m = level(
            [&](std::size_t n)
            {
                const double t = static_cast<double>(n) / 4000.0, a = 2.0 * std::numbers::pi * 300.0 * t,
                             b = 2.0 * std::numbers::pi * (300.0 + beat) * t;
                return std::pair(std::cos(a) + 0.7 * std::cos(b), std::sin(a) + 0.7 * std::sin(b));
            },
            1.0, 100);
        // Depth of the envelope smoothed over 10 ms, which is what the leveller answers for.
        double low = 1e9, high = 0.0;
        for (std::size_t n = 400; n + 40 < m.size(); ++n)
        {
            double sum = 0.0;
            for (std::size_t k = 0; k < 40; ++k)
                sum += m[n + k] / 40.0;
            low = std::min(low, sum);
            high = std::max(high, sum);
        }
        return (high - low) / (high + low);
    };
    CHECK(depth(8.0) < 0.03);
    CHECK(depth(20.0) < 0.10);
    const auto raw = level(
        [](std::size_t n)
        {
            const double a = 0.4 * static_cast<double>(n),
                         b = a + 2.0 * std::numbers::pi * 150.0 * static_cast<double>(n) / 4000.0;
            return std::pair(std::cos(a) + 0.7 * std::cos(b), std::sin(a) + 0.7 * std::sin(b));
        },
        1.0, 100);
    const auto [low, high] = std::minmax_element(raw.begin() + 400, raw.end());
    CHECK((*high - *low) / (*high + *low) > 0.6); // 0.7 before
}

TEST_CASE("Silence stays silence and gains stay bounded", "[synthesis]")
{
    for (double v : level([](std::size_t) { return std::pair(0.0, 0.0); }, 1.0, 10))
        CHECK(v == 0.0);
    for (double v : level([](std::size_t n) { return std::pair(1e-4, n % 2 == 0 ? 1e-4 : 0.0); }, 1.0, 10))
        CHECK(v <= 1e-4 * 1.5 * EnvelopeLeveller::largestGain * EnvelopeLeveller::largestGain);
    for (double v : level([](std::size_t n) { return std::pair(n == 200 ? 1e100 : 1.0, 0.0); }, 1.0, 10))
        CHECK(std::isfinite(v));
}

namespace
{
/// Means of the last `window` values, by the definition.
std::vector<double> meansOf(const std::vector<double>& x, std::size_t window)
{
    std::vector<double> y(x.size(), 0.0);
    for (std::size_t n = 0; n < x.size(); ++n)
        for (std::size_t k = 0; k < window && k <= n; ++k)
            y[n] += x[n - k] / static_cast<double>(window);
    return y;
}
} // namespace

TEST_CASE("A moving average is the mean of the newest values, never below 0, and starts over after reset",
          "[synthesis]")
{
    for (const std::size_t window : {std::size_t(1), std::size_t(2), std::size_t(7), std::size_t(25)})
    {
        CAPTURE(window);
        MovingAverage average(window, 10);
        std::vector<double> x(60);
        for (std::size_t n = 0; n < x.size(); ++n)
            x[n] = static_cast<double>((n * 37) % 11);
        const auto wanted = meansOf(x, window);
        for (int run = 0; run < 2; ++run)
        {
            auto y = x;
            for (std::size_t n = 0; n < y.size(); n += 10)
                average.process(std::span(y).subspan(n, 10));
            for (std::size_t n = 0; n < y.size(); ++n)
                CHECK(y[n] == Approx(wanted[n]).margin(1e-12));
            average.reset();
        }
        std::vector<double> below(10, -1.0);
        average.process(below);
        for (const double v : below)
            CHECK(v == 0.0);
    }
}

TEST_CASE("The leveller divides by the triangle's mean twice, by no more than 18 dB, a window late", "[synthesis]")
{
    for (const double fs : {10.0, 4000.0, 5000.0})
        for (const double wantedLevel : {0.0, 0.5, 20.0})
        {
            CAPTURE(fs, wantedLevel);
            EnvelopeLeveller leveller(fs, hop);
            const std::size_t box = fs < 1000.0 ? 1 : fs < 4500.0 ? 21 : 25; // odd frames in 5 ms
            CHECK(leveller.latencyFrames() == 2 * (box - 1));
            CHECK(leveller.delayOfPass(0) == box - 1);
            CHECK(leveller.delayOfPass(1) == 2 * (box - 1));
            const std::size_t frames = 6 * hop;
            std::vector<double> re(frames), im(frames);
            for (std::size_t n = 0; n < frames; ++n)
            {
                const double a = n < 100 ? 0.0 : n < 200 ? 0.9 : 0.003 * static_cast<double>(n % 50);
                re[n] = a * std::cos(0.4 * static_cast<double>(n));
                im[n] = a * std::sin(0.4 * static_cast<double>(n)) + 0.1 * a;
            }
            const auto target = [&](std::size_t pass, std::size_t n)
            {
                return wantedLevel * (1.0 + 0.3 * static_cast<double>(pass) + 0.001 * static_cast<double>(n));
            };
            auto x = re, y = im;
            for (std::size_t pass = 0; pass < 2; ++pass)
            {
                std::vector<double> magnitude(frames);
                for (std::size_t n = 0; n < frames; ++n)
                    magnitude[n] = std::hypot(x[n], y[n]);
                magnitude = meansOf(meansOf(magnitude, box), box);
                auto lateX = x, lateY = y;
                for (std::size_t n = 0; n < frames; ++n)
                {
                    const double gain = std::min((target(pass, n) + 1e-5) / (magnitude[n] + 1e-5), 8.0);
                    lateX[n] = n >= box - 1 ? gain * x[n - (box - 1)] : 0.0;
                    lateY[n] = n >= box - 1 ? gain * y[n - (box - 1)] : 0.0;
                }
                x = lateX;
                y = lateY;
            }
            for (int run = 0; run < 2; ++run)
            {
                auto u = re, v = im;
                for (std::size_t from = 0; from < frames; from += hop)
                {
                    std::vector<double> wanted(hop);
                    leveller.process(
                        std::array{LevelledPart{std::span(u).subspan(from, hop), std::span(v).subspan(from, hop)}},
                        [&](std::size_t pass)
                        {
                            for (std::size_t n = 0; n < hop; ++n)
                                wanted[n] = target(pass, from + n);
                            return std::span<const double>(wanted);
                        });
                }
                for (std::size_t n = 0; n < frames; ++n)
                {
                    REQUIRE(u[n] == Approx(x[n]).margin(1e-9));
                    REQUIRE(v[n] == Approx(y[n]).margin(1e-9));
                }
                leveller.reset();
            }
        }
    CHECK(EnvelopeLeveller::window == 0.01);
    CHECK(EnvelopeLeveller::largestGain == 8.0);
}

TEST_CASE("Two parts are levelled by themselves first, so that beats of one do not hide in the other", "[synthesis]")
{
    constexpr double fs = 4000.0;
    EnvelopeLeveller leveller(fs, hop, 2);
    CHECK(leveller.delayOfPass(0) == leveller.delayOfPass(1));
    CHECK(leveller.latencyFrames() == leveller.delayOfPass(2));
    CHECK(leveller.delayOfPass(2) == 2 * leveller.delayOfPass(0));
    // A strong steady tone at 70 Hz, and two soft ones at 400 Hz that beat 25 times a second.
    std::vector<double> power; // of what lies high
    std::vector<double> lowRe(hop), lowIm(hop), highRe(hop), highIm(hop), target(hop);
    for (std::size_t h = 0; h < 60; ++h)
    {
        for (std::size_t i = 0; i < hop; ++i)
        {
            const double t = 2.0 * std::numbers::pi * static_cast<double>(h * hop + i) / fs;
            lowRe[i] = 0.8 * std::cos(70.0 * t);
            lowIm[i] = 0.8 * std::sin(70.0 * t);
            highRe[i] = 0.1 * (std::cos(400.0 * t) + std::cos(425.0 * t));
            highIm[i] = 0.1 * (std::sin(400.0 * t) + std::sin(425.0 * t));
        }
        const std::array levels{0.8, 0.141, 0.812};
        leveller.process(std::array{LevelledPart{lowRe, lowIm}, LevelledPart{highRe, highIm}},
                         [&](std::size_t pass)
                         {
                             std::fill(target.begin(), target.end(), levels[pass]);
                             return std::span<const double>(target);
                         });
        for (std::size_t i = 0; i < hop; ++i)
        {
            // What is left without the strong tone, whose phase is known but for the delay.
            const double t = 2.0 * std::numbers::pi *
                             (static_cast<double>(h * hop + i) - static_cast<double>(leveller.latencyFrames())) / fs;
            power.push_back(std::hypot(lowRe[i] - 0.8 * std::cos(70.0 * t), lowIm[i] - 0.8 * std::sin(70.0 * t)));
        }
    }
    // Means over 10 ms: as they came they swing between .02 and .2.
    double least = 1e9, most = 0.0;
    for (std::size_t n = 400; n + 40 < power.size(); ++n)
    {
        const double mean = std::accumulate(power.begin() + static_cast<std::ptrdiff_t>(n),
                                            power.begin() + static_cast<std::ptrdiff_t>(n + 40), 0.0) /
                            40.0;
        least = std::min(least, mean);
        most = std::max(most, mean);
    }
    CHECK(least > 0.08);
    CHECK(most < 0.2);
}
