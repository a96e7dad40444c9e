// Keyframes of HJIF stand where they are needed, and their waves are near what they were.

#include "io/formats/hjif/HjifFit.h"

#include "io/formats/hjif/HjifFormat.h"
#include "support/Catch.h"

#include <pacini/synthesis/Decoder.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

using namespace pacini;

namespace
{
/// Bands that beat and swell, with a point every millisecond.
Clip swellingBands()
{
    Clip clip;
    clip.duration = 2.0;
    for (const double frequency : {90.0, 105.0, 180.0})
    {
        Band band{0.9 * frequency, frequency, 1.1 * frequency, 0, {}, {{0.0, frequency}}};
        for (int n = 0; n <= 2000; ++n)
        {
            const double t = 0.001 * n;
            band.amplitude.push_back({t, 0.2 + 0.15 * std::sin(2.0 * std::numbers::pi * (0.05 * frequency * t))});
        }
        clip.bands.push_back(std::move(band));
    }
    return clip;
}

std::vector<float> playedWith(Clip clip, const std::vector<Curve>& curves)
{
    for (std::size_t i = 0; i < curves.size(); ++i)
        clip.bands[i].amplitude = curves[i];
    DecoderParams params;
    params.sampleRate = 4000.0;
    Decoder decoder(clip, params);
    std::vector<float> samples(static_cast<std::size_t>(decoder.totalFrames()));
    decoder.process(samples);
    return samples;
}

double errorOf(const std::vector<float>& samples, const std::vector<float>& wanted)
{
    double error = 0.0;
    for (std::size_t n = 0; n < samples.size(); ++n)
        error += std::pow(static_cast<double>(samples[n]) - static_cast<double>(wanted[n]), 2.0);
    return error;
}

std::size_t pointsBetween(const std::vector<Curve>& curves, double from, double to)
{
    std::size_t points = 0;
    for (const Curve& curve : curves)
        for (const Breakpoint& point : curve)
            points += point.time >= from && point.time <= to ? 1 : 0;
    return points;
}
} // namespace

TEST_CASE("Keyframes that get their values together are nearer to the waves than those that do not", "[formats]")
{
    const Clip clip = swellingBands();
    const auto wanted = playedWith(clip, {});
    const HjifFit alone(clip, 0.01, false), together(clip, 0.01, true);
    const std::vector<double> need(alone.steps(), 1.0);
    const auto before = alone.curves(60.0, need), after = together.curves(60.0, need);
    REQUIRE(before.size() == clip.bands.size());
    for (std::size_t band = 0; band < before.size(); ++band)
    {
        REQUIRE(after[band].size() == before[band].size());
        for (std::size_t i = 0; i < before[band].size(); ++i)
            CHECK(after[band][i].time == before[band][i].time);
    }
    CHECK(errorOf(playedWith(clip, after), wanted) < 0.9 * errorOf(playedWith(clip, before), wanted));
}

TEST_CASE("Keyframes of HJIF are more where they are needed more, and fewer at a higher price", "[formats]")
{
    const Clip clip = swellingBands();
    const HjifFit fit(clip, 0.01, true);
    std::vector<double> need(fit.steps(), 1.0);
    const auto few = fit.curves(60.0, need);
    CHECK(pointsBetween(fit.curves(200.0, need), 0.0, 2.0) < pointsBetween(few, 0.0, 2.0));
    for (std::size_t i = 200; i < 240; ++i)
        need[i] = 9.0;
    const auto more = fit.curves(60.0, need);
    CHECK(pointsBetween(more, 1.0, 1.2) > pointsBetween(few, 1.0, 1.2));
    CHECK(pointsBetween(more, 0.0, 0.9) <= pointsBetween(few, 0.0, 0.9) + 3);
}

TEST_CASE("Keyframes of HJIF are the same ones for a clip of any strength", "[formats]")
{
    const Clip clip = swellingBands();
    constexpr double stronger = 512.0;
    Clip strong = clip;
    for (Band& band : strong.bands)
        for (Breakpoint& point : band.amplitude)
            point.value *= stronger;
    const HjifFit fit(clip, 0.01, true), strongFit(strong, 0.01 * stronger, true);
    const std::vector<double> need(fit.steps(), 1.0);
    const auto curves = fit.curves(60.0, need), strongCurves = strongFit.curves(60.0, need);
    for (std::size_t band = 0; band < curves.size(); ++band)
    {
        REQUIRE(strongCurves[band].size() == curves[band].size());
        for (std::size_t i = 0; i < curves[band].size(); ++i)
        {
            CHECK(strongCurves[band][i].time == curves[band][i].time);
            CHECK(strongCurves[band][i].value / stronger == Approx(curves[band][i].value).margin(1e-6));
        }
    }
}

TEST_CASE("Silent and very short bands have keyframes, too, or none", "[formats]")
{
    for (const double duration : {0.0, 0.001, 0.006, 0.011})
    {
        CAPTURE(duration);
        Clip clip;
        clip.duration = duration;
        clip.bands.push_back({90.0, 100.0, 110.0, 0, {{0.0, 0.5}, {duration, 0.5}}, {{0.0, 100.0}}});
        clip.bands.push_back({180.0, 200.0, 220.0, 0, {{0.0, 0.0}, {duration, 0.0}}, {{0.0, 200.0}}});
        const HjifFit fit(clip, 0.01, true);
        const auto curves = fit.curves(12.0, std::vector<double>(fit.steps(), 1.0));
        REQUIRE(curves.size() == 2);
        CHECK(curves[1].empty());
        for (const Breakpoint& point : curves[0])
            CHECK(point.value == Approx(0.5).margin(0.05));
        clip.envelope = {{0.0, 0.5}, {duration, 0.5}}; // levelled clips are searched
        const auto exported = writeHjif(clip, {});
        REQUIRE(exported);
        CHECK(isHjif(exported->files.at(0).bytes));
    }
}
