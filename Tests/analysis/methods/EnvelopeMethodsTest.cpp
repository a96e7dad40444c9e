#include "MethodSignals.h"
#include "support/BlockContract.h"
#include "support/Catch.h"

#include <pacini/analysis/methods/EnvelopeCentroid.h>
#include <pacini/analysis/methods/EnvelopeSine.h>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("envelope-sine plays the modulation of the sound on 80 Hz, and nothing of its pitch", "[methods]")
{
    for (const double fs : {8000.0, 44100.0})
    {
        auto sound = sine(static_cast<std::size_t>(4.0 * fs), 410.0, fs);
        for (std::size_t n = 0; n < sound.size(); ++n)
            sound[n] *=
                static_cast<float>(0.5 + 0.3 * std::sin(2.0 * std::numbers::pi * 4.0 * static_cast<double>(n) / fs));
        const Clip clip = envelopeSineClip(sound, fs);
        REQUIRE(clip.bands.size() == 1);
        CHECK(clip.envelope.empty());
        CHECK(clip.transients.empty());
        const auto out = played(clip, fs);
        const auto steady = between(out, 1.0, 3.0, fs);
        CAPTURE(fs);
        const double carrier = amplitudeAt(steady, 80.0, fs);
        // The sound is normalised: a mean of 0.5/0.8, the sidebands 0.3/2 of it; the follower reads rather high.
        CHECK(carrier == Approx(0.5 / 0.8).epsilon(0.1));
        CHECK(amplitudeAt(steady, 76.0, fs) / carrier == Approx(0.3).epsilon(0.1));
        CHECK(amplitudeAt(steady, 84.0, fs) / carrier == Approx(0.3).epsilon(0.1));
        double aside = 0.0;
        for (const double f : {10.0, 40.0, 160.0, 240.0, 400.0, 410.0, 820.0})
            aside = std::max(aside, amplitudeAt(steady, f, fs));
        CHECK(aside < 0.01);
    }
}

TEST_CASE("envelope-sine stands where it is told", "[methods]")
{
    EnvelopeSineParams params;
    params.frequency = 155_Hz;
    const auto out = played(envelopeSineClip(noise(16000, 1), 8000.0, params), 8000.0);
    CHECK(strongestFrequency(out, 30.0, 900.0, 8000.0) == Approx(155.0).epsilon(5e-3));
}

TEST_CASE("envelope-centroid follows the pitch of a tone", "[methods]")
{
    for (const double fs : {8000.0, 44100.0})
    {
        auto sound = sine(static_cast<std::size_t>(fs), 120.0, fs);
        const auto second = sine(static_cast<std::size_t>(fs), 480.0, fs);
        sound.insert(sound.end(), second.begin(), second.end());
        const auto out = played(envelopeCentroidClip(sound, fs), fs);
        CAPTURE(fs);
        CHECK(strongestFrequency(between(out, 0.3, 0.8, fs), 30.0, 900.0, fs) == Approx(120.0).epsilon(0.01));
        CHECK(strongestFrequency(between(out, 1.3, 1.8, fs), 30.0, 900.0, fs) == Approx(480.0).epsilon(0.01));
        // The follower reads a tone half a decibel low: its attack outlasts the crests.
        CHECK(rms(between(out, 0.3, 0.8, fs)) * std::sqrt(2.0) == Approx(0.95).epsilon(0.02));
    }
}

TEST_CASE("The pitch of envelope-centroid stays within its range", "[methods]")
{
    const double fs = 44100.0;
    for (const auto& [f, expected] : {std::pair(8.0, 20.0), std::pair(1600.0, 1000.0)})
    {
        const Clip clip = envelopeCentroidClip(sine(44100, f, fs), fs);
        REQUIRE(clip.bands[0].pitch.size() >= 2);
        for (const Breakpoint& point : clip.bands[0].pitch)
        {
            CHECK(point.value >= 20.0);
            CHECK(point.value <= 1000.0);
        }
        CHECK(valueAt(clip.bands[0].pitch, 0.5) == Approx(expected).epsilon(0.2));
    }
}
