#include "MethodSignals.h"
#include "support/BlockContract.h"
#include "support/Catch.h"

#include <pacini/analysis/methods/CentroidFlatness.h>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("The centroid of a tone becomes a pitch on a logarithmic scale", "[methods]")
{
    // Two decades of centroid on one decade of pitch: pitch = 40 sqrt(f / 100).
    const double fs = 44100.0;
    for (const double f : {100.0, 400.0, 1000.0, 2500.0, 10000.0})
    {
        const Clip clip = centroidFlatnessClip(sine(44100, f, fs), fs);
        const double expected = 4.0 * std::sqrt(f);
        CAPTURE(f);
        REQUIRE(clip.bands.size() == 4);
        CHECK(strongestFrequency(between(played(clip, fs), 0.2, 0.8, fs), 30.0, 900.0, fs) ==
              Approx(expected).epsilon(0.01));
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t p = 0; p < clip.bands[i].pitch.size(); ++p)
                CHECK(clip.bands[i].pitch[p].value ==
                      Approx((2.0 * static_cast<double>(i) + 1.0) * clip.bands[0].pitch[p].value));
    }
}

TEST_CASE("Centroids outside 100 Hz to 10 kHz have the lowest and the highest pitch", "[methods]")
{
    const double fs = 44100.0;
    for (const auto& [f, pitch] : {std::pair(50.0, 40.0), std::pair(15000.0, 400.0)})
    {
        const Clip clip = centroidFlatnessClip(sine(44100, f, fs), fs);
        CAPTURE(f);
        REQUIRE(!clip.bands[0].pitch.empty());
        for (const Breakpoint& point : clip.bands[0].pitch)
        {
            CHECK(point.value >= 39.999);
            CHECK(point.value <= 400.001);
        }
        CHECK(valueAt(clip.bands[0].pitch, 0.5) == Approx(pitch).epsilon(0.01));
    }
}

TEST_CASE("A tone plays as a square wave, noise as a sine", "[methods]")
{
    const double fs = 16000.0;
    // A centroid of 900 Hz is a pitch of 120 Hz.
    const auto square = played(centroidFlatnessClip(sine(32000, 900.0, fs), fs), fs);
    const auto steady = between(square, 0.5, 1.5, fs);
    const double fundamental = amplitudeAt(steady, 120.0, fs);
    CHECK(fundamental == Approx(0.92).epsilon(0.03)); // sqrt(1 / (1 + 1/9 + 1/25 + 1/49))
    CHECK(amplitudeAt(steady, 360.0, fs) / fundamental == Approx(1.0 / 3.0).epsilon(0.03));
    CHECK(amplitudeAt(steady, 600.0, fs) / fundamental == Approx(1.0 / 5.0).epsilon(0.03));
    CHECK(amplitudeAt(steady, 840.0, fs) / fundamental == Approx(1.0 / 7.0).epsilon(0.03));
    // In phase: a square wave is flat, its crest factor far below that of the same partials as cosines (1.82).
    float largest = 0.0f;
    for (const float v : steady)
        largest = std::max(largest, std::abs(v));
    CHECK(static_cast<double>(largest) / rms(steady) < 1.35);

    const Clip hiss = centroidFlatnessClip(noise(32000, 3), fs);
    CHECK(curveEnergy(hiss.bands[1].amplitude, 2.0) < 0.005 * curveEnergy(hiss.bands[0].amplitude, 2.0));
}

TEST_CASE("The cross-fade from sine to square keeps its power", "[methods]")
{
    for (const double tonality : {0.0, 0.2, 0.5, 0.8, 1.0})
        for (const auto& weights :
             {std::array<double, 4>{1.0, 1.0, 1.0, 1.0}, std::array<double, 4>{1.0, 0.5, 0.0, 0.0}})
        {
            double power = 0.0;
            for (const double a : detail::sineToSquare(tonality, weights))
                power += a * a;
            CHECK(power == Approx(1.0));
        }
    CHECK(detail::sineToSquare(0.0, {1.0, 1.0, 1.0, 1.0})[0] == Approx(1.0));
}

TEST_CASE("Tonality is 0 for a flat spectrum and 1 from -60 dB of flatness on", "[methods]")
{
    CHECK(tonalityOf(1.0) == 0.0);
    CHECK(tonalityOf(1e-3) == Approx(0.5));
    CHECK(tonalityOf(1e-6) == Approx(1.0));
    CHECK(tonalityOf(1e-9) == 1.0);
    CHECK(tonalityOf(0.0) == 1.0);
}

TEST_CASE("Harmonics that skin does not feel are silent", "[methods]")
{
    const double fs = 44100.0;
    const Clip clip = centroidFlatnessClip(sine(44100, 9000.0, fs), fs); // 379 Hz: 1138 Hz is too high
    CHECK(!clip.bands[0].amplitude.empty());
    CHECK(valueAt(clip.bands[0].amplitude, 0.5) == Approx(1.0).epsilon(0.02));
    for (std::size_t i = 1; i < 4; ++i)
    {
        CAPTURE(i);
        CHECK(curveEnergy(clip.bands[i].amplitude, 1.0) < 1e-6);
    }
}

TEST_CASE("The decay of the envelope is adjustable", "[methods]")
{
    const double fs = 8000.0;
    auto sound = sine(8000, 500.0, fs);
    std::fill(sound.begin() + 4000, sound.end(), 0.0f);
    for (const Seconds release : {30_ms, 300_ms})
    {
        CentroidFlatnessParams params;
        params.curves.follower.release = release;
        params.curves.breakpoints = 200.0;
        const Clip clip = centroidFlatnessClip(sound, fs, params);
        const double end = 0.5 + params.curves.follower.hold.value;
        // 99 % of the way down after the release: 90 % after half of it.
        const double before = valueAt(clip.bands[0].amplitude, 0.45);
        CHECK(valueAt(clip.bands[0].amplitude, end + release.value / 2.0) / before == Approx(0.1).epsilon(0.25));
    }
}

TEST_CASE("A centroid above the highest that counts has the highest pitch, and below the lowest the lowest",
          "[methods]")
{
    const double fs = 8000.0;
    const auto x = noise(4000, 4);
    CentroidFlatnessParams params;
    params.lowCentroid = Hertz(100.0);
    params.highCentroid = Hertz(500.0);
    const Clip high = centroidFlatnessClip(x, fs, params);
    REQUIRE_FALSE(high.bands.front().pitch.empty());
    for (const Breakpoint& point : high.bands.front().pitch)
        CHECK(point.value == Approx(400.0));
    params.lowCentroid = Hertz(3900.0);
    params.highCentroid = Hertz(8000.0);
    const Clip low = centroidFlatnessClip(x, fs, params);
    for (const Breakpoint& point : low.bands.front().pitch)
        CHECK(point.value == Approx(40.0));
}
