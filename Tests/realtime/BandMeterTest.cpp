#include "support/Catch.h"

#include <pacini/realtime/BandMeter.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

using namespace pacini;

namespace
{
/// Frequency as the bilinear transform sees it.
double warped(double f, double fs)
{
    return std::tan(std::numbers::pi * f / fs);
}

/// Small's low part of third order, (1 + 3 s) / (s + 1)^3, at s = j f / edge.
std::complex<double> lowPart(double f, double edge, double fs)
{
    const std::complex<double> s(0.0, warped(f, fs) / warped(edge, fs));
    return (1.0 + 3.0 * s) / std::pow(s + 1.0, 3);
}

std::vector<double> tone(std::size_t frames, double f, double fs, double amplitude)
{
    std::vector<double> x(frames);
    for (std::size_t n = 0; n < frames; ++n)
        x[n] = amplitude * std::sin(2.0 * std::numbers::pi * f * static_cast<double>(n) / fs);
    return x;
}
} // namespace

TEST_CASE("the band meter shows of a tone what Small's crossovers leave of it in each band", "[realtime]")
{
    const double fs = 6000.0;
    for (const std::size_t bands : {1u, 2u, 5u, 6u, 12u})
    {
        const BandLayout layout = designBandLayout({.bands = bands});
        BandMeter meter;
        meter.design(layout, fs);
        for (const double f : {20.0, 60.0, 170.0, 500.0, 1300.0})
        {
            CAPTURE(bands, f);
            meter.reset();
            meter.process(tone(6000, f, fs, 0.5));
            for (std::size_t k = 0; k < bands; ++k)
                (void)meter.takePower(k);
            meter.flush();
            // A second is a whole number of periods.
            meter.process(tone(6000, f, fs, 0.5));
            for (std::size_t k = 0; k < bands; ++k)
            {
                const double upper = std::min(layout.upperEdge(k).value, 0.4999 * fs); // two bands would end above
                const double lower = layout.lowerEdge(k).value;
                const double part = std::norm(lowPart(f, upper, fs) - lowPart(f, lower, fs));
                CHECK(meter.takePower(k) == Approx(6000.0 * 0.125 * part).epsilon(1e-3));
                CHECK(meter.takePower(k) == 0.0);
            }
        }
    }
}

TEST_CASE("the band meter has forgotten all after a reset", "[realtime]")
{
    BandMeter meter;
    meter.design(designBandLayout({}), 6000.0);
    meter.process(tone(100, 200.0, 6000.0, 1.0));
    meter.reset();
    meter.process(std::vector<double>(100, 0.0));
    for (std::size_t k = 0; k < 6; ++k)
        CHECK(meter.takePower(k) == 0.0);
}

TEST_CASE("a band meter as designed anew hears nothing of what it heard, and of a fade no denormal number is left",
          "[realtime]")
{
    BandMeter meter, fresh;
    meter.design(designBandLayout({.bands = 3}), 6000.0);
    meter.process(tone(500, 300.0, 6000.0, 1.0));
    for (BandMeter* one : {&meter, &fresh})
    {
        one->design(designBandLayout({.bands = 9}), 8000.0);
        one->process(tone(700, 150.0, 8000.0, 0.7));
    }
    for (std::size_t k = 0; k < 9; ++k)
        CHECK(meter.takePower(k) == fresh.takePower(k));
    // What is flushed every frame falls to exact zeros.
    for (int n = 0; n < 200000; ++n)
    {
        meter.process(std::vector<double>(1, 0.0));
        meter.flush();
    }
    for (std::size_t k = 0; k < 9; ++k)
        (void)meter.takePower(k);
    meter.process(std::vector<double>(100, 0.0));
    for (std::size_t k = 0; k < 9; ++k)
        CHECK(meter.takePower(k) == 0.0);
}
