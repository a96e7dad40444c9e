#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/evaluate/SignalAnalyzer.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
/// Tones, a modulation, noise of all frequencies and two knocks: loud at both ends, and something in every band.
std::vector<double> analyzedSound(std::size_t frames)
{
    std::vector<double> x(frames);
    Random random(29);
    for (std::size_t n = 0; n < frames; ++n)
    {
        const double t = 2.0 * std::numbers::pi * static_cast<double>(n) / 8000.0;
        x[n] = 0.3 * (1.0 + 0.5 * std::sin(3.0 * t)) * std::sin(47.0 * t + 1.0) + 0.2 * std::cos(310.0 * t) +
               0.1 * std::sin(2300.0 * t) + random.uniform(-0.3, 0.3);
        for (const std::size_t knock : {2000u, 4100u, 33500u})
            if (n >= knock)
                x[n] += 1.4 * std::exp(-static_cast<double>(n - knock) / 200.0) * std::sin(150.0 * t);
    }
    return x;
}

void pinFeature(const std::string& name, const std::vector<float>& values)
{
    const std::vector<double> all(values.begin(), values.end());
    checkPinnedWithEnds("evaluate/" + name, all);
}
} // namespace

TEST_CASE("The judge's features of a sound of any length are what they were", "[evaluate]")
{
    for (const std::size_t length : {1u, 2u, 79u, 161u, 700u, 1599u, 1600u, 5000u, 34011u})
    {
        SignalAnalyzer analyzer(length);
        const auto x = analyzedSound(length);
        const SignalFeatures found = analyzer.analyze(std::span<const double>(x));
        const std::string name = "features of " + std::to_string(length) + " samples";
        CHECK(found.length == length);
        REQUIRE(found.outOfBand.has_value());
        checkPinned("evaluate/" + name + ", numbers",
                    {found.scale, found.rms, *found.outOfBand, static_cast<double>(found.wide.size()),
                     static_cast<double>(found.framePower.size()), static_cast<double>(found.thirdOctaves[0].size())},
                    1e-5);
        pinFeature(name + ", wide", found.wide);
        pinFeature(name + ", frame power", found.framePower);
        pinFeature(name + ", centroid", found.centroid);
        checkPinned("evaluate/" + name + ", onsets", found.onsets);
        std::vector<double> spacings;
        std::vector<float> bands, bandEnds, octaves, octaveEnds;
        for (const BandEnvelope& band : found.bands)
        {
            spacings.push_back(static_cast<double>(band.spacing));
            bands.insert(bands.end(), band.values.begin(), band.values.end());
            bandEnds.push_back(band.values.front());
            bandEnds.push_back(band.values.back());
        }
        for (const auto& band : found.thirdOctaves)
        {
            octaves.insert(octaves.end(), band.begin(), band.end());
            octaveEnds.push_back(band.front());
        }
        checkPinned("evaluate/" + name + ", spacings", spacings);
        pinFeature(name + ", bands", bands);
        checkPinned("evaluate/" + name + ", ends of bands", std::vector<double>(bandEnds.begin(), bandEnds.end()),
                    1e-4);
        pinFeature(name + ", third octaves", octaves);
        checkPinned("evaluate/" + name + ", starts of third octaves",
                    std::vector<double>(octaveEnds.begin(), octaveEnds.end()), 1e-4);
    }
}

TEST_CASE("The judge analyses the length that it was made for, whatever it is given", "[evaluate]")
{
    const auto x = analyzedSound(3000);
    SignalAnalyzer analyzer(2000);
    const auto exact = analyzer.analyze(std::span(x).first(2000));
    const auto longer = analyzer.analyze(std::span<const double>(x));
    CHECK(longer.length == 2000);
    CHECK(longer.wide == exact.wide);
    CHECK(longer.rms == exact.rms);
    auto padded = x;
    std::fill(padded.begin() + 1200, padded.end(), 0.0);
    const auto shorter = analyzer.analyze(std::span(x).first(1200));
    const auto silent = analyzer.analyze(std::span<const double>(padded));
    CHECK(shorter.wide == silent.wide);
    CHECK(shorter.framePower == silent.framePower);
    CHECK(shorter.rms == silent.rms);
    CHECK(SignalAnalyzer(0).analyze(std::span<const double>(x)).length == 1);
}

TEST_CASE("What is not finite counts as silence for the judge, and is counted", "[evaluate]")
{
    auto x = analyzedSound(2500);
    x[100] = x[101] = x[2450] = 0.0;
    auto bad = x;
    bad[100] = std::numeric_limits<double>::quiet_NaN();
    bad[101] = std::numeric_limits<double>::infinity();
    bad[2450] = -std::numeric_limits<double>::infinity();
    SignalAnalyzer analyzer(2400);
    const auto expected = analyzer.analyze(std::span<const double>(x));
    const auto found = analyzer.analyze(std::span<const double>(bad));
    CHECK(expected.nonFinite == 0);
    CHECK(found.nonFinite == 3); // one of them is after the length
    CHECK(found.wide == expected.wide);
    CHECK(found.scale == expected.scale);
}

TEST_CASE("The judge's features of silence are zeros without an energy ratio", "[evaluate]")
{
    SignalAnalyzer analyzer(4000);
    const auto found = analyzer.analyze(std::span<const float>(std::vector<float>(4000)));
    CHECK_FALSE(found.outOfBand.has_value());
    CHECK(found.rms == 0.0);
    CHECK(found.scale == 1.0);
    CHECK(found.onsets.empty());
    CHECK(found.wide == std::vector<float>(500));
    CHECK(found.framePower == std::vector<float>(52));
    CHECK(found.centroid == std::vector<float>(52));
    for (const auto& band : found.thirdOctaves)
        CHECK(band == std::vector<float>(49));
}

TEST_CASE("The energy ratio of a tone far outside the band, and of one inside, is what its filter leaves", "[evaluate]")
{
    // 1 / (1 + q^8) of the amplitude stays inside, the rest outside.
    const auto ratio = [](double f)
    {
        std::vector<double> x(16000);
        for (std::size_t n = 0; n < x.size(); ++n)
            x[n] = 0.7 * std::sin(2.0 * std::numbers::pi * f * static_cast<double>(n) / 8000.0);
        SignalAnalyzer analyzer(x.size());
        return analyzer.analyze(std::span<const double>(x)).outOfBand.value();
    };
    const auto expected = [](double f)
    {
        const double q = (f * f - 30000.0) / (f * 970.0);
        return 20.0 * std::log10(std::pow(q, 8.0));
    };
    for (const double f : {1000.0, 1100.0, 1500.0})
        CHECK(ratio(f) == Approx(expected(f)).margin(0.3));
    CHECK(ratio(200.0) < -40.0);
}

TEST_CASE("Frame centroids of a tone are its frequency, at the full and at half the rate", "[evaluate]")
{
    FrameCentroids centroids;
    const auto tone = [](double f, double rate, std::size_t frames, double phase)
    {
        std::vector<float> x(frames);
        for (std::size_t n = 0; n < frames; ++n)
            x[n] = static_cast<float>(std::sin(2.0 * std::numbers::pi * f * static_cast<double>(n) / rate + phase));
        return x;
    };
    for (const double f : {70.3, 200.0, 411.7, 900.0})
    {
        CAPTURE(f);
        const auto fine = centroids.fine(tone(f, 8000.0, 512, 0.3));
        const auto coarse = centroids.coarse(tone(f, 4000.0, 256, 0.3), tone(1.1 * f, 4000.0, 256, 0.0));
        CHECK(fine.centroid == Approx(f).epsilon(2e-3));
        CHECK(coarse[0].centroid == Approx(f).epsilon(2e-3));
        CHECK(coarse[0].power == Approx(fine.power).epsilon(1e-3));
        if (f < 800.0)
            CHECK(coarse[1].centroid == Approx(1.1 * f).epsilon(2e-3));
        // Twice the energy of the frame's window: Parseval's sum over half a transform of twice the length.
        CHECK(fine.power == Approx(0.25 * 0.375 * 512.0 * 1024.0).epsilon(5e-3));
    }
    CHECK(centroids.fine(std::vector<float>(512)).centroid == 0.0f);
    CHECK(centroids.fine(std::vector<float>(512)).power == 0.0f);
    // Bins of 7.8125 Hz from 31.25 to 1000 Hz count.
    const auto below = centroids.fine(tone(10.0, 8000.0, 512, 0.0));
    CHECK(below.centroid >= 31.25f);
    const auto click = [&]
    {
        std::vector<float> x(512);
        x[256] = 1.0f;
        return centroids.fine(x);
    }();
    CHECK(click.power == Approx(125.0));
    CHECK(click.centroid == Approx((31.25 + 1000.0) / 2.0));
}

TEST_CASE("Frame means of few samples weigh as they did", "[evaluate]")
{
    std::vector<float> unit(40, 0.0f);
    for (const auto& [intervals, spacing] : {std::pair<std::size_t, std::size_t>{4, 40}, {8, 20}, {10, 16}, {1, 1}})
    {
        const FrameMean mean(intervals, spacing);
        std::vector<double> weights;
        double sum = 0.0;
        for (std::size_t i = 0; i < intervals + 5; ++i)
        {
            std::fill(unit.begin(), unit.end(), 0.0f);
            unit[i + 3] = 1.0f;
            weights.push_back(static_cast<double>(mean.of(unit, 5)));
            sum += weights.back();
        }
        CHECK(sum == Approx(1.0).epsilon(1e-6));
        checkPinned("evaluate/weights of a frame mean, " + std::to_string(intervals) + " intervals of " +
                        std::to_string(spacing),
                    weights, 1e-6);
    }
    CHECK(FrameMean::reachFrames == 2);
}
