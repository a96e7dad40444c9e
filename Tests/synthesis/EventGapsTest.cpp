#include "support/Catch.h"
#include "support/ShippedProfile.h"

#include <pacini/actuator/FeltModel.h>
#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/EventGaps.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
const Curve steady{{0.0, 0.2}, {2.0, 0.2}};

/// A steady tone of 200 Hz that an event stands in.
Clip toneWithEvent(double time, double amplitude)
{
    Clip clip;
    clip.duration = 2.0;
    Band band;
    band.lowFrequency = 150.0;
    band.centreFrequency = 200.0;
    band.highFrequency = 250.0;
    band.amplitude = {{0.0, 0.2}, {2.0, 0.2}};
    clip.bands = {band};
    clip.envelope = {{0.0, 0.2}, {2.0, 0.2}};
    clip.transients = {{time, amplitude, 0.5}};
    return clip;
}

/// Root mean square of the 5 ms from `from` s on.
double levelAt(std::span<const float> x, double fs, double from)
{
    double sum = 0.0;
    const auto first = static_cast<std::size_t>(from * fs);
    const auto count = static_cast<std::size_t>(0.005 * fs);
    for (const float v : x.subspan(first, count))
        sum += static_cast<double>(v) * static_cast<double>(v);
    return std::sqrt(sum / static_cast<double>(count));
}

/// dB by which the level rises over 10 ms around `time`, at most.
double largestRise(std::span<const float> x, double fs, double time)
{
    double rise = -100.0;
    for (double t = time - 0.02; t < time + 0.01; t += 0.0005)
        rise = std::max(rise, 20.0 * std::log10(levelAt(x, fs, t + 0.01) / levelAt(x, fs, t)));
    return rise;
}

/// dB by which the level rises over 10 ms at an event of a clip, at most.
double riseAt(const Clip& clip, double time, const EventGapParams& gaps)
{
    DecoderParams params;
    params.sampleRate = 8000.0;
    params.gaps = gaps;
    Decoder decoder(clip, params);
    std::vector<float> drive(static_cast<std::size_t>(decoder.totalFrames()));
    decoder.process(drive);
    return largestRise(drive, 8000.0, time);
}

/// What is felt of a clip on an actuator, at 48 kHz; without `ringing` as if that did not ring.
std::vector<float> feltOf(const Clip& clip, const Profile& profile, bool ringing)
{
    Scene scene;
    scene.clips = {clip};
    scene.plays = {{}};
    auto plan = compilePlan(scene, &profile);
    REQUIRE(plan.ok());
    for (PlannedPlay& play : plan->plays)
        play.decoder.gaps.ring = ringing ? play.decoder.gaps.ring : 0.0;
    ScenePlayer player(*plan);
    std::vector<float> felt(static_cast<std::size_t>(player.totalFrames()));
    const std::span<float> all(felt);
    player.process(std::span(&all, 1));
    FeltModel model;
    model.prepare({48000.0, felt.size()});
    model.setParams(feltModelParams(profile).value());
    model.reset();
    model.process(felt, felt);
    return felt;
}
} // namespace

TEST_CASE("Before an event that does not stand out the level falls, and is back a millisecond after", "[synthesis]")
{
    const Curve gapped = withEventGaps(steady, std::vector<Transient>{{1.0, 0.8, 0.5}});
    // The strongest is the event at 0.8: of that, 30 dB below counts as unfelt.
    const double unfelt = 0.8 * std::pow(10.0, -1.5);
    const double low = valueAt(gapped, 0.998);
    CHECK((0.8 + unfelt) / (2.0 * low + unfelt) == Approx(std::pow(10.0, 22.0 / 20.0)));
    CHECK(valueAt(gapped, 0.9966) == Approx(low));
    CHECK(valueAt(gapped, 0.9944) == 0.2);
    CHECK(valueAt(gapped, 0.9955) == Approx(0.5 * (0.2 + low)));
    CHECK(valueAt(gapped, 1.001) == 0.2);
    CHECK(valueAt(gapped, 1.0005) == Approx(0.5 * (0.2 + low)));
    CHECK(valueAt(gapped, 0.5) == 0.2);
    CHECK(valueAt(gapped, 2.0) == 0.2);
}

TEST_CASE("A soft event gets all the silence there can be, one beyond the range of touch nothing more", "[synthesis]")
{
    const Curve loudBefore{{0.0, 0.5}, {0.5, 0.5}, {0.51, 0.02}, {2.0, 0.02}};
    const Curve gapped = withEventGaps(loudBefore, std::vector<Transient>{{1.0, 0.1, 0.5}});
    CHECK(valueAt(gapped, 0.998) == 0.0);
    CHECK(valueAt(gapped, 0.4) == 0.5);
}

TEST_CASE("What rises by itself, and what has no events, stays as it is", "[synthesis]")
{
    const Curve fromSilence{{0.0, 0.0}, {0.995, 0.0}, {1.0, 0.4}, {2.0, 0.4}};
    CHECK(withEventGaps(fromSilence, std::vector<Transient>{{0.998, 0.8, 0.5}}) == fromSilence);
    CHECK(withEventGaps(steady, {}) == steady);
    CHECK(withEventGaps({}, std::vector<Transient>{{1.0, 0.8, 0.5}}).empty());
    CHECK(withEventGaps(steady, std::vector<Transient>{{0.0, 0.8, 0.5}}) == steady);
    const Curve silent{{0.0, 0.0}, {2.0, 0.0}};
    CHECK(withEventGaps(silent, std::vector<Transient>{{1.0, 0.0, 0.5}}) == silent);
    EventGapParams none;
    none.enough = 0.0;
    CHECK(withEventGaps(steady, std::vector<Transient>{{1.0, 0.8, 0.5}}, none) == steady);
}

TEST_CASE("Between pulses that carry a train it is silent for almost half of the time", "[synthesis]")
{
    // The events rise by 14 dB from what the envelope reaches.
    const Curve soft{{0.0, 0.08}, {2.0, 0.08}};
    std::vector<Transient> train;
    for (int k = 0; k < 20; ++k)
        train.push_back({0.5 + 0.02 * k, 1.0, 0.5});
    const Curve gapped = withEventGaps(soft, train);
    for (int k = 1; k < 20; ++k)
    {
        CAPTURE(k);
        const double time = 0.5 + 0.02 * k;
        CHECK(valueAt(gapped, time - 0.0089) == Approx(0.0).margin(1e-12));
        CHECK(valueAt(gapped, time - 0.0001) == Approx(0.0).margin(1e-12));
        CHECK(valueAt(gapped, time - 0.0131) == 0.08);
        CHECK(valueAt(gapped, time + 0.001) == Approx(0.08));
    }
    // Not where the level itself is what is felt, nor from 45 ms on, where events are single ones.
    for (Transient& event : train)
        event.amplitude = 0.8;
    CHECK(valueAt(withEventGaps(steady, train), 0.5944) == 0.2);
    CHECK(valueAt(withEventGaps(steady, train), 0.598) > 0.0);
    // Nor before what hardly rises above it.
    for (Transient& event : train)
        event.amplitude = 0.55;
    CHECK(withEventGaps(steady, train) == steady);
    CHECK(
        withEventGaps({{0.0, 0.05}, {2.0, 0.05}}, std::vector<Transient>{{1.0, 1.0, 0.5}, {1.046, 1.0, 0.5}}).size() ==
        2);
}

TEST_CASE("A strong event needs less of a rise by itself to get a gap, and gets a longer one", "[synthesis]")
{
    const double unfelt = std::pow(10.0, -1.5);
    const auto amplitudeOf = [&](double level, double rise) // of an event that rises so many dB above a steady level
    {
        return (2.0 * level + unfelt) * std::pow(10.0, rise / 20.0) - unfelt;
    };
    const auto gapsIn = [&](double level, double rise)
    {
        const Curve envelope{{0.0, 1.0}, {0.1, level}, {3.0, level}}; // the strongest is 1
        return withEventGaps(envelope, std::vector<Transient>{{2.0, amplitudeOf(level, rise), 0.5}});
    };
    REQUIRE(amplitudeOf(0.22, 3.2) > 0.6);
    CHECK(valueAt(gapsIn(0.22, 3.2), 1.9966) < 0.05);
    CHECK(valueAt(gapsIn(0.22, 2.8), 1.9966) == Approx(0.22));
    REQUIRE(amplitudeOf(0.15, 4.2) < 0.6);
    CHECK(valueAt(gapsIn(0.15, 3.8), 1.998) == Approx(0.15));
    CHECK(valueAt(gapsIn(0.15, 4.2), 1.998) < 0.05);
    CHECK(valueAt(gapsIn(0.15, 4.2), 1.9966) > 0.025); // open for 3 ms only
}

TEST_CASE("Gaps keep the order of time and never raise a level, wherever events stand", "[synthesis]")
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int round = 0; round < 50; ++round)
    {
        CAPTURE(round);
        Curve envelope;
        std::vector<Transient> events;
        double time = 0.0;
        while (time < 1.0)
        {
            envelope.push_back({time, unit(random)});
            time += 0.005 + 0.1 * unit(random) * unit(random);
        }
        for (double t = 0.0; t < 1.2; t += 0.08 * unit(random) * unit(random))
            events.push_back({t, unit(random), unit(random)});
        const Curve gapped = withEventGaps(envelope, events);
        double highest = 0.0;
        for (std::size_t i = 0; i < gapped.size(); ++i)
        {
            REQUIRE(std::isfinite(gapped[i].value));
            REQUIRE(gapped[i].value >= 0.0);
            REQUIRE(gapped[i].time >= (i > 0 ? gapped[i - 1].time : 0.0));
            highest = std::max(highest, gapped[i].value - valueAt(envelope, gapped[i].time));
        }
        CHECK(highest < 1e-12);
        CHECK(gapped.back().time >= envelope.back().time);
    }
}

TEST_CASE("An event in a steady tone is played so that the level rises by more than 12 dB", "[synthesis][events]")
{
    EventGapParams none;
    none.enough = 0.0;
    for (const double amplitude : {0.7, 0.85, 1.0})
    {
        CAPTURE(amplitude);
        const Clip clip = toneWithEvent(1.0, amplitude);
        CHECK(riseAt(clip, 1.0, none) + 5.0 < riseAt(clip, 1.0, {}));
        CHECK(riseAt(clip, 1.0, {}) > 12.0);
    }
}

TEST_CASE("A gap lasts until the ringing is low enough, but leaves most of the time between events", "[synthesis]")
{
    EventGapParams params;
    params.ring = 0.010;
    const auto gapOf = [&](const std::vector<Transient>& events)
    {
        const Curve gapped = withEventGaps(steady, events, params);
        double open = events.back().time;
        while (open > 0.5 && valueAt(gapped, open - 0.0001) == Approx(valueAt(gapped, events.back().time)))
            open -= 0.0001;
        return events.back().time - open;
    };
    // From 0.4, to which the envelope peaks, ringing falls to 18 dB below the event's 0.8.
    const double expected = 0.010 * std::log(0.4 / (0.8 * std::pow(10.0, -0.9)));
    CHECK(gapOf({{1.0, 0.8, 0.5}}) == Approx(expected).margin(2e-4));
    CHECK(gapOf({{0.97, 0.8, 0.5}, {1.0, 0.8, 0.5}}) == Approx(0.35 * 0.03).margin(2e-4));
    params.ring = 0.0001;
    CHECK(gapOf({{1.0, 0.8, 0.5}}) == Approx(params.strongHold).margin(2e-4));
}

TEST_CASE("A gap lets an event be felt in a tone on a resonance that rings", "[synthesis][events]")
{
    for (const char* name : {"lra-175", "lra-235-narrow"})
        for (const double amplitude : {0.7, 1.0})
        {
            CAPTURE(name, amplitude);
            const Profile profile = test::shippedProfile(name);
            const Clip clip = toneWithEvent(1.0, amplitude);
            const double without = largestRise(feltOf(clip, profile, false), 48000.0, 1.0);
            const double with = largestRise(feltOf(clip, profile, true), 48000.0, 1.0);
            CAPTURE(without, with);
            CHECK(with > without + 3.0);
            CHECK(with > 12.0);
        }
}
