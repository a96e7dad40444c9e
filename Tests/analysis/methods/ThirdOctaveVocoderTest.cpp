#include "MethodSignals.h"
#include "support/BlockContract.h"
#include "support/Catch.h"

#include <pacini/analysis/methods/ThirdOctaveVocoder.h>

#include <algorithm>
#include <functional>
#include <variant>
#include <vector>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("A tone at the centre of a channel is in that channel", "[methods]")
{
    const double fs = 44100.0;
    for (std::size_t k = 0; k < 16; ++k)
    {
        const double centre = 200.0 * std::pow(2.0, static_cast<double>(k) / 3.0);
        const Clip clip = thirdOctaveVocoderClip(sine(22050, centre, fs), fs);
        REQUIRE(clip.bands.size() == 16);
        CAPTURE(k, centre);
        CHECK(clip.bands[k].centreFrequency == Approx(centre));
        CHECK(clip.bands[k].priority == 0);
        const auto level = [&](std::size_t channel)
        {
            return valueAt(clip.bands[channel].amplitude, 0.4);
        };
        // A third octave off, a Butterworth band-pass of sixth order is 19 dB down.
        for (std::size_t other = 0; other < 16; ++other)
            if (other != k)
                CHECK(level(other) < 0.13 * level(k));
    }
}

TEST_CASE("The levels of channels follow the levels of their tones", "[methods]")
{
    const double fs = 32000.0;
    const auto low = sine(32000, 400.0, fs, 0.8);
    const auto high = sine(32000, 3200.0, fs, 0.2);
    std::vector<float> both(low.size());
    std::transform(low.begin(), low.end(), high.begin(), both.begin(), std::plus<>());
    const Clip clip = thirdOctaveVocoderClip(both, fs);
    const double ratio = valueAt(clip.bands[3].amplitude, 0.6) / valueAt(clip.bands[12].amplitude, 0.6);
    // The follower reads the slower tone a little higher: a crest lasts longer than its attack.
    CHECK(ratio == Approx(4.0).epsilon(0.06));
    CHECK(clip.bands[3].priority == 0);
    CHECK(clip.bands[12].priority < 4); // after its stronger neighbour's skirts
}

TEST_CASE("All channels play on one carrier of 100 Hz and stay within full drive", "[methods]")
{
    const double fs = 16000.0;
    const Clip clip = thirdOctaveVocoderClip(noise(32000, 7), fs);
    for (const Band& band : clip.bands)
        CHECK(band.pitch == Curve{{0.0, 100.0}});
    const auto out = played(clip, fs);
    CHECK(strongestFrequency(out, 20.0, 2000.0, fs) == Approx(100.0).epsilon(1e-3));
    float largest = 0.0f;
    for (const float v : out)
        largest = std::max(largest, std::abs(v));
    CHECK(largest < 1.05f);
    CHECK(largest > 0.7f);
}

TEST_CASE("Channels that do not fit below 0.45 of the sample rate are left out", "[methods]")
{
    for (const auto& [fs, channels] : {std::pair(8000.0, 13), std::pair(9600.0, 13), std::pair(11025.0, 14),
                                       std::pair(16000.0, 16), std::pair(44100.0, 16), std::pair(384000.0, 16)})
    {
        const Clip clip = thirdOctaveVocoderClip(noise(2000, 1), fs);
        CAPTURE(fs);
        CHECK(clip.bands.size() == static_cast<std::size_t>(channels));
        CHECK(clip.bands.back().highFrequency <= 0.45 * fs);
        for (std::size_t k = 1; k < clip.bands.size(); ++k)
            CHECK(clip.bands[k].lowFrequency == Approx(clip.bands[k - 1].highFrequency));
    }
}

TEST_CASE("The gain that keeps the sum of the channels within full drive is told", "[methods]")
{
    const double fs = 16000.0;
    const auto gainOf = [](const Clip& clip)
    {
        double gain = 0.0;
        for (const auto& [key, value] : clip.encoder)
            if (key == "channelGain")
                gain = std::get<double>(value);
        return gain;
    };
    // One tone is in one channel and in the skirts of its neighbours; noise is in all of them.
    CHECK(gainOf(thirdOctaveVocoderClip(sine(16000, 400.0, fs), fs)) > 0.4);
    const Clip clip = thirdOctaveVocoderClip(noise(16000, 7), fs);
    CHECK(gainOf(clip) < 0.35);
    CHECK(gainOf(clip) > 0.1);
    double largest = 0.0;
    for (double time = 0.0; time < 1.0; time += 0.001)
    {
        double sum = 0.0;
        for (const Band& band : clip.bands)
            sum += band.amplitude.empty() ? 0.0 : valueAt(band.amplitude, time);
        largest = std::max(largest, sum);
    }
    CHECK(largest == Approx(1.0).margin(0.1));
}
