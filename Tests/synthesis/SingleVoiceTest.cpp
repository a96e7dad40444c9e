#include "support/Catch.h"
#include "support/RandomClip.h"

#include <pacini/synthesis/SingleVoice.h>

#include <cmath>

using namespace pacini;

namespace
{
Band steadyBand(double frequency, double amplitude)
{
    return {0.8 * frequency, frequency, 1.25 * frequency, 0, {{0.0, amplitude}, {1.0, amplitude}}, {}};
}

Clip twoBands(double first, double second)
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {steadyBand(100.0, first), steadyBand(400.0, second)};
    return clip;
}
} // namespace

TEST_CASE("One voice has the power of all bands and the frequency of the strongest", "[synthesis]")
{
    const SingleVoice voice = singleVoiceOf(twoBands(0.4, 0.3));
    REQUIRE(valueAt(voice.amplitude, 0.5) == Approx(0.5));
    REQUIRE(valueAt(voice.frequency, 0.5) == Approx(100.0));
    // The other is more than a third of an octave away from it.
    REQUIRE(valueAt(voice.displaced, 0.5) == Approx(0.3));
}

TEST_CASE("One voice keeps a frequency of 1 Hz", "[synthesis]")
{
    Clip clip = twoBands(0.4, 0.1);
    clip.bands[0] = steadyBand(1.0, 0.4);
    clip.bands[1] = steadyBand(1.0, 0.1);
    const SingleVoice voice = singleVoiceOf(clip);
    REQUIRE_FALSE(voice.frequency.empty());
    CHECK(valueAt(voice.frequency, 0.5) == 1.0);
}

TEST_CASE("What one voice cannot play where it is counts less, by its distance", "[synthesis]")
{
    // 400 Hz are 0.415 octaves above 300 Hz and count 8.3 dB less.
    REQUIRE(valueAt(singleVoiceOf(twoBands(0.20, 0.5)).frequency, 0.5) == Approx(100.0));
    REQUIRE(valueAt(singleVoiceOf(twoBands(0.18, 0.5)).frequency, 0.5) == Approx(400.0));
    REQUIRE(valueAt(singleVoiceOf(twoBands(0.18, 0.5), 50.0, 200.0).frequency, 0.5) == Approx(100.0));
    REQUIRE(valueAt(singleVoiceOf(twoBands(0.20, 0.5), 50.0, 1000.0).frequency, 0.5) == Approx(400.0));
}

TEST_CASE("Bands of about one frequency count together for one voice", "[synthesis]")
{
    Clip clip = twoBands(0.5, 0.0);
    clip.bands[1] = steadyBand(200.0, 0.4);
    REQUIRE(valueAt(singleVoiceOf(clip).frequency, 0.5) == Approx(100.0));
    clip.bands.push_back(steadyBand(205.0, 0.4));
    REQUIRE(valueAt(singleVoiceOf(clip).frequency, 0.5) == Approx(200.0).epsilon(0.03));
}

TEST_CASE("One voice steps to another band when that is noticeably stronger, and does not take turns between equals",
          "[synthesis]")
{
    Clip clip = twoBands(0.5, 0.0);
    clip.bands[1] = steadyBand(200.0, 0.0);
    clip.bands[1].amplitude = {{0.0, 0.0}, {1.0, 1.0}};
    for (int i = 0; i <= 100; ++i) // the curve bends often enough to see when
        clip.envelope.push_back({0.01 * i, 0.5});
    const Curve frequency = singleVoiceOf(clip).frequency;
    const double due = 0.5 * std::pow(10.0, 1.0 / 20.0); // s: 1 dB above 0.5
    REQUIRE(valueAt(frequency, due - 0.011) == Approx(100.0));
    REQUIRE(valueAt(frequency, due + 0.011) == Approx(200.0));
    Curve::size_type steps = 0;
    for (std::size_t i = 1; i < frequency.size(); ++i)
        steps += frequency[i].value != frequency[i - 1].value;
    REQUIRE(steps == 1);

    clip.bands[1].amplitude.clear();
    for (int i = 0; i <= 100; ++i) // within 1 dB of the other all the time
        clip.bands[1].amplitude.push_back({0.01 * i, i % 2 == 0 ? 0.46 : 0.54});
    const Curve steady = singleVoiceOf(clip).frequency;
    for (const Breakpoint& point : steady)
        REQUIRE(point.value == Approx(steady.front().value));
}

TEST_CASE("One voice follows the envelope where there is one, and its events keep what it does not reach",
          "[synthesis]")
{
    Clip clip = twoBands(0.3, 0.4);
    clip.envelope = {{0.0, 0.1}, {0.5, 0.1}, {0.5, 0.9}, {1.0, 0.9}};
    clip.transients = {{0.2, 0.6, 0.5}, {0.7, 0.6, 0.5}};
    const SingleVoice voice = singleVoiceOf(clip);
    REQUIRE(valueAt(voice.amplitude, 0.49) == Approx(0.1));
    REQUIRE(valueAt(voice.amplitude, 0.51) == Approx(0.9));
    REQUIRE(voice.events.size() == 2);
    REQUIRE(voice.events[0].amplitude == Approx(std::sqrt(0.6 * 0.6 - 0.2 * 0.2)));
    REQUIRE(voice.events[1].amplitude == 0.0);
}

TEST_CASE("A clip of one band comes through as it is, over the whole time", "[synthesis]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {{50.0, 100.0, 200.0, 0, {{0.25, 0.3}, {0.5, 0.8}, {0.5, 0.1}}, {{0.5, 120.0}}}};
    const SingleVoice voice = singleVoiceOf(clip);
    REQUIRE(voice.amplitude == Curve{{0.0, 0.3}, {0.25, 0.3}, {0.5, 0.8}, {0.5, 0.1}, {1.0, 0.1}});
    REQUIRE(voice.frequency == Curve{{0.0, 120.0}, {0.5, 120.0}, {1.0, 120.0}});
    REQUIRE(voice.displaced.empty());
}

TEST_CASE("Any valid clip makes a voice with times in order, from 0 to its end", "[synthesis]")
{
    for (std::uint64_t seed = 0; seed < 200; ++seed)
    {
        CAPTURE(seed);
        const Clip clip = test::randomFullClip(seed);
        const SingleVoice voice = singleVoiceOf(clip);
        for (const Curve* curve : {&voice.amplitude, &voice.frequency})
        {
            if (curve->empty())
                continue;
            REQUIRE(curve->front().time == 0.0);
            REQUIRE(curve->back().time == clip.duration);
            for (std::size_t i = 1; i < curve->size(); ++i)
                REQUIRE((*curve)[i - 1].time <= (*curve)[i].time);
            for (const Breakpoint& point : *curve)
                REQUIRE(std::isfinite(point.value));
        }
        REQUIRE(voice.events.size() == clip.transients.size());
    }
}
