#include "support/ActuatorOf.h"
#include "support/Catch.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/synthesis/CompilePlan.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
Clip plannedClip(double hertz = 100.0, double seconds = 1.0, double level = 0.5)
{
    Clip clip;
    clip.duration = seconds;
    clip.bands = {{hertz / 1.2, hertz, hertz * 1.2, 0, {{0.0, level}, {seconds, level}}, {}}};
    return clip;
}

Scene plannedScene(std::size_t plays = 1)
{
    Scene scene;
    scene.clips = {plannedClip(), plannedClip(300.0, 0.5, 0.3)};
    scene.plays.resize(plays);
    return scene;
}

Profile plannedProfile()
{
    return test::actuatorOf(Technology::lra, {150.0, 4.0}, {60.0, 400.0, 50.0});
}

PlayTimeline levelTimeline(std::vector<Curve> gains, std::vector<DecoderChange> changes = {})
{
    PlayTimeline timeline;
    timeline.gains = std::move(gains);
    timeline.changes = std::move(changes);
    return timeline;
}

std::string adaptationsOf(const RenderPlan& plan)
{
    std::string text;
    for (const Adaptation& one : plan.adaptations)
        text += one.where + ": " + one.what + "\n";
    return text;
}

/// All that a plan has in numbers.
void pinPlan(const std::string& name, const RenderPlan& plan)
{
    const auto decibels = [](double error)
    {
        return std::isfinite(error) ? error : 0.0;
    };
    std::vector<double> errors = {plan.duration, decibels(plan.culledError)};
    for (const LeftOut& item : plan.leftOut)
        errors.push_back(decibels(item.error));
    checkPinned("synthesis/errors of a plan of " + name, errors, 1e-6);
    std::vector<double> all;
    for (const PlannedPlay& play : plan.plays)
    {
        for (const double v : {static_cast<double>(play.play), play.start, play.decoder.transposition,
                               play.decoder.stretch, play.decoder.reach / 100.0, play.decoder.pulses.frequency / 100.0,
                               play.decoder.pulses.lowest / 100.0, static_cast<double>(play.clip.bands.size())})
            all.push_back(v);
        for (const Band& band : play.clip.bands)
        {
            all.push_back(band.centreFrequency / 100.0);
            for (const Breakpoint& point : band.amplitude)
                all.push_back(point.time + 10.0 * point.value);
        }
        for (const Curve& gain : play.timeline.gains)
            for (const Breakpoint& point : gain)
                all.push_back(point.time + 10.0 * point.value);
    }
    checkPinned("synthesis/plan of " + name, all, 1e-6);
}
} // namespace

TEST_CASE("A plan is made for 48 kHz and -60 dB, and leaves out and adapts, unless told otherwise", "[scene]")
{
    const CompileParams params;
    CHECK(params.tolerance == -60.0);
    CHECK(params.leaveOut);
    CHECK(params.sampleRate == 48000.0);
    CHECK(params.adapt);
    const AdaptationParams adaptation;
    CHECK(adaptation.frequencies);
    CHECK(adaptation.voices);
    CHECK(adaptation.dynamicRange);
    CHECK(adaptation.maxBoost == Decibels(6.0));
    CHECK(adaptation.strength == 0.4);
    CHECK_FALSE(adaptation.mapping.has_value());
    CHECK(detail::maxUnrolledPoints == 20'000'000);
}

TEST_CASE("A plan refuses rates that nothing plays at, broken scenes and profiles, and more than a day", "[scene]")
{
    const auto failing = [](const Scene& scene, const Profile* profile, double rate)
    {
        CompileParams params;
        params.sampleRate = rate;
        const auto plan = compilePlan(scene, profile, params);
        return plan ? std::string() : plan.error().where + ": " + plan.error().message;
    };
    CHECK(failing(plannedScene(), nullptr, 2000.0).empty());
    CHECK(failing(plannedScene(), nullptr, 768000.0).empty());
    CHECK(failing(plannedScene(), nullptr, 1999.0) == "sampleRate: must be 2000 to 768000 Hz");
    CHECK(failing(plannedScene(), nullptr, 768001.0) == "sampleRate: must be 2000 to 768000 Hz");
    Scene broken = plannedScene();
    broken.plays[0].clip = 2;
    CHECK(failing(broken, nullptr, 48000.0) == "plays[0].clip: is not one of the scene's 2 clips");
    Profile profile = plannedProfile();
    CHECK(failing(plannedScene(), &profile, 48000.0).empty());
    profile.resonance.q = 0.0;
    CHECK(failing(plannedScene(), &profile, 48000.0) == "resonance.q: must be 0.01 to 1000");
    Scene day = plannedScene();
    day.plays[0].start = 86399.0;
    CHECK(failing(day, nullptr, 48000.0).empty());
    day.plays[0].start = 86399.5;
    CHECK(failing(day, nullptr, 48000.0) == "duration: would be longer than 24 hours");
    Scene endless = plannedScene();
    endless.duration = 86400.0;
    endless.plays[0].loop = 0.005;
    CHECK(failing(endless, nullptr, 48000.0) == "plays[0].loop: unrolls to more than 20 million breakpoints in the "
                                                "scene; make the loop longer, or use fewer passes");
}

TEST_CASE("A scene without a duration lasts until its last play ends, changes of speed included", "[scene]")
{
    const auto lastsFor = [](auto&& change)
    {
        Scene scene = plannedScene(2);
        scene.plays[1].clip = 1;
        change(scene);
        const auto plan = compilePlan(scene);
        REQUIRE(plan.ok());
        return plan->duration;
    };
    CHECK(lastsFor([](Scene&) {}) == Approx(1.0));
    CHECK(lastsFor([](Scene& s) { s.plays[1].start = 2.0; }) == Approx(2.5));
    CHECK(lastsFor([](Scene& s) { s.plays[1].stretch = 3.0; }) == Approx(1.5));
    CHECK(lastsFor(
              [](Scene& s)
              {
                  s.plays[0].loop = 0.4;
                  s.plays[0].passes = 6;
              }) == Approx(2.4));
    CHECK(lastsFor([](Scene& s) { s.changes = {{0.5, 0, SceneParameter::stretch, 2.0, 0.0}}; }) == Approx(1.5));
    CHECK(lastsFor([](Scene& s) { s.duration = 0.7; }) == 0.7);
    CHECK(lastsFor([](Scene& s) { s.duration = 7.0; }) == 7.0);
    CHECK(lastsFor([](Scene& s) { s.plays.clear(); }) == 0.0);
    CHECK(detail::playLength(ScenePlay{}, {}, 0.5) == 0.5);
    ScenePlay slow;
    slow.stretch = 4.0;
    CHECK(detail::playLength(slow, levelTimeline({}, {{1.0, 0.0, 1.0}}), 0.5) == Approx(1.25));
}

TEST_CASE("A play is unheard when it starts at the end or later, or all its gains are 0", "[scene]")
{
    ScenePlay play;
    play.start = 1.0;
    CHECK(detail::whyUnheard({}, play, levelTimeline({{{0.0, 1.0}}}), 1.5).empty());
    CHECK(detail::whyUnheard({}, play, levelTimeline({{{0.0, 1.0}}}), 1.0) == "starts after the end of the scene");
    CHECK(detail::whyUnheard({}, play, levelTimeline({{{0.0, 0.0}}, {{0.0, 0.0}, {1.0, 0.0}}}), 1.5) == "is muted");
    CHECK(detail::whyUnheard({}, play, levelTimeline({{{0.0, 0.0}}, {{0.0, 0.0}, {1.0, 1e-9}}}), 1.5).empty());
    CHECK(detail::whyUnheard({}, play, levelTimeline({{{0.0, 1.0}}, {{0.0, 0.0}}}), 1.5).empty());
}

TEST_CASE("A loop is passed through as often as it is told or as fits, at the fastest speed of the play", "[scene]")
{
    ScenePlay play;
    play.start = 1.0;
    play.loop = 0.5;
    CHECK(detail::passesOf(play, {}, 3.0) == 4.0);
    CHECK(detail::passesOf(play, {}, 3.1) == 5.0);
    play.passes = 3;
    CHECK(detail::passesOf(play, {}, 3.1) == 3.0);
    play.passes = 9;
    CHECK(detail::passesOf(play, {}, 3.1) == 5.0);
    play.passes = 1;
    CHECK(detail::passesOf(play, {}, 3.1) == 1.0);
    play.passes = 0;
    play.stretch = 2.0;
    CHECK(detail::passesOf(play, {}, 3.1) == 3.0);
    CHECK(detail::passesOf(play, levelTimeline({}, {{0.1, 0.0, 0.5}, {0.2, 0.0, 8.0}}), 3.1) == 9.0);
}

TEST_CASE("A loop is unrolled as long as all points of the scene stay within 20 million", "[scene]")
{
    ScenePlay play;
    play.loop = 0.25;
    play.passes = 4;
    Clip clip = plannedClip();
    clip.transients = {{0.1, 0.5, 0.5}, {0.5, 0.5, 0.5}};
    std::size_t points = 100;
    const auto once = detail::bakedClip(clip, play, {}, 10.0, "plays[7]", points);
    REQUIRE(once.ok());
    CHECK(once->duration == Approx(1.0));
    CHECK(once->transients.size() == 4);
    CHECK(points == 100 + 4 * 2 + 4); // the ends of each pass and its event
    points = 20'000'000 - 4 * (2 + 2 + 2);
    REQUIRE(detail::bakedClip(clip, play, {}, 10.0, "plays[7]", points).ok());
    points = 20'000'000 - 4 * (2 + 2 + 2) + 1;
    const auto tooMany = detail::bakedClip(clip, play, {}, 10.0, "plays[7]", points);
    REQUIRE_FALSE(tooMany.ok());
    CHECK(tooMany.error().code == ErrorCode::tooLarge);
    CHECK(tooMany.error().where == "plays[7].loop");
    CHECK(tooMany.error().message.find("20 million") != std::string::npos);
    // Once at least; without a loop it is the clip, varied, however many points there are.
    points = 0;
    play.passes = 0;
    CHECK(detail::bakedClip(clip, play, {}, 0.0, "", points)->duration == Approx(0.25));
    play.loop = 0.0;
    play.variation = {0.5, VariationScope::band, 3};
    points = 30'000'000;
    const auto varied = detail::bakedClip(clip, play, {}, 10.0, "", points);
    REQUIRE(varied.ok());
    CHECK(*varied == vary(clip, play.variation));
    CHECK(points == 30'000'004);
}

TEST_CASE("Pulses keep to the actuator's range and are those of the profile unless the user chose", "[scene]")
{
    Profile profile = plannedProfile();
    for (const TransientShape shape : {TransientShape::adaptive, TransientShape::square, TransientShape::sine})
        for (const bool chosen : {false, true})
        {
            profile.transient = {shape, 123.0, 2.5};
            DecoderParams params;
            params.pulses = {TransientShape::adaptive, 55.0, 7.0};
            DecoderChoice choice;
            if (chosen)
                choice.pulseShape = TransientShape::sine;
            detail::fitPulses(params, profile, {100.0, 200.0, 60.0}, choice);
            CHECK(params.pulses.lowest == 100.0);
            CHECK(params.pulses.highest == 200.0);
            detail::fitPulses(params, profile, {30.0, 800.0, 60.0},
                              choice); // flattening does not make it reach further
            CHECK(params.pulses.lowest == 60.0);
            CHECK(params.pulses.highest == 400.0);
            const bool own = !chosen && shape != TransientShape::adaptive;
            CHECK(params.pulses.shape == (!own                              ? TransientShape::adaptive
                                          : shape == TransientShape::square ? TransientShape::square
                                                                            : TransientShape::sine));
            CHECK(params.pulses.frequency == (own ? 123.0 : 55.0));
            CHECK(params.pulses.cycles == (own ? 2.5 : 7.0));
        }
}

TEST_CASE("A play is decoded with its pitch, speed and seed, at a rate for all its bands", "[scene]")
{
    Scene scene = plannedScene();
    scene.plays[0].transposition = 3.0;
    scene.plays[0].stretch = 1.5;
    scene.plays[0].variation = {0.0, VariationScope::band, 17};
    scene.clips[0].bands.push_back({500.0, 600.0, 700.0, 0, {{0.0, 0.0}}, {{0.0, 650.0}}});
    CompileParams params;
    params.sampleRate = 8000.0;
    const auto plan = compilePlan(scene, nullptr, params);
    REQUIRE(plan.ok());
    REQUIRE(plan->plays.size() == 1);
    const DecoderParams& decoder = plan->plays[0].decoder;
    CHECK(test::asNumbers(decoder.sampleRate, decoder.transposition, decoder.stretch, decoder.variation.seed,
                          decoder.variation.amount) == test::Numbers{8000.0, 3.0, 1.5, 17, 0.0});
    CHECK(decoder.carriers == CarrierMode::pitch);
    CHECK(decoder.reach == 650.0);
    CHECK(plan->plays[0].clip.bands.size() == 1); // the silent one is left out
    // Thesis clips get square pulses at the resonance, of a plain signal 67 Hz.
    scene.clips[0].encoder = {{"method", std::string("thesis")}};
    CHECK(compilePlan(scene)->plays[0].decoder.pulses.frequency == 67.0);
    CHECK(compilePlan(scene)->plays[0].decoder.pulses.shape == TransientShape::square);
    const Profile profile = plannedProfile();
    CHECK(compilePlan(scene, &profile)->plays[0].decoder.pulses.frequency == 150.0);
    CompileParams flattest;
    flattest.adaptation.strength = 0.0;
    CHECK(compilePlan(scene, &profile, flattest)->plays[0].decoder.pulses.lowest == 60.0);
    const ActuatorRange played = fitActuator(profile, {}).range;
    CHECK(played.lowFrequency > 60.0);
    CHECK(compilePlan(scene, &profile)->plays[0].decoder.pulses.lowest == played.lowFrequency);
    CompileParams asItIs;
    asItIs.adapt = false;
    CHECK(compilePlan(scene, &profile, asItIs)->plays[0].decoder.pulses.lowest == 1.0);
    CHECK(compilePlan(scene, &profile, asItIs)->adaptations.empty());
}

TEST_CASE("The predicted error counts what an actuator cannot play beside what nobody feels", "[scene]")
{
    Profile profile = plannedProfile();
    profile.polyphony = 1;
    CompileParams params;
    params.adaptation.maxBoost = Decibels(0.0);
    params.adaptation.strength = 0.0;
    params.adaptation.dynamicRange = false;
    // Two equal plays on one voice: half of the energy has none, by the second half of one of them a quarter.
    Scene scene = plannedScene(2);
    scene.plays[1].priority = 1;
    for (const double start : {0.0, 0.5})
    {
        scene.plays[1].start = start * scene.clips[0].duration;
        const auto plan = compilePlan(scene, &profile, params);
        REQUIRE(plan.ok());
        CHECK(plan->predictedError == Approx(10.0 * std::log10(start > 0.0 ? 0.25 : 0.5)).margin(0.1));
        CHECK(plan->culledError < -1000.0);
    }
    scene.plays[1].start = scene.clips[0].duration;
    CHECK(compilePlan(scene, &profile, params)->predictedError < -1000.0);

    // Noise outside the range, of as much power as the tone; bands within it stay.
    Scene noisy = plannedScene(1);
    Clip& clip = noisy.clips[0];
    clip = plannedClip(150.0, 1.0, 0.2 * std::numbers::sqrt2);
    clip.noise = {{profile.range.highFrequency + 10.0, profile.range.highFrequency + 50.0, {{0.0, 0.2}}}};
    const auto plan = compilePlan(noisy, &profile, params);
    REQUIRE(plan.ok());
    REQUIRE(plan->leftOut.size() == 1);
    CHECK(plan->leftOut[0].where == "plays[0].noise[0]");
    CHECK(plan->leftOut[0].reason == "is noise outside the actuator's range");
    CHECK(plan->leftOut[0].unplayable);
    CHECK(plan->leftOut[0].error == Approx(10.0 * std::log10(0.5)).margin(0.1));
    CHECK(plan->predictedError == plan->leftOut[0].error);
    params.adapt = false;
    CHECK(compilePlan(noisy, &profile, params)->predictedError < -1000.0);
}

TEST_CASE("A plan says what was adapted: clips, resonance and voices", "[scene]")
{
    Profile profile = plannedProfile();
    Scene scene = plannedScene(2);
    scene.clips[0].bands.push_back({900.0, 1000.0, 1200.0, 0, {{0.0, 0.3}}, {}});
    scene.plays[1].clip = 1;
    scene.plays[1].start = 0.25;
    scene.plays[1].priority = 1;
    profile.polyphony = 2;
    {
        const auto plan = compilePlan(scene, &profile);
        REQUIRE(plan.ok());
        CHECK(adaptationsOf(*plan) ==
              "clips[0]: 2 of 2 bands are moved towards the resonance\n"
              "clips[1]: 1 of 1 bands are moved towards the resonance\n"
              "profile: its resonance at 150 Hz is flattened down to 115 Hz\n"
              "plays[1]: has no voice for 500 ms: plays with higher priority or level use them\n");
    }
    CompileParams params;
    params.adaptation.strength = 0.0;
    {
        const auto plan = compilePlan(scene, &profile, params);
        REQUIRE(plan.ok());
        REQUIRE(plan->flattening.has_value());
        CHECK(adaptationsOf(*plan) ==
              "clips[0]: 1 of 2 bands are moved into the range\n"
              "profile: its resonance at 150 Hz is flattened down to 106 Hz\n"
              "plays[1]: has no voice for 500 ms: plays with higher priority or level use them\n");
        CHECK_FALSE(plan->motor);
        pinPlan("two plays on two voices", *plan);
    }
    params.adaptation.maxBoost = Decibels(0.0);
    params.adaptation.frequencies = false;
    params.adaptation.voices = false;
    {
        const auto plan = compilePlan(scene, &profile, params);
        CHECK_FALSE(plan->flattening.has_value());
        CHECK(adaptationsOf(*plan).empty());
    }
    // Voices count where there are fewer than bands can be: 1 to 63.
    params.adaptation.voices = true;
    for (const auto& [voices, limited] :
         {std::pair{1, true}, {2, true}, {3, false}, {63, false}, {64, false}, {0, false}})
    {
        CAPTURE(voices);
        profile.polyphony = voices;
        const auto plan = compilePlan(scene, &profile, params);
        CHECK((adaptationsOf(*plan).find("has no voice") != std::string::npos) == limited);
    }
    profile.polyphony = 63;
    Scene crowd = plannedScene(64);
    CHECK(adaptationsOf(*compilePlan(crowd, &profile, params)).find("plays[63]: has no voice for 1000 ms") !=
          std::string::npos);
    profile.polyphony = 64;
    crowd.plays.resize(65);
    CHECK(adaptationsOf(*compilePlan(crowd, &profile, params)).empty());
    // A plain signal is not adapted, a motor is not flattened.
    profile.technology = Technology::pcm;
    CHECK(adaptationsOf(*compilePlan(scene, &profile)).empty());
    profile.technology = Technology::erm;
    const auto motor = compilePlan(scene, &profile);
    CHECK(motor->motor);
    CHECK_FALSE(motor->flattening.has_value());
    CHECK(motor->plays[0].decoder.carriers == CarrierMode::none);
    params.adaptation.voices = false;
    CHECK_FALSE(compilePlan(scene, &profile, params)->motor);
    CHECK(compilePlan(scene, &profile, params)->plays[0].decoder.carriers == CarrierMode::pitch);
}

TEST_CASE("Of plays as important the stronger for its length keeps the voice", "[scene]")
{
    Profile profile = plannedProfile();
    profile.polyphony = 1;
    CompileParams params;
    params.leaveOut = false;
    params.adaptation = {false, true, false, Decibels(0.0), 0.0, {}};
    const auto silenced = [&](const Scene& scene)
    {
        const auto plan = compilePlan(scene, &profile, params);
        REQUIRE(plan.ok());
        return adaptationsOf(*plan);
    };
    const std::string none = ": plays with higher priority or level use them\n";
    Scene scene = plannedScene(2);
    scene.plays[1].clip = 1; // half as long and 0.36 of the power
    CHECK(silenced(scene) == "plays[1]: has no voice for 500 ms" + none);
    scene.plays[1].gain = 5.0; // more power now, though less energy
    CHECK(silenced(scene) == "plays[0]: has no voice for 500 ms" + none);
    scene.plays[1].priority = 1;
    CHECK(silenced(scene) == "plays[1]: has no voice for 500 ms" + none);
    // The end of the scene ends all claims.
    scene.duration = 0.3;
    CHECK(silenced(scene) == "plays[1]: has no voice for 300 ms" + none);
    scene.duration = 3.0;
    scene.plays[1].start = 0.9;
    CHECK(silenced(scene) == "plays[1]: has no voice for 100 ms" + none);
    scene.plays[1].start = 1.0;
    CHECK(silenced(scene).empty());
    // Two losses of one play are one number.
    Scene three = plannedScene(3);
    three.plays[0].stretch = 3.0;
    three.plays[0].priority = 5;
    three.plays[1].clip = three.plays[2].clip = 1;
    three.plays[1].start = 0.5;
    three.plays[2].start = 2.0;
    CHECK(silenced(three) == "plays[0]: has no voice for 1000 ms" + none);
    pinPlan("a play that loses its voice twice", *compilePlan(three, &profile, params));
}

TEST_CASE("Plans are in order of start, and those behind limiters are what they were", "[scene]")
{
    Scene scene = plannedScene(5);
    scene.clips.push_back(plannedClip(180.0, 2.0, 0.9));
    scene.clips[2].bands.push_back({200.0, 220.0, 240.0, 1, {{0.0, 0.0}, {1.0, 0.004}, {2.0, 0.0}}, {}});
    scene.clips[2].transients = {{0.3, 0.9, 0.5}, {1.2, 0.4, 1.0}};
    scene.clips[2].noise = {{50.0, 150.0, {{0.0, 0.05}}}};
    scene.plays[0] = {"", 2, 0.8, 0.0, 0, 0.0, 0.5, 0.0, 1.0, 0, {}};
    scene.plays[1] = {"", 0, 0.1, 0.3, 5, -45.0, 0.5, 2.0, 1.0, 0, {}};
    scene.plays[2] = {"", 1, 0.5, 0.0, 0, -30.0, 0.2, 0.0, 2.0, 0, {}};
    scene.plays[3] = {"", 1, 0.5, 0.0, 0, -30.0, 0.2, 0.0, 2.0, 0, {}};
    scene.plays[4] = {"", 2, 0.0, 0.0, 0, -6.0, 0.9, 0.0, 0.7, 0, {}};
    scene.changes = {{1.0, 0, SceneParameter::gain, 6.0, 0.3}, {1.5, 2, SceneParameter::stretch, 0.5, 0.0}};
    Profile profile = plannedProfile();
    profile.drive.excursion = 1e-4;
    profile.drive.maxExcursion = 3e-4;
    profile.drive.overdrive = 1.5;
    EqualizerSection flat;
    flat.gain = 0.001;
    for (const double gain : {-20.0, 0.0, 12.0})
        for (const double tolerance : {-30.0, -60.0})
            for (const int which : {0, 1, 2})
            {
                CAPTURE(gain, tolerance, which);
                scene.gain = gain;
                scene.actuators = which == 1 ? 2 : 1;
                profile.equalizer.clear();
                if (which == 2)
                    profile.equalizer.pushBack(flat);
                CompileParams params;
                params.tolerance = tolerance;
                params.adaptation.strength = 0.0;
                const auto plan = compilePlan(scene, which == 0 ? nullptr : &profile, params);
                REQUIRE(plan.ok());
                for (std::size_t i = 1; i < plan->plays.size(); ++i)
                    CHECK(plan->plays[i - 1].start <= plan->plays[i].start);
                CHECK(plan->culledError <= tolerance);
                pinPlan("five plays, " + std::to_string(std::lround(gain)) + " dB to " +
                            std::to_string(std::lround(tolerance)) + " dB, " + std::to_string(which),
                        *plan);
            }
}
