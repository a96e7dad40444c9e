#include "support/Catch.h"
#include "support/HeapGuard.h"
#include "support/Measure.h"

#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/NoiseBank.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
struct Sum
{
    std::vector<double> re, im;
};

Sum play(NoiseBank& bank, std::size_t frames, std::size_t block)
{
    Sum out{std::vector<double>(frames, 0.0), std::vector<double>(frames, 0.0)};
    for (std::size_t i = 0; i < frames; i += block)
    {
        const std::size_t n = std::min(block, frames - i);
        bank.process(std::span(out.re).subspan(i, n), std::span(out.im).subspan(i, n));
    }
    return out;
}

double meanSquare(const std::vector<double>& x)
{
    double sum = 0.0;
    for (double v : x)
        sum += v * v;
    return sum / static_cast<double>(x.size());
}

/// Power of x around `f` cycles per frame: mean over pieces of 2000 frames.
double powerAt(const std::vector<double>& x, double f)
{
    double power = 0.0;
    for (std::size_t i = 0; i + 2000 <= x.size(); i += 2000)
        power += std::norm(test::spectrumAt(std::span(x).subspan(i, 2000), f, 1.0));
    return power;
}
} // namespace

TEST_CASE("Noise has the level of its curve at any width", "[synthesis][noise]")
{
    for (const double width : {0.002, 0.02, 0.2})
    {
        CAPTURE(width);
        NoiseBank bank({{{{0.0, 0.5}}, 0.25, width}}, 7);
        const auto out = play(bank, 1000000, 64);
        CHECK(std::sqrt(meanSquare(out.re)) == Approx(0.5).epsilon(0.04));
        CHECK(std::sqrt(meanSquare(out.im)) == Approx(0.5).epsilon(0.04));
    }
}

TEST_CASE("Noise lies in its band and has fallen by 3 dB at its edges", "[synthesis][noise]")
{
    NoiseBank bank({{{{0.0, 1.0}}, 0.1, 0.02}}, 1);
    const auto out = play(bank, 2000000, 64);
    const double centre = powerAt(out.im, 0.1);
    CHECK(10.0 * std::log10(powerAt(out.im, 0.12) / centre) == Approx(-3.0).margin(0.6));
    CHECK(10.0 * std::log10(powerAt(out.im, 0.08) / centre) == Approx(-3.0).margin(0.6));
    CHECK(10.0 * std::log10(powerAt(out.im, 0.3) / centre) < -25.0);
}

TEST_CASE("The same seed gives the same noise, however it is cut, and another seed other noise", "[synthesis][noise]")
{
    const std::vector<NoiseCarrier> bands = {{{{0.0, 0.1}, {500.0, 1.0}}, 0.1, 0.02}, {{{0.0, 0.3}}, 0.2, 0.01}};
    NoiseBank a(bands, 5), b(bands, 5), c(bands, 6);
    const auto whole = play(a, 1000, 1000);
    CHECK(play(b, 1000, 7).im == whole.im);
    CHECK(play(c, 1000, 1000).im != whole.im);
    a.reset();
    CHECK(play(a, 1000, 64).re == whole.re);
}

TEST_CASE("The decoder plays a clip's noise at its level and makes no heap traffic", "[synthesis][noise]")
{
    Clip clip;
    clip.duration = 20.0;
    clip.noise = {{100.0, 200.0, {{0.0, 0.2}}}};
    REQUIRE(validate(clip).ok());
    Decoder decoder(clip, {});
    CHECK(decoder.report().noiseBands == 1);
    std::vector<float> out(static_cast<std::size_t>(decoder.totalFrames()));
    const test::HeapGuard guard;
    decoder.process(out);
    decoder.reset();
    CHECK(guard.traffic() == 0);
    CHECK(test::rms(out) == Approx(0.2).epsilon(0.05));
}

TEST_CASE("Noise is white noise through two poles, turned to its centre, as the seeds of its bands say",
          "[synthesis][noise]")
{
    const std::vector<NoiseCarrier> bands = {
        {{{0.0, 0.1}, {200.0, 1.0}, {300.0, 0.0}}, 0.1, 0.02}, {{{50.0, 0.3}}, 0.3, 0.0}, {{{0.0, 0.7}}, 0.02, 0.3}};
    const std::vector<ClockPiece> pieces = {{0.0, 0.0, 1.0, 1.0}, {120.0, 120.0, 2.0, 2.0}, {250.0, 380.0, 0.5, 0.25}};
    NoiseBank bank(bands, 11);
    Sum found{std::vector<double>(400, 1.0), std::vector<double>(400, 2.0)};
    for (std::size_t k = 0; k < pieces.size(); ++k)
    {
        bank.follow(pieces[k]);
        const auto from = static_cast<std::size_t>(pieces[k].from);
        const std::size_t n = (k + 1 < pieces.size() ? static_cast<std::size_t>(pieces[k + 1].from) : 400) - from;
        bank.process(std::span(found.re).subspan(from, n), std::span(found.im).subspan(from, n));
    }
    Sum wanted{std::vector<double>(400, 1.0), std::vector<double>(400, 2.0)};
    for (std::size_t i = 0; i < bands.size(); ++i)
    {
        Random random(11 + i);
        const double unit = std::sqrt(1.5);
        const double pole =
            std::exp(-2.0 * std::numbers::pi * std::max(bands[i].halfWidth / std::sqrt(std::sqrt(2.0) - 1.0), 1e-6));
        const double square = pole * pole;
        const double gain = std::sqrt((1.0 - square) * (1.0 - square) * (1.0 - square) / (1.0 + square));
        std::complex<double> first = 0.0, second = 0.0;
        double phase = 0.0;
        for (std::size_t n = 0; n < 400; ++n)
        {
            const ClockPiece& piece = pieces[n < 120 ? 0 : n < 250 ? 1 : 2];
            double parts[2];
            for (double& part : parts)
            {
                part = random.uniform(-unit, unit);
                part += random.uniform(-unit, unit);
            }
            first = pole * first + std::complex<double>(parts[0], parts[1]);
            second = pole * second + first;
            const double level =
                valueAt(bands[i].amplitude, piece.clip + (static_cast<double>(n) - piece.from) * piece.rate);
            const auto z = gain * level * second * std::polar(1.0, 2.0 * std::numbers::pi * phase);
            wanted.re[n] += z.real();
            wanted.im[n] += z.imag();
            phase += std::min(bands[i].centre * piece.pitch, 0.45);
        }
    }
    for (std::size_t n = 0; n < 400; ++n)
    {
        CAPTURE(n);
        REQUIRE(found.re[n] == Approx(wanted.re[n]).margin(1e-9));
        REQUIRE(found.im[n] == Approx(wanted.im[n]).margin(1e-9));
    }
    // From the start it is the same noise at its own speed.
    bank.reset();
    NoiseBank fresh(bands, 11);
    const Sum again = play(bank, 100, 64), first = play(fresh, 100, 100);
    CHECK(again.re == first.re);
    CHECK(again.im == first.im);
    CHECK_FALSE(bank.empty());
    CHECK(NoiseBank().empty());
    const NoiseCarrier usual;
    CHECK(usual.centre == 0.1);
    CHECK(usual.halfWidth == 0.01);
    // A bank of no bands and no seed adds nothing.
    NoiseBank none;
    CHECK(play(none, 10, 10).re == std::vector<double>(10, 0.0));
}
