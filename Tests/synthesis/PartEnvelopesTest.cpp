#include "support/Catch.h"

#include <pacini/synthesis/PartEnvelopes.h>

#include <cmath>

using namespace pacini;

namespace
{
Band bandAt(double frequency, Curve amplitude)
{
    Band band;
    band.lowFrequency = 0.9 * frequency;
    band.centreFrequency = frequency;
    band.highFrequency = 1.1 * frequency;
    band.amplitude = std::move(amplitude);
    return band;
}
} // namespace

TEST_CASE("The parts of a clip share its envelope by their powers", "[synthesis]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.envelope = {{0.0, 0.5}, {1.0, 0.5}};
    clip.bands = {bandAt(60.0, {{0.0, 0.3}, {1.0, 0.3}}),
                  bandAt(400.0, {{0.0, 0.4}, {0.5, 0.4}, {0.6, 0.0}, {1.0, 0.0}})};
    const auto parts = partEnvelopes(clip);
    CHECK(valueAt(parts[0], 0.25) == Approx(0.5 * 0.6));
    CHECK(valueAt(parts[1], 0.25) == Approx(0.5 * 0.8));
    CHECK(valueAt(parts[0], 0.8) == Approx(0.5));
    CHECK(valueAt(parts[1], 0.8) == 0.0);
    // Noise counts by its mean square: an RMS of .3 is a sinusoid of .3 sqrt 2.
    clip.bands.pop_back();
    clip.noise = {{300.0, 500.0, {{0.0, 0.3 / std::sqrt(2.0)}, {1.0, 0.3 / std::sqrt(2.0)}}}};
    CHECK(valueAt(partEnvelopes(clip)[1], 0.5) == Approx(0.5 / std::sqrt(2.0)));
}

TEST_CASE("The only part that sounds has the clip's own envelope, where nothing does there is none", "[synthesis]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.envelope = {{0.0, 0.5}, {0.3, 0.1}, {1.0, 0.5}};
    clip.bands = {bandAt(199.0, {{0.0, 0.3}}), bandAt(200.0, {{0.0, 0.0}, {1.0, 0.0}})};
    auto parts = partEnvelopes(clip);
    CHECK(parts[0] == clip.envelope);
    CHECK(parts[1].empty());
    clip.bands = {bandAt(200.0, {{0.0, 0.3}})};
    parts = partEnvelopes(clip);
    CHECK(parts[0].empty());
    CHECK(parts[1] == clip.envelope);
    clip.bands.clear();
    parts = partEnvelopes(clip);
    CHECK(parts[0].empty());
    CHECK(parts[1].empty());
    // Silence of both for a while is silence.
    clip.bands = {bandAt(60.0, {{0.0, 0.3}, {0.2, 0.0}, {1.0, 0.0}}),
                  bandAt(400.0, {{0.0, 0.3}, {0.2, 0.0}, {1.0, 0.0}})};
    parts = partEnvelopes(clip);
    CHECK(valueAt(parts[0], 0.5) == 0.0);
    CHECK(valueAt(parts[0], 0.0) == Approx(0.5 / std::sqrt(2.0)));
}
