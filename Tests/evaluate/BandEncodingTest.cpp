#include "support/Catch.h"

#include <pacini/evaluate/AnalyticBand.h>
#include <pacini/evaluate/FrameSpectra.h>
#include <pacini/evaluate/HannSmoothing.h>
#include <pacini/evaluate/Segmentation.h>
#include <pacini/evaluate/SignalAnalyzer.h>
#include <pacini/foundation/Random.h>
#include <pacini/foundation/Windows.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

using namespace pacini;

namespace
{
std::vector<double> doubleNoise(std::size_t n)
{
    Random random(n);
    std::vector<double> x(n);
    for (double& v : x)
        v = random.uniform(-1.0, 1.0);
    return x;
}

SplitArray<double> spectrumOf(const std::vector<double>& x)
{
    SplitRealFft<double> fft(x.size());
    SplitArray<double> spectrum(fft.bins());
    fft.forward(x.data(), spectrum.re.data(), spectrum.im.data());
    return spectrum;
}
} // namespace

TEST_CASE("Zero-phase band-pass: half amplitude at the edges, one at the geometric centre, slope by its order",
          "[evaluate]")
{
    for (const int order : {2, 3, 4})
    {
        CHECK(zeroPhaseBandpass(30.0, 30.0, 1000.0, order) == Approx(0.5));
        CHECK(zeroPhaseBandpass(1000.0, 30.0, 1000.0, order) == Approx(0.5));
        CHECK(zeroPhaseBandpass(std::sqrt(30000.0), 30.0, 1000.0, order) == Approx(1.0));
        CHECK(zeroPhaseBandpass(0.0, 30.0, 1000.0, order) == 0.0);
        // Far above, every octave takes 2 * order * 6.02 dB.
        const double ratio = zeroPhaseBandpass(4e5, 30.0, 1000.0, order) / zeroPhaseBandpass(8e5, 30.0, 1000.0, order);
        CHECK(std::log2(ratio) == Approx(2.0 * order).margin(0.02));
    }
}

TEST_CASE("A band sampled at a lower rate has exactly the samples of the full rate", "[evaluate]")
{
    const std::size_t size = 1920;
    const auto spectrum = spectrumOf(doubleNoise(size));
    InverseTransforms transforms;
    SplitArray<float> scratch(size), full(size), coarse(size);
    for (const std::size_t spacing : {2u, 4u, 8u, 20u})
    {
        AnalyticBand::butterworth(size, size, 8000.0, 200.0, 400.0, 3).sample(spectrum, transforms, scratch, full);
        const auto band = AnalyticBand::butterworth(size, size / spacing, 8000.0, 200.0, 400.0, 3);
        REQUIRE(band.outputCount() == size / spacing);
        band.sample(spectrum, transforms, scratch, coarse);
        for (std::size_t j = 0; j < size / spacing; ++j)
        {
            CHECK(std::abs(coarse.re[j] - full.re[j * spacing]) < 1e-6f);
            CHECK(std::abs(coarse.im[j] - full.im[j * spacing]) < 1e-6f);
        }
    }
}

TEST_CASE("The analytic signal of a sine is its phasor, scaled by the band", "[evaluate]")
{
    const std::size_t size = 1600;
    std::vector<double> x(size);
    for (std::size_t i = 0; i < size; ++i)
        x[i] = std::cos(2.0 * std::numbers::pi * 400.0 * static_cast<double>(i) / 8000.0);
    InverseTransforms transforms;
    SplitArray<float> scratch(size), z(size);
    AnalyticBand::butterworth(size, size, 8000.0, 200.0, 400.0, 3).sample(spectrumOf(x), transforms, scratch, z);
    for (std::size_t i = 0; i < size; ++i)
    {
        const auto expected = 0.5 * std::polar(1.0, 2.0 * std::numbers::pi * 400.0 * static_cast<double>(i) / 8000.0);
        CHECK(std::abs(std::complex<double>(z.re[i], z.im[i]) - expected) < 1e-5);
    }
    // With all bins the real part is the signal itself.
    AnalyticBand(size, size, 0, std::vector<float>(size / 2 + 1, 1.0f)).sample(spectrumOf(x), transforms, scratch, z);
    for (std::size_t i = 0; i < size; ++i)
        CHECK(std::abs(static_cast<double>(z.re[i]) - x[i]) < 1e-5);
}

TEST_CASE("Smoothing has unit sum, is centred, and treats the outside as zero", "[evaluate]")
{
    const HannKernel kernel(10.5);
    const std::vector<float> ones(100, 1.0f);
    CHECK(kernel.at(ones, 50) == Approx(1.0));
    CHECK(kernel.at(ones, 0) == Approx(0.5).margin(0.06));
    CHECK(kernel.at(ones, 99) == Approx(kernel.at(ones, 0)));
    CHECK(kernel.at(std::vector<float>(), 0) == 0.0f);
    std::vector<float> impulse(100);
    impulse[50] = 1.0f;
    for (std::size_t d = 0; d < 20; ++d)
    {
        const double distance = static_cast<double>(d);
        const double expected = d < 11 ? (0.5 + 0.5 * std::cos(std::numbers::pi * distance / 10.5)) / 10.5 : 0.0;
        CHECK(kernel.at(impulse, 50 + d) == Approx(expected).margin(1e-4));
        CHECK(kernel.at(impulse, 50 - d) == Approx(expected).margin(1e-4));
    }
}

TEST_CASE("Smoothing of coarse samples is right at the ends of a signal too", "[evaluate]")
{
    const HannKernel fine(81.0);
    for (const std::size_t length : {1601u, 1613u, 1700u})
        for (const std::size_t spacing : {4u, 10u, 20u})
        {
            CAPTURE(length, spacing);
            const HannKernel coarse(81.0 / static_cast<double>(spacing));
            const std::vector<float> ones(length, 1.0f);
            std::vector<float> cells(length / spacing + 20);
            for (std::size_t j = 0; j < cells.size(); ++j)
                cells[j] = static_cast<float>(
                    coverage(static_cast<double>(j * spacing), static_cast<double>(spacing), length));
            for (std::size_t at = 0; at < length; at += spacing)
            {
                const double corrected =
                    static_cast<double>(coarse.at(cells, at / spacing)) *
                    coarse.endCorrection(static_cast<double>(at), static_cast<double>(spacing), length);
                // The cell before the first sample is missing here, as at() takes it for silence.
                if (at >= spacing)
                    CHECK(corrected == Approx(static_cast<double>(fine.at(ones, at))).margin(2e-3));
            }
            CHECK(coarse.endCorrection(800.0, static_cast<double>(spacing), length) == Approx(1.0).margin(1e-3));
        }
}

TEST_CASE("Coverage is the share of a cell inside the signal", "[evaluate]")
{
    CHECK(coverage(50.0, 5.0, 100) == 1.0);
    CHECK(coverage(0.0, 5.0, 100) == Approx(3.0 / 5.0));
    CHECK(coverage(99.0, 1.0, 100) == 1.0);
    CHECK(coverage(100.0, 5.0, 100) == Approx(2.0 / 5.0));
    CHECK(coverage(-10.0, 5.0, 100) == 0.0);
    CHECK(coverage(120.0, 5.0, 100) == 0.0);
}

TEST_CASE("Frame means from few samples equal the mean of all of them", "[evaluate]")
{
    for (const std::size_t spacing : {1u, 5u, 20u, 40u})
        for (const double samplesPerPeriod : {7.0, 10.0, 25.0})
        {
            CAPTURE(spacing, samplesPerPeriod);
            const double w = 2.0 * std::numbers::pi / (samplesPerPeriod * static_cast<double>(spacing));
            const auto curve = [w](double t)
            {
                return 1.5 + std::cos(w * t + 0.4);
            };
            std::vector<float> coarse(200);
            for (std::size_t j = 0; j < coarse.size(); ++j)
                coarse[j] = static_cast<float>(curve(static_cast<double>(j * spacing)));
            double sum = 0.0;
            for (std::size_t i = 0; i < 160; ++i)
                sum += curve(static_cast<double>(10 * spacing + i));
            const FrameMean mean(160 / spacing, spacing);
            CHECK(static_cast<double>(mean.of(coarse, 10)) == Approx(sum / 160.0).margin(1.5e-3));
        }
}

TEST_CASE("Two frames at once have the spectra of each alone", "[evaluate]")
{
    Random random(4);
    std::vector<float> a(24), b(24);
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        a[i] = static_cast<float>(random.uniform(-1.0, 1.0));
        b[i] = static_cast<float>(random.uniform(-10.0, 10.0));
    }
    const auto window = hannPeriodic(24);
    FrameSpectra spectra(window, 48);
    std::vector<float> powerA(20), powerB(20);
    spectra.power(a, b, 3, powerA, powerB);
    for (std::size_t i = 0; i < powerA.size(); ++i)
    {
        std::complex<double> sumA = 0.0, sumB = 0.0;
        for (std::size_t m = 0; m < a.size(); ++m)
        {
            const auto turn = std::polar(window[m], -2.0 * std::numbers::pi * static_cast<double>((i + 3) * m) / 48.0);
            sumA += static_cast<double>(a[m]) * turn;
            sumB += static_cast<double>(b[m]) * turn;
        }
        CHECK(static_cast<double>(powerA[i]) == Approx(std::norm(sumA)).epsilon(1e-4).margin(1e-4));
        CHECK(static_cast<double>(powerB[i]) == Approx(std::norm(sumB)).epsilon(1e-4).margin(1e-4));
    }
}

TEST_CASE("Segments cover a signal exactly and on the grid", "[evaluate]")
{
    const SegmentationParams params{
        .quantum = 160, .lead = 320, .padding = 4000, .overlap = 4000, .longestCore = 32960};
    for (const std::size_t length : {0u, 1u, 159u, 160u, 161u, 32960u, 32961u, 65920u, 65921u, 1000000u})
    {
        CAPTURE(length);
        const Segmentation segmentation(length, params);
        CHECK(segmentation.size() % 320 == 0);
        std::size_t at = 0;
        for (const Segment& segment : segmentation.segments())
        {
            CHECK(segment.coreBegin == at);
            CHECK(segment.begin % 160 == 0);
            CHECK(segment.begin <= static_cast<std::ptrdiff_t>(segment.coreBegin));
            const auto bufferEnd = segment.begin + static_cast<std::ptrdiff_t>(segmentation.size());
            CHECK(bufferEnd - static_cast<std::ptrdiff_t>(segment.coreEnd) >= 3680);
            at = segment.coreEnd;
        }
        CHECK(at == length);
    }
}
