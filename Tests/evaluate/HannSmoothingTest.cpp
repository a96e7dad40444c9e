#include "support/Catch.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/evaluate/AnalyticBand.h>
#include <pacini/evaluate/BandLimitedSegment.h>
#include <pacini/evaluate/HannSmoothing.h>
#include <pacini/evaluate/PeakScale.h>
#include <pacini/evaluate/Segmentation.h>
#include <pacini/foundation/Random.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
std::vector<float> smoothedNoise(std::size_t count)
{
    Random random(3);
    std::vector<float> x(count);
    for (float& v : x)
        v = static_cast<float>(random.uniform(0.0, 1.0));
    return x;
}
} // namespace

TEST_CASE("Hann kernels of any width are the cosine between their zeros", "[evaluate]")
{
    for (const double halfWidth : {0.5, 1.0, 1.5, 2.0, 4.05, 81.0})
    {
        CAPTURE(halfWidth);
        const HannKernel kernel(halfWidth);
        const auto reach = static_cast<std::size_t>(std::ceil(halfWidth)) - 1;
        CHECK(kernel.reachFrames() == reach);
        double sum = 0.0;
        for (int i = -static_cast<int>(reach); i <= static_cast<int>(reach); ++i)
            sum += 0.5 + 0.5 * std::cos(std::numbers::pi * i / halfWidth);
        std::vector<float> unit(2 * reach + 5);
        for (std::size_t at = 0; at < unit.size(); ++at)
        {
            std::fill(unit.begin(), unit.end(), 0.0f);
            unit[at] = 1.0f;
            const double distance = static_cast<double>(at) - static_cast<double>(reach + 2);
            const double expected = std::abs(distance) < halfWidth
                                        ? (0.5 + 0.5 * std::cos(std::numbers::pi * distance / halfWidth)) / sum
                                        : 0.0;
            CHECK(kernel.at(unit, reach + 2) == Approx(expected).margin(1e-7));
        }
        const auto x = smoothedNoise(7);
        std::vector<double> all;
        for (std::size_t centre = 0; centre < 7 + 2 * reach + 3; ++centre)
            all.push_back(static_cast<double>(kernel.at(x, centre)));
        checkPinned("evaluate/smoothing of 7 samples by " + std::to_string(halfWidth), all, 1e-5);
        CHECK(kernel.at(x, 7 + reach) == 0.0f);
        CHECK(kernel.at({}, 0) == 0.0f);
        for (const double position : {0.0, 3.0, 20.0, 97.0, 99.0})
            for (const double spacing : {1.0, 4.0})
                checkPinned("evaluate/end correction by " + std::to_string(halfWidth) + " at " +
                                std::to_string(static_cast<int>(position)) + " of 100, " +
                                std::to_string(static_cast<int>(spacing)),
                            {kernel.endCorrection(position, spacing, 100)});
    }
    CHECK(HannKernel(3.0).endCorrection(50.0, 4.0, 1000) == Approx(1.0));
}

TEST_CASE("Coverage of cells at both ends", "[evaluate]")
{
    CHECK(coverage(0.0, 1.0, 1) == 1.0);
    CHECK(coverage(0.0, 4.0, 100) == Approx(2.5 / 4.0));
    CHECK(coverage(99.0, 4.0, 100) == Approx(2.5 / 4.0));
    CHECK(coverage(50.0, 4.0, 100) == 1.0);
    CHECK(coverage(-2.5, 4.0, 100) == 0.0);
    CHECK(coverage(-9.0, 4.0, 100) == 0.0);
    CHECK(coverage(101.0, 4.0, 100) == Approx(0.125));
    CHECK(coverage(0.0, 10.0, 2) == Approx(0.2));
}

TEST_CASE("Peaks are scaled to between 1 and 2 by a power of two", "[evaluate]")
{
    const auto scale = [](std::vector<double> x)
    {
        return peakScale(std::span<const double>(x));
    };
    CHECK(scale({}) == 1.0);
    CHECK(scale({0.0, -0.0}) == 1.0);
    CHECK(scale({0.3, -0.75}) == 0.5);
    CHECK(scale({1.0}) == 1.0);
    CHECK(scale({1.999, -1.0}) == 1.0);
    CHECK(scale({2.0}) == 2.0);
    CHECK(scale({-1000.0, 3.0}) == 512.0);
    CHECK(scale({std::numeric_limits<double>::infinity(), 3.0, std::numeric_limits<double>::quiet_NaN()}) == 2.0);
    CHECK(scale({1e-310}) == 1e-300);
    CHECK(peakScale(std::span<const float>(std::vector<float>{1e-45f})) == 0x1p-149);
}

TEST_CASE("Segments cover signals on their grid, in one piece or with their overlaps", "[evaluate]")
{
    const SegmentationParams params{.quantum = 10, .lead = 20, .padding = 50, .overlap = 30, .longestCore = 100};
    for (const std::size_t length : {1u, 10u, 11u, 99u, 100u})
    {
        const Segmentation single(length, params);
        REQUIRE(single.segments().size() == 1);
        const Segment piece = single.segments().front();
        CHECK(piece.begin == -20);
        CHECK(piece.coreBegin == 0);
        CHECK(piece.coreEnd == length);
        CHECK(single.size() == 10 * nextFastFftSize(((length + 9) / 10 * 10 + 50) / 10));
    }
    CHECK(Segmentation(0, params).segments().size() == 1);
    CHECK(Segmentation(0, params).segments().front().coreEnd == 0);
    CHECK(Segmentation(0, params).size() == 60);
    const Segmentation many(250, params);
    REQUIRE(many.segments().size() == 3);
    CHECK(many.size() == 160);
    CHECK(many.segments()[0].begin == -30);
    CHECK(many.segments()[1].begin == 70);
    CHECK(many.segments()[1].coreBegin == 100);
    CHECK(many.segments()[1].coreEnd == 200);
    CHECK(many.segments()[2].coreEnd == 250);
    CHECK(Segmentation(101, params).segments().size() == 2);
    CHECK(Segmentation(200, params).segments().size() == 2);
    CHECK(many.segments()[1].localIndex(100) == 30);
    CHECK(many.segments()[1].localIndex(100, 10) == 3);
    const SegmentationParams usual;
    CHECK(test::asNumbers(usual.quantum, usual.lead, usual.padding, usual.overlap, usual.longestCore) ==
          test::Numbers{1, 0, 0, 0, 1});
    CHECK(Segment{}.begin == 0);
    CHECK(Segment{}.coreBegin == 0);
    CHECK(Segment{}.coreEnd == 0);
}

TEST_CASE("Copies of a segment have the signal where it is and silence elsewhere", "[evaluate]")
{
    const std::vector<double> x{1.0, 2.0, std::numeric_limits<double>::quiet_NaN(), 4.0};
    const auto copy = [&](std::ptrdiff_t begin, std::size_t size)
    {
        std::vector<float> buffer(size, 9.0f);
        copySegment(std::span<const double>(x), {begin, 0, 0}, 2.0f, std::span(buffer));
        return buffer;
    };
    CHECK(copy(0, 4) == std::vector<float>{2.0f, 4.0f, 0.0f, 8.0f});
    CHECK(copy(-2, 8) == std::vector<float>{0.0f, 0.0f, 2.0f, 4.0f, 0.0f, 8.0f, 0.0f, 0.0f});
    CHECK(copy(-3, 4) == std::vector<float>{0.0f, 0.0f, 0.0f, 2.0f});
    CHECK(copy(3, 3) == std::vector<float>{8.0f, 0.0f, 0.0f});
    CHECK(copy(4, 2) == std::vector<float>{0.0f, 0.0f});
    CHECK(copy(9, 2) == std::vector<float>{0.0f, 0.0f});
    CHECK(copy(-9, 2) == std::vector<float>{0.0f, 0.0f});
}

TEST_CASE("Zero-phase band-passes of every order are the square of a Butterworth response", "[evaluate]")
{
    CHECK(zeroPhaseBandpass(0.0, 30.0, 1000.0, 4) == 0.0);
    CHECK(zeroPhaseBandpass(-100.0, 30.0, 1000.0, 4) == 0.0);
    for (int order = 1; order < 6; ++order)
    {
        CHECK(zeroPhaseBandpass(30.0, 30.0, 1000.0, order) == Approx(0.5));
        CHECK(zeroPhaseBandpass(1000.0, 30.0, 1000.0, order) == Approx(0.5));
        const double q = (1500.0 * 1500.0 - 30000.0) / (1500.0 * 970.0);
        CHECK(zeroPhaseBandpass(1500.0, 30.0, 1000.0, order) == Approx(1.0 / (1.0 + std::pow(q, 2 * order))));
    }
}

TEST_CASE("Bands reach as far as they are above -100 dB, whatever the order", "[evaluate]")
{
    const std::size_t size = 320;
    InverseTransforms transforms;
    Random random(8);
    SplitArray<float> spectrum(size / 2 + 1);
    for (std::size_t k = 0; k <= size / 2; ++k)
    {
        spectrum.re[k] = static_cast<float>(random.uniform(-1.0, 1.0));
        spectrum.im[k] = k == 0 || k == size / 2 ? 0.0f : static_cast<float>(random.uniform(-1.0, 1.0));
    }
    for (const auto& [f1, f2, order] :
         {std::tuple{200.0, 400.0, 3}, {30.0, 1000.0, 2}, {900.0, 3000.0, 4}, {31.0, 35.0, 1}})
        for (const std::size_t outputs : {320u, 64u, 20u})
        {
            const auto band = AnalyticBand::butterworth(size, outputs, 8000.0, f1, f2, order);
            CHECK(band.outputCount() == outputs);
            SplitArray<float> scratch(size), out(size);
            band.sample(spectrum, transforms, scratch, out);
            std::vector<double> found;
            for (std::size_t j = 0; j < outputs; ++j)
            {
                double re = 0.0;
                double im = 0.0;
                for (std::size_t k = 0; k <= size / 2; ++k)
                {
                    const double g = zeroPhaseBandpass(25.0 * static_cast<double>(k), f1, f2, order) *
                                     (k == 0 || k == size / 2 ? 1.0 : 2.0) / static_cast<double>(size);
                    const double angle =
                        2.0 * std::numbers::pi * static_cast<double>(k * j) / static_cast<double>(outputs);
                    const auto a = static_cast<double>(spectrum.re[k]);
                    const auto b = static_cast<double>(spectrum.im[k]);
                    re += g * (a * std::cos(angle) - b * std::sin(angle));
                    im += g * (a * std::sin(angle) + b * std::cos(angle));
                }
                CHECK(out.re[j] == Approx(re).margin(1e-5));
                CHECK(out.im[j] == Approx(im).margin(1e-5));
                found.push_back(static_cast<double>(out.re[j]));
                found.push_back(static_cast<double>(out.im[j]));
            }
            checkPinned("evaluate/band " + std::to_string(static_cast<int>(f1)) + " by " + std::to_string(outputs),
                        found, 1e-5);
        }
}

TEST_CASE("A segment's energies are those of its core, inside and outside the band", "[evaluate]")
{
    const std::size_t size = 1600;
    BandLimitedSegment limited(size, 8000.0, 30.0, 1000.0);
    std::vector<double> x(1400);
    Random random(44);
    for (double& v : x)
        v = random.uniform(-1.0, 1.0);
    const Segment segment{-100, 50, 900};
    BandLimitEnergies energies;
    limited.load(std::span<const double>(x), segment, 0.5, energies);
    double total = 0.0;
    for (std::size_t i = 50; i < 900; ++i)
        total += 0.25 * x[i] * x[i];
    CHECK(energies.total == Approx(total));
    checkPinned("evaluate/energies of a segment", {energies.total, energies.inside, energies.outside}, 1e-5);
    const std::vector<double> samples(limited.samples().begin(), limited.samples().end());
    checkPinned("evaluate/samples of a segment", samples, 1e-5);
    checkPinned("evaluate/spectrum of a segment",
                std::vector<double>(limited.spectrum().re.begin(), limited.spectrum().re.end()), 1e-5);
    double inside = 0.0;
    double outside = 0.0;
    for (std::size_t i = 50; i < 900; ++i)
    {
        inside += samples[i + 100] * samples[i + 100];
        outside += (0.5 * x[i] - samples[i + 100]) * (0.5 * x[i] - samples[i + 100]);
    }
    CHECK(energies.inside == Approx(inside));
    CHECK(energies.outside == Approx(outside));
    limited.load(std::span<const double>(x), segment, 0.5, energies);
    CHECK(energies.total == Approx(2.0 * total)); // adds up
    limited.cutSamples(segment, 1000);
    for (std::size_t i = 0; i < size; ++i)
        CHECK(static_cast<double>(limited.samples()[i]) == (i < 100 || i >= 1100 ? 0.0 : samples[i]));
    limited.cutSamples({300, 0, 0}, 200);
    CHECK(limited.samples()[150] == 0.0f);
}
