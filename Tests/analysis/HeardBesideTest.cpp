#include "analysis/SteadyBands.h"
#include "support/Catch.h"

#include <pacini/analysis/EncodeSound.h>
#include <pacini/analysis/Encoder.h>
#include <pacini/analysis/HeardBeside.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{

/// A short sound every half second, above the range of touch.
std::vector<HeardFrame> ticks()
{
    std::vector<HeardFrame> heard(steadyFrames);
    for (std::size_t i = 0; i < steadyFrames; ++i)
        if (i % 100 < 6)
            heard[i] = {1.0f, 1.0f, 0.0f, 0.02f, 0.02f};
    return heard;
}

const SoundScale scale{1.0, 1.0, 0.5};

/// A made beat: a kick of 55 Hz on each of four, hi-hats of noise above 5 kHz between them.
std::vector<float> beat(double hats)
{
    std::vector<float> x(4 * 48000);
    Random random(3);
    double last = 0.0;
    for (std::size_t n = 0; n < x.size(); ++n)
    {
        const double t = static_cast<double>(n) / 48000.0;
        const double sinceKick = std::fmod(t, 0.5);
        const double sinceHat = std::fmod(t + 0.25, 0.25);
        const double white = random.uniform(-1.0, 1.0);
        const double kick = std::exp(-sinceKick / 0.08) * std::sin(2.0 * std::numbers::pi * 55.0 * sinceKick);
        x[n] = static_cast<float>(0.7 * kick + hats * std::exp(-sinceHat / 0.02) * (white - last));
        last = white;
    }
    return x;
}

Clip encoded(const std::vector<float>& sound, double audible, HeardRole role = HeardRole::beside)
{
    EncoderParams params;
    params.audible = audible;
    params.heard = role;
    Encoder encoder(params);
    return encodeSound(encoder, SoundFormat{48000, 1}, SoundParts(sound, 1)).value();
}
} // namespace

TEST_CASE("Ticks become a tone of 280 Hz where nothing else is felt", "[analysis]")
{
    BandAnalysisResult found = steadyBands(0.0f);
    HeardBeside(steadyEdges, 1.0).next(found, ticks(), steadyFrames, scale);
    CHECK(found.envelope[500] > 0.9f);
    CHECK(found.envelope[520] == 0.0f);
    CHECK(std::hypot(found.tracks[1].amplitude[125], found.tracks[2].amplitude[125]) > 0.4f);
    CHECK(found.tracks[1].frequency[125] == Approx(280.0));
    CHECK(found.tracks[0].amplitude[125] == 0.0f);
    BandAnalysisResult half = steadyBands(0.0f);
    HeardBeside(steadyEdges, 0.5).next(half, ticks(), steadyFrames, scale);
    CHECK(half.envelope[505] > 0.5f);
    CHECK(half.envelope[505] < 0.7f * found.envelope[505]);
    // What is soft beside the rest of the sound is at most 10 dB stronger than it is.
    BandAnalysisResult soft = steadyBands(0.0f);
    HeardBeside(steadyEdges, 1.0).next(soft, ticks(), steadyFrames, {1.0, 1.0, 0.0005});
    CHECK(soft.envelope[505] / half.envelope[505] == Approx(2.0 * 3.0 * std::sqrt(0.001)));
}

TEST_CASE("A low part that is as loud is left as it is", "[analysis]")
{
    BandAnalysisResult found = steadyBands(1.0f);
    const BandAnalysisResult before = found;
    HeardBeside(steadyEdges, 1.0).next(found, ticks(), steadyFrames, scale);
    CHECK(found.envelope == before.envelope);
    for (std::size_t k = 0; k < steadyEdges.size(); ++k)
        CHECK(found.tracks[k].amplitude == before.tracks[k].amplitude);
    // One of a fifth is topped, not replaced.
    BandAnalysisResult weak = steadyBands(0.2f);
    HeardBeside(steadyEdges, 1.0).next(weak, ticks(), steadyFrames, scale);
    CHECK(weak.envelope[500] > 0.7f);
    CHECK(weak.envelope[540] == 0.2f);
    CHECK(weak.tracks[0].amplitude[125] == 0.2f);
}

TEST_CASE("What goes on leaves room for what happens", "[analysis]")
{
    std::vector<HeardFrame> heard(steadyFrames, {1.0f, 1.0f, 0.0f, 0.02f, 0.02f});
    BandAnalysisResult found = steadyBands(0.0f);
    HeardBeside(steadyEdges, 1.0).next(found, heard, steadyFrames, scale);
    CHECK(found.envelope[0] == 1.0f);
    CHECK(found.envelope[500] == Approx(std::pow((0.55 / 0.775 - 0.03) / 0.97, 5.0 / 3.0)));
}

TEST_CASE("Beside the low part, too, a sound in parts is as in one", "[analysis]")
{
    auto heard = ticks();
    for (std::size_t i = 0; i < steadyFrames; i += 7)
        heard[i] = {0.7f, 0.5f, 0.3f, 0.05f, 0.03f};
    BandAnalysisResult whole = steadyBands(0.3f);
    HeardBeside(steadyEdges, 1.0).next(whole, heard, steadyFrames, scale);

    constexpr std::size_t cut = 1000;
    BandAnalysisResult rest = steadyBands(0.3f);
    HeardBeside parts(steadyEdges, 1.0);
    parts.next(rest, heard, cut + 1, scale);
    BandAnalysisResult first = rest.takeFirst(5.0);
    parts.next(rest, std::span(heard).subspan(cut), steadyFrames - cut, scale);
    const auto joined = [](std::vector<float> a, const std::vector<float>& b)
    {
        CHECK(a.back() == b.front());
        a.insert(a.end(), b.begin() + 1, b.end());
        return a;
    };
    CHECK(joined(first.envelope, rest.envelope) == whole.envelope);
    for (std::size_t k = 0; k < steadyEdges.size(); ++k)
    {
        CHECK(joined(first.tracks[k].amplitude, rest.tracks[k].amplitude) == whole.tracks[k].amplitude);
        CHECK(joined(first.tracks[k].frequency, rest.tracks[k].frequency) == whole.tracks[k].frequency);
    }
}

TEST_CASE("A kick drum is felt under hi-hats", "[analysis]")
{
    const std::vector<float> sound = beat(0.35);
    const auto depth = [](const Clip& clip)
    {
        double kick = 0.0, pause = 0.0;
        for (double t = 0.5; t < 3.4; t += 0.5)
        {
            double loudest = 0.0;
            for (double u = 0.0; u < 0.06; u += 0.005)
                loudest = std::max(loudest, valueAt(clip.envelope, t + u));
            kick += loudest;
            pause += valueAt(clip.envelope, t + 0.42);
        }
        return kick / pause;
    };
    const double without = depth(encoded(sound, 0.0));
    CHECK(depth(encoded(sound, 1.0)) > 0.7 * without);
    CHECK(depth(encoded(sound, 1.0, HeardRole::instead)) < 0.7 * without); // the test can tell
    // And the hats are there.
    const Clip clip = encoded(sound, 1.0);
    CHECK(valueAt(clip.envelope, 1.26) > 2.0 * valueAt(encoded(sound, 0.0).envelope, 1.26));
}
