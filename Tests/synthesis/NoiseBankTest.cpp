#include "support/Catch.h"
#include "support/HeapGuard.h"
#include "support/Measure.h"

#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/NoiseBank.h>

#include <cmath>

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
