#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/analysis/OnsetFeatures.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
/// Noise, a low and a bright tone and an offset, with a knock in the middle.
std::vector<float> bandedSound(std::size_t frames, double fs, std::size_t channels = 1)
{
    std::vector<float> x(frames * channels);
    Random random(77);
    for (std::size_t n = 0; n < frames; ++n)
        for (std::size_t c = 0; c < channels; ++c)
        {
            const double t = 2.0 * std::numbers::pi * static_cast<double>(n) / fs;
            const double knock = n > frames / 2 ? 1.0 : 0.3;
            x[n * channels + c] = static_cast<float>(
                0.1 + knock * (0.3 * std::sin(31.0 * t + static_cast<double>(c)) + 0.2 * std::sin(140.0 * t) +
                               0.1 * std::sin(290.0 * t) + random.uniform(-0.3, 0.3)));
        }
    return x;
}

std::vector<OnsetFrame> onsetFramesOf(const std::vector<float>& x, double fs, std::size_t channels = 1)
{
    OnsetFeatures features(fs, channels);
    features.push(x);
    features.finish();
    return {features.frames().begin(), features.frames().end()};
}

void pinFrames(const std::string& name, const std::vector<OnsetFrame>& frames)
{
    std::vector<double> powers, bands, ends;
    const auto add = [](std::vector<double>& to, float power)
    {
        to.push_back(std::sqrt(static_cast<double>(power)));
    };
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
        add(powers, frames[i].power);
        add(powers, frames[i].lowPower);
        for (const float band : frames[i].bands)
            add(bands, band);
        if (i < 2 || i + 2 >= frames.size())
            for (const std::size_t b : {0u, 2u, 3u, 6u})
                add(ends, frames[i].bands[b]);
    }
    checkPinned("analysis/" + name + ", powers", powers, 1e-5);
    checkPinned("analysis/" + name + ", bands", bands, 1e-5);
    checkPinned("analysis/" + name + ", ends", ends, 1e-4);
    // Each band alone, so that a weak one counts as much as a strong one.
    for (std::size_t b = 0; b < OnsetFrame::bandCount && frames.size() > 2; ++b)
    {
        std::vector<double> band;
        for (const OnsetFrame& frame : frames)
            add(band, frame.bands[b]);
        checkPinned("analysis/" + name + ", band " + std::to_string(b), band, 1e-5);
    }
}
} // namespace

TEST_CASE("The powers of onset frames are what they were at every rate", "[analysis][onsets]")
{
    for (const double fs : {2000.0, 7200.0, 8000.0, 22050.0, 39999.0, 40000.0, 48000.0, 96000.0, 192000.0})
    {
        const auto x = bandedSound(static_cast<std::size_t>(0.2 * fs) + 3, fs);
        const auto frames = onsetFramesOf(x, fs);
        CHECK(frames.size() == static_cast<std::size_t>(std::ceil(static_cast<double>(x.size()) * 900.0 / fs)));
        pinFrames("onset frames at " + std::to_string(static_cast<int>(fs)), frames);
    }
}

TEST_CASE("The powers of onset frames of a few samples and of several channels are what they were",
          "[analysis][onsets]")
{
    for (const std::size_t frames : {1u, 2u, 53u, 54u, 55u, 300u, 2600u, 2700u})
        pinFrames("onset frames of " + std::to_string(frames) + " samples",
                  onsetFramesOf(bandedSound(frames, 48000.0), 48000.0));
    pinFrames("onset frames of two channels", onsetFramesOf(bandedSound(9000, 44100.0, 2), 44100.0, 2));
    pinFrames("onset frames of three channels", onsetFramesOf(bandedSound(5000, 11025.0, 3), 11025.0, 3));
    CHECK(onsetFramesOf({}, 48000.0).empty());
}

TEST_CASE("Onset frames of a long sound do not depend on the pieces that it comes in", "[analysis][onsets]")
{
    for (const double fs : {2000.0, 9000.0, 48000.0, 192000.0})
    {
        const auto x = bandedSound(30000, fs);
        const auto expected = onsetFramesOf(x, fs);
        for (const std::size_t piece : {1u, 54u, 4095u, 4097u})
        {
            if (piece == 1 && fs != 9000.0)
                continue;
            OnsetFeatures features(fs, 1);
            std::vector<OnsetFrame> found;
            for (std::size_t i = 0; i < x.size(); i += piece)
            {
                features.push(std::span(x).subspan(i, std::min(piece, x.size() - i)));
                found.insert(found.end(), features.frames().begin(), features.frames().end());
                features.drop(features.frames().size());
            }
            features.finish();
            found.insert(found.end(), features.frames().begin(), features.frames().end());
            CAPTURE(fs, piece);
            CHECK(found == expected);
        }
        // What is dropped in part leaves the rest.
        OnsetFeatures features(fs, 1);
        features.push(x);
        const std::vector<OnsetFrame> all(features.frames().begin(), features.frames().end());
        features.drop(3);
        CHECK(features.frames().size() == all.size() - 3);
        CHECK(features.frames().front() == all[3]);
    }
}

TEST_CASE("The powers of steady tones are half their squared amplitudes, and their bands those of their octave",
          "[analysis][onsets]")
{
    const double fs = 44100.0;
    for (const auto& [f, band] : {std::pair<double, std::size_t>{40.0, 0},
                                  {159.0, 1},
                                  {318.0, 2},
                                  {636.0, 3},
                                  {1273.0, 4},
                                  {2400.0, 5},
                                  {6500.0, 6}})
    {
        std::vector<float> x(22050);
        for (std::size_t n = 0; n < x.size(); ++n)
            x[n] = static_cast<float>(0.5 * std::sin(2.0 * std::numbers::pi * f * static_cast<double>(n) / fs));
        const auto frames = onsetFramesOf(x, fs);
        double power = 0.0;
        double low = 0.0;
        std::array<double, 8> bands{};
        for (std::size_t i = 90; i < 360; ++i)
        {
            power += static_cast<double>(frames[i].power) / 270.0;
            low += static_cast<double>(frames[i].lowPower) / 270.0;
            for (std::size_t b = 0; b < 8; ++b)
                bands[b] += static_cast<double>(frames[i].bands[b]) / 270.0;
        }
        CAPTURE(f);
        CHECK(power == Approx(0.125).epsilon(0.09));
        if (f < 700.0)
            CHECK(low == Approx(0.125).epsilon(0.09));
        CHECK(static_cast<std::size_t>(std::max_element(bands.begin(), bands.begin() + 7) - bands.begin()) == band);
        double sum = 0.0;
        for (std::size_t b = 0; b < 7; ++b)
            sum += bands[b];
        CHECK(bands[7] == Approx(sum).epsilon(1e-5));
    }
}

TEST_CASE("Powers are averaged over channels, and offsets do not count", "[analysis][onsets]")
{
    const double fs = 16000.0;
    const auto mono = bandedSound(4000, fs);
    std::vector<float> stereo;
    for (const float v : mono)
    {
        stereo.push_back(v);
        stereo.push_back(0.0f);
    }
    const auto one = onsetFramesOf(mono, fs);
    const auto two = onsetFramesOf(stereo, fs, 2);
    REQUIRE(one.size() == two.size());
    for (std::size_t i = 0; i < one.size(); ++i)
    {
        CHECK(two[i].power == 0.5f * one[i].power);
        CHECK(two[i].lowPower == 0.5f * one[i].lowPower);
        CHECK(two[i].bands[3] == 0.5f * one[i].bands[3]);
    }
    for (const auto& frame : onsetFramesOf(std::vector<float>(3000, 0.7f), fs))
        CHECK(frame == OnsetFrame{});
}
