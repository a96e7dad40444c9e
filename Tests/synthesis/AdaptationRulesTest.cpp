#include "support/ActuatorOf.h"
#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/synthesis/ClipAdaptation.h>
#include <pacini/synthesis/SingleVoice.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
Profile fittedProfile()
{
    return test::actuatorOf(Technology::lra, {150.0, 4.0}, {100.0, 300.0, 60.0});
}

Band fittedBand(double hertz, double level, Curve pitch = {})
{
    return {hertz / 2.0, hertz, hertz * 2.0, 0, {{0.0, level}, {1.0, level}}, std::move(pitch)};
}

Clip fittedClip()
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {fittedBand(50.0, 0.5), fittedBand(200.0, 0.4), fittedBand(900.0, 0.1, {{0.0, 800.0}, {0.5, 500.0}})};
    clip.noise = {{20.0, 80.0, {{0.0, 0.1}}}, {250.0, 500.0, {{0.0, 0.1}}}, {700.0, 900.0, {{0.0, 0.1}}}};
    clip.transients = {{0.2, 0.8, 0.5}, {0.6, 0.01, 0.2}};
    return clip;
}

/// Nothing else than what the test wants.
AdaptationParams onlyAdapting(bool frequencies, bool voices, bool dynamicRange)
{
    return {frequencies, voices, dynamicRange, Decibels(0.0), 0.0, {}};
}

void pinFitted(const std::string& name, const Clip& clip)
{
    std::vector<double> all = {clip.duration};
    const auto add = [&](const Curve& curve)
    {
        all.push_back(static_cast<double>(curve.size()));
        for (const Breakpoint& point : curve)
            for (const double v : {point.time, point.value})
                all.push_back(v);
    };
    add(clip.envelope);
    for (const Band& band : clip.bands)
    {
        for (const double v : {band.lowFrequency, band.centreFrequency, band.highFrequency})
            all.push_back(v);
        add(band.amplitude);
        add(band.pitch);
    }
    for (const NoiseBand& band : clip.noise)
        add(band.amplitude);
    for (const Transient& event : clip.transients)
        all.push_back(event.time + 10.0 * event.amplitude);
    checkPinned("synthesis/adapted " + name, all);
}

void pinVoice(const std::string& name, const SingleVoice& voice)
{
    std::vector<double> all = {voice.duration};
    for (const Curve* curve : {&voice.amplitude, &voice.frequency, &voice.displaced})
    {
        all.push_back(static_cast<double>(curve->size()));
        for (const Breakpoint& point : *curve)
            for (const double v : {point.time, point.value})
                all.push_back(v);
    }
    for (const Transient& event : voice.events)
        all.push_back(event.time + 10.0 * event.amplitude);
    checkPinned("synthesis/one voice of " + name, all);
}
} // namespace

TEST_CASE("The mean frequency of a band is that of its energy, in octaves", "[adaptation]")
{
    using detail::meanFrequency;
    CHECK(meanFrequency(fittedBand(200.0, 0.5)) == Approx(200.0));
    CHECK(meanFrequency(fittedBand(200.0, 0.0)) == 200.0);
    CHECK(meanFrequency(fittedBand(0.5, 0.0)) == 1.0);
    CHECK(meanFrequency(fittedBand(0.5, 0.3)) == 1.0);
    CHECK(meanFrequency({10.0, 20.0, 30.0, 0, {}, {{0.0, 500.0}}}) == 20.0);
    // Two points of 1 and 2 in amplitude: 100 Hz and 400 Hz count 1 and 4.
    CHECK(meanFrequency({1.0, 20.0, 900.0, 0, {{0.0, 1.0}, {1.0, 2.0}}, {{0.0, 100.0}, {1.0, 400.0}}}) ==
          Approx(100.0 * std::pow(4.0, 0.8)));
    // Each point counts for the time between its neighbours, a lone one for a millisecond.
    const Curve amplitude = {{0.0, 1.0}, {0.1, 2.0}, {0.4, 3.0}, {0.4, 1.0}};
    const Curve pitch = {{0.0, 100.0}, {0.1, 200.0}, {0.4, 400.0}};
    const double weights[] = {0.1, 4.0 * 0.4, 9.0 * 0.3, 1.0 * 0.001};
    const double octaves[] = {0.0, 1.0, 2.0, 2.0};
    double sum = 0.0, weighted = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
    {
        sum += weights[i];
        weighted += weights[i] * octaves[i];
    }
    CHECK(meanFrequency({1.0, 20.0, 900.0, 0, amplitude, pitch}) == Approx(100.0 * std::exp2(weighted / sum)));
    CHECK(meanFrequency({1.0, 20.0, 900.0, 0, {{0.5, 1.0}}, pitch}) == Approx(400.0));
}

TEST_CASE("A band moves as a whole, its edges stay around it, and says whether it moved", "[adaptation]")
{
    const FrequencyMap map(fittedProfile());
    const ActuatorRange range = fittedProfile().range;
    Band band = fittedBand(200.0, 0.5, {{0.0, 150.0}, {0.5, 250.0}});
    const Band before = band;
    CHECK_FALSE(detail::moveBand(band, map, range));
    CHECK(band.centreFrequency == Approx(before.centreFrequency));
    // Down to 100 Hz from a mean of 50 Hz: all by one octave, and the ends of the range hold.
    band = {40.0, 50.0, 60.0, 0, {{0.0, 0.5}, {1.0, 0.5}}, {{0.0, 40.0}, {0.0, 62.5}, {1.0, 40.0}}};
    const double mean = detail::meanFrequency(band);
    CHECK(detail::moveBand(band, map, range));
    CHECK(band.centreFrequency == Approx(std::clamp(5000.0 / mean, 100.0, 300.0)));
    CHECK(band.lowFrequency == 40.0);
    CHECK(band.highFrequency == band.centreFrequency);
    CHECK(band.pitch[0].value == 100.0);
    CHECK(band.pitch[1].value == Approx(6250.0 / mean));
    band = fittedBand(600.0, 0.5);
    CHECK(detail::moveBand(band, map, range));
    CHECK(band.centreFrequency == 300.0);
    CHECK(band.lowFrequency == 300.0);
    CHECK(band.highFrequency == 1200.0);
    // Less than a billionth is no move.
    band = fittedBand(300.0 * (1.0 + 0.4e-9), 0.5);
    CHECK_FALSE(detail::moveBand(band, map, range));
    band = fittedBand(300.0 * (1.0 + 3e-9), 0.5);
    CHECK(detail::moveBand(band, map, range));
    // A pitch alone may be out of the range.
    band = fittedBand(200.0, 0.5, {{0.0, 290.0}, {1.0, 310.0}});
    CHECK(detail::moveBand(band, map, range));
    CHECK(band.pitch[1].value == 300.0);
}

TEST_CASE("Levels are scaled as the envelope is, or each band as itself where there is none", "[adaptation]")
{
    DynamicRangeParams params;
    params.actuatorRange = Decibels(20.0);
    params.clipRange = Decibels(40.0);
    params.clipPeak = 1.0;
    const DynamicRangeMap map(params);
    REQUIRE_FALSE(map.isIdentity());
    for (const bool envelope : {false, true})
    {
        Clip clip;
        clip.duration = 1.0;
        clip.bands = {fittedBand(100.0, 0.3), {1.0, 2.0, 3.0, 0, {{0.0, 0.0}, {0.5, 0.1}, {1.0, 0.7}}, {}}};
        clip.noise = {{100.0, 200.0, {{0.25, 0.05}, {0.5, 0.0}}}};
        clip.transients = {{0.5, 0.2, 0.5}};
        if (envelope)
            clip.envelope = {{0.0, 0.0}, {0.5, 0.2}, {1.0, 1.0}};
        Clip mapped = clip;
        detail::mapLevels(mapped, map);
        const auto gain = [&](double time, double own)
        {
            const double level = envelope ? valueAt(clip.envelope, time) : own;
            return level == 0.0 ? 0.0 : map(level) / level;
        };
        const auto check = [&](const Curve& after, const Curve& before)
        {
            REQUIRE(after.size() == before.size());
            for (std::size_t i = 0; i < after.size(); ++i)
                CHECK(after[i].value == Approx(before[i].value * gain(before[i].time, before[i].value)).margin(1e-12));
        };
        check(mapped.bands[0].amplitude, clip.bands[0].amplitude);
        check(mapped.bands[1].amplitude, clip.bands[1].amplitude);
        check(mapped.noise[0].amplitude, clip.noise[0].amplitude);
        CHECK(mapped.transients[0].amplitude == Approx(map(0.2)));
        for (std::size_t i = 0; i < clip.envelope.size(); ++i)
            CHECK(mapped.envelope[i].value == Approx(map(clip.envelope[i].value)));
    }
}

TEST_CASE("The peak of a clip is that of its envelope or else its bands, and of its events", "[adaptation]")
{
    Clip clip;
    CHECK(detail::peakOf(clip) == 0.0);
    clip.bands = {fittedBand(100.0, 0.3), fittedBand(200.0, 0.6)};
    CHECK(detail::peakOf(clip) == 0.6);
    clip.envelope = {{0.0, 0.2}, {0.5, 0.4}, {1.0, 0.1}};
    CHECK(detail::peakOf(clip) == 0.4);
    clip.transients = {{0.0, 0.3, 0.5}};
    CHECK(detail::peakOf(clip) == 0.4);
    clip.transients = {{0.0, 0.7, 0.5}, {0.1, 0.5, 0.5}};
    CHECK(detail::peakOf(clip) == 0.7);
}

TEST_CASE("A motor's strength is the envelope or the power of the bands, topped by bursts", "[adaptation]")
{
    Clip clip;
    clip.duration = 0.0995;
    clip.bands = {fittedBand(100.0, 0.3), fittedBand(200.0, 0.4)};
    auto strength = detail::wantedStrength(clip, 0.001, 0.02);
    REQUIRE(strength.size() == 101);
    for (const double s : strength)
        CHECK(s == Approx(0.5));
    clip.envelope = {{0.0, 0.0}, {0.1, 1.0}};
    // 20 ms, or 0.6 of the gap to the next, at least one step; none is weaker than what is there.
    clip.transients = {
        {0.0104, 0.9, 0.5}, {0.0404, 0.3, 0.5}, {0.0504, 0.8, 0.5}, {0.0512, 0.7, 0.5}, {0.0905, 2.0, 0.5}};
    strength = detail::wantedStrength(clip, 0.001, 0.02);
    for (std::size_t n = 0; n < strength.size(); ++n)
    {
        CAPTURE(n);
        double wanted = 0.01 * static_cast<double>(n);
        if (n >= 10 && n < 28) // 0.6 of 30 ms are 18
            wanted = std::max(wanted, 0.9);
        if (n >= 40 && n < 45) // 5.99...
            wanted = std::max(wanted, 0.3);
        if (n == 50)
            wanted = 0.8;
        if (n >= 51 && n < 71)
            wanted = std::max(wanted, 0.7);
        if (n >= 90)
            wanted = 2.0;
        CHECK(strength[n] == Approx(wanted));
    }
    CHECK(detail::wantedStrength(Clip{}, 0.001, 0.02) == std::vector<double>{0.0});

    // Noise counts by its power without an envelope: an RMS value is 3 dB above that of a sine of this amplitude.
    Clip rushing;
    rushing.duration = 0.01;
    rushing.bands = {fittedBand(100.0, 0.3)};
    rushing.noise = {{500.0, 900.0, {{0.0, 0.1}}}, {20.0, 30.0, {{0.0, 0.2}}}};
    for (const double s : detail::wantedStrength(rushing, 0.001, 0.02))
        CHECK(s == Approx(std::sqrt(0.09 + 2.0 * (0.01 + 0.04))));
    // Whatever frequencies it has: a motor has none.
    Profile motor = fittedProfile();
    motor.technology = Technology::erm;
    const AdaptedClip turned = adaptClip(rushing, motor, onlyAdapting(true, true, false));
    CHECK(turned.lost.empty());
    REQUIRE(turned.clip.bands.size() == 1);
    CHECK(valueAt(turned.clip.bands[0].amplitude, 0.005) == Approx(std::sqrt(0.19)));
}

TEST_CASE("A curve leaves out samples on a straight line, but none that is far from the one before", "[adaptation]")
{
    using detail::curveThrough;
    CHECK(curveThrough({1.0, 1.0, 1.0, 1.0}, 0.1, 1e-4, 1.0) == Curve{{0.0, 1.0}, {0.1 * 3.0, 1.0}});
    CHECK(curveThrough({0.0, 0.0, 0.5, 0.5, 0.5, 0.5}, 0.1, 1e-4, 9.0) ==
          Curve{{0.0, 0.0}, {0.1, 0.0}, {0.2, 0.5}, {0.1 * 5.0, 0.5}});
    // 0.015 a sample: every second is 0.03 away.
    const Curve ramp = curveThrough({0.0, 0.015, 0.03, 0.045, 0.06, 0.075}, 0.25, 1e-4, 9.0);
    CHECK(ramp == Curve{{0.0, 0.0}, {0.5, 0.03}, {1.0, 0.06}, {1.25, 0.075}});
    // A bend of just less than the tolerance and of more; the end is the duration at the latest.
    CHECK(curveThrough({0.0, 0.00009, 0.00009}, 0.1, 1e-4, 0.15).size() == 2);
    CHECK(curveThrough({0.0, 0.00011, 0.00011}, 0.1, 1e-4, 0.15) == Curve{{0.0, 0.0}, {0.1, 0.00011}, {0.15, 0.00011}});
    CHECK(curveThrough({0.0, -0.00011, -0.00011}, 0.1, 1e-4, 0.15).size() == 3);
    CHECK(curveThrough({}, 0.1, 1e-4, 1.0).empty());
    CHECK(curveThrough({0.5}, 0.1, 1e-4, 1.0) == Curve{{0.0, 0.5}});
}

TEST_CASE("Each part of the adaptation says what it did, and does only that", "[adaptation]")
{
    using Changes = std::vector<std::string>;
    const Clip clip = fittedClip();
    Profile profile = fittedProfile();
    CHECK(adaptClip(clip, profile, onlyAdapting(false, false, false)).changes.empty());
    CHECK(adaptClip(clip, profile, onlyAdapting(false, false, false)).clip == clip);
    {
        const AdaptedClip moved = adaptClip(clip, profile, onlyAdapting(true, false, false));
        CHECK(moved.changes == Changes{"2 of 3 bands are moved into the range"});
        REQUIRE(moved.clip.noise.size() == 1);
        CHECK(moved.clip.noise[0].lowFrequency == 250.0);
        pinFitted("frequencies", moved.clip);
        // Noise at the ends of the range stays.
        Clip edges = clip;
        edges.noise = {{20.0, 100.0, {}}, {300.0, 500.0, {}}, {20.0, 99.9, {}}, {300.1, 500.0, {}}};
        const AdaptedClip kept = adaptClip(edges, profile, onlyAdapting(true, false, false));
        CHECK(kept.clip.noise.size() == 2);
        // What is outside is handed out.
        REQUIRE(kept.lost.size() == 2);
        CHECK(kept.lost[0].index == 2);
        CHECK(kept.lost[1].index == 3);
        CHECK(kept.lost[1].band == edges.noise[3]);
        Clip within = clip;
        within.bands = {fittedBand(200.0, 0.5)};
        CHECK(adaptClip(within, profile, onlyAdapting(true, false, false)).changes.empty());
        // Flattening extends the range, to 1 Hz and 20 kHz at most.
        AdaptationParams wider = onlyAdapting(true, false, false);
        wider.maxBoost = Decibels(6.0);
        const double octaves = flatteningOf(profile, wider.maxBoost)->octaves;
        const Clip wide = adaptClip(clip, profile, wider).clip;
        CHECK(wide.bands[0].centreFrequency == Approx(100.0 / std::exp2(octaves)));
        pinFitted("frequencies of a flattened actuator", wide);
        Profile extreme = profile;
        extreme.range = {1.2, 19000.0, 60.0};
        Clip ends = clip;
        ends.bands = {fittedBand(0.9, 0.5), fittedBand(30000.0, 0.5)};
        const Clip held = adaptClip(ends, extreme, wider).clip;
        CHECK(held.bands[0].centreFrequency == 1.0);
        CHECK(held.bands[1].centreFrequency == Approx(20000.0).epsilon(1e-12));
        // The mapping that is wanted, or the profile's.
        AdaptationParams folded = onlyAdapting(true, false, false);
        folded.mapping = FrequencyMapping::fold;
        CHECK(adaptClip(clip, profile, folded).clip.bands[0].centreFrequency == Approx(200.0));
        CHECK(adaptClip(clip, profile, folded).clip.bands[2].centreFrequency != 300.0);
        profile.frequencyMapping = FrequencyMapping::rescale;
        CHECK(adaptClip(clip, profile, onlyAdapting(true, false, false)).changes ==
              Changes{"3 of 3 bands are moved into the range"});
        profile.frequencyMapping = FrequencyMapping::clamp;
        // An actuator of amplitude alone has no frequencies.
        profile.polyphony = 0;
        CHECK(adaptClip(clip, profile, onlyAdapting(true, false, false)).changes.empty());
        profile.polyphony = 1;
        CHECK(adaptClip(clip, profile, onlyAdapting(true, false, false)).changes.size() == 1);
    }
    for (const auto& [voices, changes] : {std::pair{1, Changes{"3 bands share 1 voice"}},
                                          {0, {"3 bands share 1 voice"}},
                                          {2, {"3 bands share 2 voices"}},
                                          {3, {}}})
    {
        profile.polyphony = voices;
        CHECK(adaptClip(clip, profile, onlyAdapting(false, true, false)).changes == changes);
    }
    profile.polyphony = 64;
    for (const auto& [range, changes] : {std::pair{20.4, Changes{"levels are compressed into 20 dB"}},
                                         {20.6, {"levels are compressed into 21 dB"}},
                                         {36.8, {"levels are compressed into 37 dB"}},
                                         {37.0, {}}})
    {
        CAPTURE(range);
        profile.range.dynamicRange = range; // the peak is 0.8: 35 dB below it are 36.9 dB
        CHECK(adaptClip(clip, profile, onlyAdapting(false, false, true)).changes == changes);
    }
    profile.range.dynamicRange = 15.0;
    pinFitted("levels", adaptClip(clip, profile, onlyAdapting(false, false, true)).clip);
    Clip silent = clip;
    silent.bands.clear();
    silent.transients.clear();
    CHECK(adaptClip(silent, profile, onlyAdapting(false, false, true)).changes.size() == 1);
    profile.technology = Technology::pcm;
    CHECK(adaptClip(clip, profile).clip == clip);
    CHECK(adaptClip(clip, profile).changes.empty());
}

TEST_CASE("A motor gets one band of strength, bursts of its rise time and nothing else", "[adaptation]")
{
    using Changes = std::vector<std::string>;
    Profile motor = fittedProfile();
    motor.technology = Technology::erm;
    motor.polyphony = 0;
    Clip clip = fittedClip();
    clip.envelope = {{0.0, 0.5}, {1.0, 0.1}};
    for (const double rise : {0.0, 0.05})
    {
        motor.response.riseTime = rise;
        const AdaptedClip adapted = adaptClip(clip, motor, onlyAdapting(true, true, false));
        CHECK(adapted.changes == Changes{"3 bands share 1 voice", "2 events become bursts"});
        REQUIRE(adapted.clip.bands.size() == 1);
        CHECK(adapted.clip.envelope.empty());
        CHECK(adapted.clip.transients.empty());
        CHECK(adapted.clip.noise.empty());
        const Curve& strength = adapted.clip.bands[0].amplitude;
        const double burst = std::max(rise, 0.012);
        CHECK(valueAt(strength, 0.2 + burst - 0.002) == Approx(0.8));
        CHECK(valueAt(strength, 0.2 + burst + 0.002) < 0.5);
        CHECK(strength.back().time == 1.0);
        pinFitted("to a motor, rise " + std::to_string(std::lround(1000.0 * rise)) + " ms", adapted.clip);
    }
    clip.transients.resize(1);
    clip.bands.clear();
    const AdaptedClip one = adaptClip(clip, motor, onlyAdapting(true, true, false));
    CHECK(one.changes == Changes{"1 event becomes a burst"});
    CHECK(one.clip.bands[0].lowFrequency == 150.0);
    CHECK(one.clip.bands[0].centreFrequency == 150.0);
    CHECK(one.clip.bands[0].highFrequency == 150.0);
    clip.transients.clear();
    CHECK(adaptClip(clip, motor, onlyAdapting(true, true, false)).changes.empty());
    CHECK(adaptClip(clip, motor, onlyAdapting(true, false, false)).clip == clip);
}

TEST_CASE("A curve over the whole time has points at 0 and the end and none outside", "[synthesis]")
{
    using detail::overWholeTime;
    CHECK(overWholeTime({}, 1.0).empty());
    CHECK(overWholeTime({{0.0, 2.0}, {1.0, 3.0}}, 1.0) == Curve{{0.0, 2.0}, {1.0, 3.0}});
    CHECK(overWholeTime({{0.5, 2.0}}, 1.0) == Curve{{0.0, 2.0}, {0.5, 2.0}, {1.0, 2.0}});
    CHECK(overWholeTime({{-0.5, 2.0}, {1.5, 3.0}}, 1.0) == Curve{{0.0, 2.0}, {1.0, 3.0}});
}

TEST_CASE("A clip bends where its curves do, with a time just before each step, 1 ms apart", "[synthesis]")
{
    const auto before = [](double time)
    {
        return std::nextafter(time, 0.0);
    };
    Clip clip;
    clip.duration = 1.0;
    CHECK(detail::bendTimes(clip) == std::vector<double>{0.0, 1.0});
    clip.centroid = {{0.3, 100.0}};
    CHECK(detail::bendTimes(clip) == std::vector<double>{0.0, 0.3, 1.0});
    clip.bands = {{1.0, 2.0, 3.0, 0, {{0.1, 0.0}, {0.5, 1.0}, {0.5, 0.0}}, {{0.2, 50.0}, {1.0000005, 60.0}}}};
    CHECK(detail::bendTimes(clip) == std::vector<double>{0.0, 0.1, 0.2, before(0.5), 0.5, 1.0});
    clip.envelope = {{0.1009, 0.5}, {0.2011, 0.6}, {0.9995, 0.7}};
    clip.noise = {{1.0, 2.0, {{0.5004, 1.0}, {0.7, 1.0}, {0.7, 0.0}, {0.7, 0.5}, {0.7005, 0.1}, {0.7005, 0.2}}}};
    CHECK(detail::bendTimes(clip) == std::vector<double>{0.0, 0.1, 0.2, 0.2011, before(0.5), 0.5, before(0.7), 0.7,
                                                         before(0.7005), 0.7005, 0.9995, 1.0});
    // Steps at both ends: none before 0.
    clip.envelope = {{0.0, 0.5}, {0.0, 0.6}, {1.0, 0.7}, {1.0, 0.8}};
    clip.bands.clear();
    clip.noise.clear();
    clip.centroid.clear();
    CHECK(detail::bendTimes(clip) == std::vector<double>{0.0, before(1.0), 1.0});
    Curve curve = {{0.0, 1.0}, {before(0.5), 2.0}, {0.5, 3.0}, {before(before(0.7)), 3.5},
                   {0.7, 4.0}, {before(1.0), 5.0}, {1.0, 6.0}};
    detail::closeSteps(curve);
    CHECK(curve ==
          Curve{{0.0, 1.0}, {0.5, 2.0}, {0.5, 3.0}, {before(before(0.7)), 3.5}, {0.7, 4.0}, {1.0, 5.0}, {1.0, 6.0}});
    Curve none;
    detail::closeSteps(none);
    CHECK(none.empty());
}

TEST_CASE("A band is read as power and octave, 1 Hz at least", "[synthesis]")
{
    const Band band{10.0, 64.0, 100.0, 0, {{0.0, 0.5}, {1.0, 1.0}}, {{0.0, 128.0}, {1.0, 0.5}}};
    detail::BandReader reader(band);
    CHECK(reader.power == 0.0);
    CHECK(reader.octave == 0.0);
    reader.readAt(0.0);
    CHECK(reader.power == 0.25);
    CHECK(reader.octave == Approx(7.0));
    reader.readAt(1.0);
    CHECK(reader.power == 1.0);
    CHECK(reader.octave == 0.0);
    Band steady = band;
    steady.pitch.clear();
    detail::BandReader centre(steady);
    centre.readAt(0.5);
    CHECK(centre.power == Approx(0.5625));
    CHECK(centre.octave == Approx(6.0));
    steady.centreFrequency = 0.2;
    detail::BandReader low(steady);
    low.readAt(0.5);
    CHECK(low.octave == 0.0);
}

TEST_CASE("The followed band is the strongest with its neighbours, less what lies outside", "[synthesis]")
{
    const auto followed =
        [](const std::vector<std::pair<double, double>>& bands, double lowest = 20.0, double highest = 300.0)
    {
        std::vector<Band> all;
        for (const auto& [hertz, level] : bands)
            all.push_back({hertz, hertz, hertz, 0, {{0.0, level}}, {}});
        std::vector<detail::BandReader> readers(all.begin(), all.end());
        for (detail::BandReader& reader : readers)
            reader.readAt(0.0);
        return detail::FollowedBand(lowest, highest).of(readers);
    };
    const auto none = detail::FollowedBand::none;
    CHECK(followed({}) == none);
    CHECK(followed({{100.0, 0.0}}) == none);
    CHECK(followed({{100.0, 1e-9}}) == 0);
    CHECK(followed({{100.0, 0.5}, {200.0, 0.5}}) == 0);
    CHECK(followed({{100.0, 0.5}, {200.0, 0.501}}) == 1);
    // 20 dB per octave below and above the range.
    CHECK(followed({{100.0, 0.1}, {600.0, 0.99}}) == 0);
    CHECK(followed({{100.0, 0.1}, {600.0, 1.01}}) == 1);
    CHECK(followed({{100.0, 0.1}, {10.0, 0.99}}) == 0);
    CHECK(followed({{100.0, 0.1}, {10.0, 1.01}}) == 1);
    CHECK(followed({{100.0, 0.1}, {600.0, 0.2}}, 20.0, 600.0) == 1);
    CHECK(followed({{4.0, 0.1}, {0.9, 0.2}}, 0.5, 600.0) == 1); // 1 Hz is the lowest there is
    CHECK(followed({{4.0, 0.1}, {8.0, 0.99}}, 0.1, 0.2) == 0);  // both far above 1 Hz
    // A sixth of an octave apart they do not count together.
    CHECK(followed({{100.0, 0.5}, {200.0, 0.4}, {200.0 * std::exp2(0.99 / 6.0), 0.4}}) == 1);
    CHECK(followed({{100.0, 0.5}, {200.0, 0.4}, {200.0 * std::exp2(1.01 / 6.0), 0.4}}) == 0);
}

TEST_CASE("What one voice is unless a clip says more", "[synthesis]")
{
    CHECK(SingleVoice{}.duration == 0.0);
    Clip clip;
    clip.duration = 1.0;
    CHECK(isSingleVoice(clip));
    clip.bands.resize(1);
    CHECK(isSingleVoice(clip));
    clip.bands.resize(2);
    CHECK_FALSE(isSingleVoice(clip));
    clip.bands.resize(1);
    clip.noise.resize(1);
    CHECK_FALSE(isSingleVoice(clip));
    clip.noise.clear();
    clip.envelope = {{0.0, 0.5}};
    CHECK_FALSE(isSingleVoice(clip));
    clip.envelope.clear();
    // One band without pitch has its centre, and without that no frequency.
    clip.bands = {{50.0, 100.0, 200.0, 0, {{0.0, 0.5}}, {}}};
    CHECK(singleVoiceOf(clip).frequency == Curve{{0.0, 100.0}, {1.0, 100.0}});
    clip.bands[0].centreFrequency = 0.0;
    CHECK(singleVoiceOf(clip).frequency.empty());
    CHECK(singleVoiceOf(clip).amplitude == Curve{{0.0, 0.5}, {1.0, 0.5}});
    CHECK(singleVoiceOf(clip).duration == 1.0);
    // No band: nothing, or noise by its power, or the envelope; the centroid is its frequency, 1 Hz at least.
    clip.bands.clear();
    CHECK(singleVoiceOf(clip).amplitude == Curve{{0.0, 0.0}, {1.0, 0.0}});
    CHECK(singleVoiceOf(clip).frequency.empty());
    CHECK(singleVoiceOf(clip).displaced.empty());
    clip.noise = {{50.0, 100.0, {{0.0, 0.3}}}, {150.0, 200.0, {{0.0, 0.4}}}};
    clip.centroid = {{0.5, 80.0}, {1.0, 0.5}};
    CHECK(singleVoiceOf(clip).amplitude[0].value == Approx(std::sqrt(0.5)));
    CHECK(singleVoiceOf(clip).frequency == Curve{{0.0, 80.0}, {0.5, 80.0}, {1.0, 1.0}});
    clip.envelope = {{0.0, 0.7}};
    CHECK(singleVoiceOf(clip).amplitude == Curve{{0.0, 0.7}, {0.5, 0.7}, {1.0, 0.7}});
}

TEST_CASE("One voice of bands that come and go, with noise and without an envelope, is what it was", "[synthesis]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {{50.0,
                   100.0,
                   150.0,
                   0,
                   {{0.0, 0.0}, {0.1, 0.0}, {0.2, 0.8}, {0.4, 0.8}, {0.4, 0.1}, {0.9, 0.0}},
                   {{0.0, 90.0}, {1.0, 120.0}}},
                  {100.0, 115.0, 150.0, 0, {{0.1, 0.2}, {0.8, 0.4}}, {}},
                  {300.0,
                   350.0,
                   400.0,
                   0,
                   {{0.0, 0.0}, {0.3, 0.3}, {0.6, 0.9}, {0.8, 0.0}, {1.0, 0.0}},
                   {{0.0, 340.0}, {0.5, 360.0}, {0.5, 200.0}}}};
    clip.noise = {{100.0, 200.0, {{0.0, 0.1}, {0.5, 0.2}, {0.5, 0.0}}}};
    clip.transients = {{0.05, 0.5, 0.5}, {0.6, 0.9, 0.5}};
    for (const bool envelope : {false, true})
    {
        if (envelope)
            clip.envelope = {{0.0, 0.1}, {0.25, 0.6}, {0.7, 0.3}, {0.7, 0.0}};
        const std::string what = envelope ? " under an envelope" : "";
        pinVoice("three bands" + what, singleVoiceOf(clip));
        pinVoice("three bands within 150 to 400 Hz" + what, singleVoiceOf(clip, 150.0, 400.0));
        // A third of an octave is where displacement begins.
        Clip near = clip;
        near.bands.resize(2);
        near.bands[0].pitch = {{0.0, 100.0}};
        near.bands[1].centreFrequency = 100.0 * std::exp2(0.99 / 3.0);
        const Curve close = singleVoiceOf(near).displaced;
        REQUIRE_FALSE(close.empty());
        CHECK(std::all_of(close.begin(), close.end(), [](const Breakpoint& p) { return p.value == 0.0; }));
        near.bands[1].centreFrequency = 100.0 * std::exp2(1.01 / 3.0);
        pinVoice("two bands apart" + what, singleVoiceOf(near));
    }
}

TEST_CASE("One voice of a lone band has its centre at both ends, however low, and silent bands displace nothing",
          "[synthesis]")
{
    Clip clip;
    clip.duration = 2.0;
    clip.bands = {{0.1, 0.5, 1.0, 0, {{0.0, 0.5}}, {}}};
    CHECK(singleVoiceOf(clip).frequency == Curve{{0.0, 0.5}, {2.0, 0.5}});
    clip.bands = {fittedBand(100.0, 0.0), fittedBand(400.0, 0.0)};
    clip.noise = {{50.0, 100.0, {{0.0, 0.3}}}};
    const SingleVoice voice = singleVoiceOf(clip);
    REQUIRE_FALSE(voice.displaced.empty());
    for (const Breakpoint& point : voice.displaced)
        CHECK(point.value == 0.0);
    CHECK(voice.frequency.empty());
}
