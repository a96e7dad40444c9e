#include "support/ActuatorOf.h"
#include "support/Catch.h"
#include "support/Pinned.h"
#include "support/Render.h"

#include <pacini/synthesis/ActuatorOutput.h>
#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
Clip playerClip(double seconds, double level)
{
    Clip clip;
    clip.duration = seconds;
    clip.bands = {{90.0, 110.0, 130.0, 0, {{0.0, level}}, {}}};
    clip.transients = {{0.3 * seconds, level, 0.5}};
    return clip;
}

Profile playerProfile(Technology technology)
{
    Profile profile = test::actuatorOf(technology, {120.0, 3.0}, {40.0, 500.0, 60.0});
    profile.drive.overdrive = 2.0;
    return profile;
}

RenderPlan planOf(const Scene& scene, const Profile* profile = nullptr, double fs = 8000.0)
{
    CompileParams params;
    params.sampleRate = fs;
    params.leaveOut = false;
    params.adaptation.strength = 0.0;
    const auto plan = compilePlan(scene, profile, params);
    REQUIRE(plan.ok());
    return *plan;
}

Scene playerScene(std::size_t plays, double seconds = 0.1, double level = 0.4)
{
    Scene scene;
    scene.clips = {playerClip(seconds, level)};
    scene.plays.resize(plays);
    return scene;
}

ScenePlayerParams playingAt(double fs)
{
    ScenePlayerParams params;
    params.sampleRate = fs;
    return params;
}

/// The next frames of a player, on `channels` spans, in blocks.
std::vector<std::vector<float>> nextFrames(ScenePlayer& player, std::size_t channels, std::size_t frames,
                                           std::size_t block)
{
    std::vector<std::vector<float>> out(channels, std::vector<float>(frames, 7.0f));
    test::fillChannels(player, out, block);
    return out;
}

void pinChannels(const std::string& name, const std::vector<std::vector<float>>& channels)
{
    std::vector<double> all;
    for (const auto& channel : channels)
        all.insert(all.end(), channel.begin(), channel.end());
    checkPinned("synthesis/played " + name, all, 1e-5);
}
} // namespace

TEST_CASE("A player is for 48 kHz, with all its decoders and protection, looking ahead 1 ms, unless told otherwise",
          "[scene]")
{
    const ScenePlayerParams params;
    CHECK(params.sampleRate == 48000.0);
    CHECK(std::isinf(params.builtUntil.value));
    CHECK(params.protect);
    CHECK(params.lookAhead == Seconds(0.001));
    const DecodedPlay play;
    CHECK(play.play == 0);
    CHECK(play.start == 0.0);
    CHECK(play.duration == 0.0);
    CHECK(ScenePlayer(planOf(playerScene(1), nullptr, 48000.0)).totalFrames() == 4800);
}

TEST_CASE("A player has the frames of its plan, rounded, and none at a rate that nothing plays at", "[scene]")
{
    Scene scene = playerScene(1);
    const auto frames = [&](double duration, double fs)
    {
        scene.duration = duration;
        return ScenePlayer(planOf(scene), playingAt(fs)).totalFrames();
    };
    CHECK(frames(0.1, 8000.0) == 800);
    CHECK(frames(10.4 / 8000.0, 8000.0) == 10);
    CHECK(frames(10.6 / 8000.0, 8000.0) == 11);
    CHECK(frames(0.1, 2000.0) == 200);
    CHECK(frames(0.1, 768000.0) == 76800);
    for (const double fs : {1999.0, 768001.0, 0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
        CHECK(frames(0.1, fs) == 0);
}

TEST_CASE("Decoders are made as plays come near and freed when they have ended", "[scene]")
{
    Scene scene = playerScene(4);
    for (std::size_t i = 0; i < 4; ++i)
        scene.plays[i].start = 0.05 * static_cast<double>(3 - i); // backwards: the plan puts them in order
    ScenePlayerParams params = playingAt(8000.0);
    params.builtUntil = Seconds(0.05);
    ScenePlayer player(planOf(scene), params);
    const auto starts = [&]
    {
        std::vector<double> all;
        for (const DecodedPlay& play : player.decodedPlays())
            all.push_back(play.start);
        return all;
    };
    CHECK(starts() == std::vector<double>{0.0}); // not what starts right then
    CHECK(player.decodedPlays()[0].play == 3);
    CHECK(player.decodedPlays()[0].duration == Approx(0.1));
    CHECK(player.decodedPlays()[0].decoder.carriers == 1);
    CHECK(player.decodedPlays()[0].decoder.pulses == 1);
    player.build(Seconds(0.11));
    CHECK(starts().size() == 3);
    player.build(Seconds(0.11));
    CHECK(starts().size() == 3);
    CHECK(player.maxSounding() == 0);
    nextFrames(player, 1, 792, 99); // the look-ahead has 8 more: a block ends where a play does
    CHECK(player.maxSounding() == 2);
    player.build(Seconds(10.0));
    CHECK(starts().size() == 4);
    CHECK(starts()[3] == Approx(0.15));
    const auto rest = nextFrames(player, 1, 1200, 100);
    CHECK(player.maxSounding() == 2);
    player.build(Seconds(10.0));
    CHECK(starts().size() == 4);
    CHECK(std::any_of(rest[0].begin(), rest[0].end(), [](float v) { return v != 0.0f; }));
    // What has no decoder when its time comes is silent.
    params.builtUntil = Seconds(0.0);
    ScenePlayer none(planOf(scene), params);
    CHECK(none.decodedPlays().empty());
    CHECK(nextFrames(none, 1, 2000, 64)[0] == std::vector<float>(2000, 0.0f));
    CHECK(none.maxSounding() == 0);
}

TEST_CASE("A player mixes its plays, is silent after its end, and fills as many spans as it is given", "[scene]")
{
    Scene scene = playerScene(3);
    scene.actuators = 3;
    scene.plays[0].pan = 0.0;
    scene.plays[1].pan = 0.5;
    scene.plays[1].start = 0.02;
    scene.plays[2].pan = 1.0;
    scene.plays[2].gain = -6.0;
    scene.duration = 0.11;
    ScenePlayerParams params = playingAt(8000.0);
    params.protect = false;
    const RenderPlan plan = planOf(scene);
    ScenePlayer player(plan, params);
    CHECK(player.actuators() == 3);
    CHECK(player.protectionMeter() == nullptr);
    const auto all = nextFrames(player, 3, 1000, 130);
    CHECK(player.maxSounding() == 3);
    CHECK(player.maxReduction() == 0.0);
    Decoder alone(scene.clips[0], plan.plays[0].decoder);
    std::vector<float> tone(800);
    alone.process(tone);
    for (std::size_t n = 0; n < 1000; ++n)
    {
        CAPTURE(n);
        const double first = n < 800 ? static_cast<double>(tone[n]) : 0.0;
        const double second = n >= 160 && n < 880 ? static_cast<double>(tone[n - 160]) : 0.0;
        CHECK(static_cast<double>(all[0][n]) == Approx(first).margin(1e-7));
        CHECK(static_cast<double>(all[1][n]) == Approx(second).margin(1e-7));
        CHECK(static_cast<double>(all[2][n]) == Approx(std::pow(10.0, -0.3) * first).margin(1e-7));
    }
    for (const std::size_t channels : {std::size_t(1), std::size_t(2), std::size_t(4)})
    {
        ScenePlayer other(plan, params);
        const auto some = nextFrames(other, channels, 1000, 2000);
        for (std::size_t a = 0; a < channels; ++a)
            CHECK(some[a] == (a < 3 ? all[a] : std::vector<float>(1000, 0.0f)));
    }
    ScenePlayer nobody(plan, params);
    nobody.process({});
    CHECK(nextFrames(nobody, 3, 1000, 7) == all);
    // Protected, it looks ahead before its first frame and has a meter for each actuator.
    ScenePlayer guarded(plan, playingAt(8000.0));
    CHECK(guarded.protectionMeter(0) != nullptr);
    CHECK(guarded.protectionMeter(2) != nullptr);
    CHECK(guarded.protectionMeter(3) == nullptr);
    CHECK(nextFrames(guarded, 3, 1000, 130) == all); // nothing is too loud
}

TEST_CASE("Live gains end at 60 dB, and go to the play that is meant", "[scene]")
{
    Scene scene = playerScene(2);
    scene.actuators = 2;
    scene.plays[0].pan = 0.0;
    scene.plays[1].pan = 1.0;
    scene.plays[0].start = 0.01; // the second in the plan
    ScenePlayerParams params = playingAt(8000.0);
    params.protect = false;
    const RenderPlan plan = planOf(scene);
    const auto with = [&](std::size_t play, double gain)
    {
        ScenePlayer player(plan, params);
        player.setGain(play, gain);
        return nextFrames(player, 2, 880, 100);
    };
    const auto plain = with(2, 5.0);
    CHECK(with(0, 1.0) == plain);
    CHECK(with(0, std::numeric_limits<double>::quiet_NaN()) == plain);
    CHECK(with(0, std::numeric_limits<double>::infinity()) == plain);
    const auto louder = with(0, 3.0);
    CHECK(louder[1] == plain[1]);
    CHECK(static_cast<double>(louder[0][400]) == Approx(3.0 * static_cast<double>(plain[0][400])));
    CHECK(with(0, 1000.0) == with(0, 5000.0));
    CHECK_FALSE(with(0, 900.0) == with(0, 1000.0));
    CHECK(with(0, -1000.0) == with(0, -5000.0));
    CHECK(static_cast<double>(with(0, -2.0)[0][400]) == Approx(-2.0 * static_cast<double>(plain[0][400])));
    const auto changed = [&](std::size_t play)
    {
        ScenePlayer player(plan, params);
        player.setPitchAndSpeed(play, 7.0, 1.0);
        return nextFrames(player, 2, 880, 100);
    };
    CHECK(changed(2) == plain);
    CHECK(changed(0)[1] == plain[1]);
    CHECK_FALSE(changed(0)[0] == plain[0]);
    CHECK(changed(1)[0] == plain[0]);
    CHECK_FALSE(changed(1)[1] == plain[1]);
}

TEST_CASE("A play of a scene is moved over the actuators and delayed while it plays, whatever the scene has", "[scene]")
{
    Scene scene = playerScene(2, 0.2);
    scene.actuators = 3;
    scene.plays[0].pan = 0.0;
    scene.plays[0].gain = -6.0;
    scene.plays[1].pan = 1.0;
    scene.plays[1].start = 0.3; // after the first
    ScenePlayerParams params = playingAt(8000.0);
    params.protect = false;
    params.liveDelay = Seconds(0.1);
    const RenderPlan plan = planOf(scene);
    const auto with = [&](auto&& change)
    {
        ScenePlayer player(plan, params);
        change(player);
        return nextFrames(player, 3, 4000, 64);
    };
    const auto plain = with([](ScenePlayer&) {});
    const double bad = std::numeric_limits<double>::quiet_NaN();
    CHECK(with([&](ScenePlayer& p) { p.setPan(0, bad); }) == plain);
    CHECK(with([&](ScenePlayer& p) { p.setDelay(0, Seconds(bad)); }) == plain);
    CHECK(with([&](ScenePlayer& p) { p.setPan(2, 1.0); }) == plain);
    // The whole of the first play on the last actuator, with the scene's level; the other stays.
    const auto moved = with([](ScenePlayer& p) { p.setPan(0, 7.0); });
    for (std::size_t n = 0; n < 4000; ++n)
    {
        REQUIRE(moved[0][n] == 0.0f);
        REQUIRE(moved[1][n] == 0.0f);
        REQUIRE(static_cast<double>(moved[2][n]) ==
                Approx(static_cast<double>(n < 2000 ? plain[0][n] : plain[2][n])).margin(1e-7));
    }
    const auto late = with([](ScenePlayer& p) { p.setDelay(0, Seconds(0.01), Seconds(0.0)); });
    for (std::size_t n = 0; n < 2000; ++n)
        REQUIRE(static_cast<double>(late[0][n]) ==
                Approx(n < 80 ? 0.0 : static_cast<double>(plain[0][n - 80])).margin(1e-7));
    CHECK(late[2] == plain[2]);
    // No longer than there is room for.
    CHECK(with([](ScenePlayer& p) { p.setDelay(0, Seconds(5.0), Seconds(0.0)); }) ==
          with([](ScenePlayer& p) { p.setDelay(0, Seconds(0.1), Seconds(0.0)); }));
}

TEST_CASE("The output of an actuator has what its plan asks for", "[scene]")
{
    const ProcessSpec spec{8000.0, 256};
    std::vector<float> x(256);
    for (std::size_t n = 0; n < x.size(); ++n)
        x[n] = 0.3f * static_cast<float>(std::sin(0.3 * static_cast<double>(n)));
    RenderPlan plan;
    {
        ActuatorOutput output(plan, spec, true, Seconds(0.001));
        CHECK(output.latencyFrames() == 8);
        REQUIRE(output.meter() != nullptr);
        auto y = x;
        output.process(y);
        for (std::size_t n = 0; n < y.size(); ++n)
            REQUIRE(y[n] == (n < 8 ? 0.0f : x[n - 8]));
        CHECK(ActuatorOutput(plan, spec, true, Seconds(0.0)).latencyFrames() == 0);
    }
    plan.profile = playerProfile(Technology::lra);
    {
        // No equaliser and no protection: the rated drive is half of the full one.
        ActuatorOutput output(plan, spec, false, Seconds(0.001));
        CHECK(output.latencyFrames() == 0);
        CHECK(output.meter() == nullptr);
        auto y = x;
        output.process(y);
        for (std::size_t n = 0; n < y.size(); ++n)
            REQUIRE(static_cast<double>(y[n]) == Approx(0.5 * static_cast<double>(x[n])).margin(1e-9));
        ActuatorOutput guarded(plan, spec, true, Seconds(0.001));
        CHECK(guarded.latencyFrames() == 8);
        CHECK(guarded.meter() != nullptr);
    }
    EqualizerSection peak;
    peak.gain = 6.0;
    plan.profile->equalizer.pushBack(peak);
    {
        ActuatorOutput output(plan, spec, false, Seconds(0.001));
        OutputFilter filter;
        filter.prepare(spec);
        filter.setParams({plan.profile->equalizer, {}});
        auto y = x, wanted = x;
        output.process(y);
        filter.process(wanted, wanted);
        for (std::size_t n = 0; n < y.size(); ++n)
            REQUIRE(static_cast<double>(y[n]) == Approx(0.5 * static_cast<double>(wanted[n])).margin(1e-8));
    }
    plan.profile = playerProfile(Technology::erm);
    plan.motor = true;
    for (const bool protect : {false, true})
    {
        ActuatorOutput output(plan, spec, protect, Seconds(0.001));
        CHECK(output.latencyFrames() == 0);
        CHECK(output.meter() == nullptr);
    }
}

TEST_CASE("One play is filtered in its decoder as its output would", "[scene]")
{
    Profile profile = playerProfile(Technology::lra);
    profile.resonance = {120.0, 6.0};
    for (const double fs : {8000.0, 48000.0, 44100.0})
        for (const double start : {0.0, 0.0371})
            for (const double duration : {0.0, 0.17, 0.5}) // to the clip's end, before it and after it
                for (const double delay : {0.0, 0.011})
                {
                    CAPTURE(fs, start, duration, delay);
                    Scene scene = playerScene(1, 0.25, 0.4);
                    scene.clips[0].transients = {{0.0, 0.6, 0.5}, {0.1, 0.5, 1.0}, {0.24, 0.7, 0.0}};
                    scene.plays[0].start = start;
                    scene.duration = duration;
                    RenderPlan plan = planOf(scene, &profile, fs);
                    REQUIRE(plan.flattening);
                    plan.plays[0].decoder.delay = delay;
                    ScenePlayerParams params;
                    params.sampleRate = fs;
                    params.protect = false;
                    const auto frames = static_cast<std::size_t>(0.7 * fs);
                    std::vector<float> expected(frames, 0.0f);
                    {
                        DecoderParams decoding = plan.plays[0].decoder;
                        decoding.sampleRate = fs;
                        Decoder decoder(plan.plays[0].clip, decoding);
                        CHECK(decoder.report().pulses > 0);
                        const auto from = static_cast<std::size_t>(std::floor(start * fs + 0.5));
                        const auto until =
                            static_cast<std::size_t>(std::max(0.0, std::floor(plan.duration * fs + 0.5)));
                        decoder.process(std::span(expected).first(until).subspan(from));
                        OutputFilter filter;
                        filter.prepare({fs, frames});
                        filter.setParams({plan.profile->equalizer, plan.flattening});
                        filter.process(expected, expected);
                    }
                    for (const std::size_t block : {frames, std::size_t{77}})
                    {
                        ScenePlayer player(plan, params);
                        std::vector<float> found(frames);
                        for (std::size_t i = 0; i < frames; i += block)
                        {
                            std::span<float> part = std::span(found).subspan(i, std::min(block, frames - i));
                            player.process(std::span(&part, 1));
                        }
                        for (std::size_t n = 0; n < frames; ++n)
                        {
                            CAPTURE(block, n);
                            REQUIRE(static_cast<double>(found[n]) ==
                                    Approx(0.5 * static_cast<double>(expected[n])).margin(1e-6));
                        }
                    }
                }
}

TEST_CASE("Scenes on actuators of all kinds are played as they were", "[scene]")
{
    Scene scene = playerScene(2, 0.3, 0.9);
    scene.clips[0].noise = {{100.0, 300.0, {{0.0, 0.1}, {0.3, 0.3}}}};
    scene.plays[1].start = 0.1;
    scene.plays[1].transposition = 7.0;
    scene.gain = 3.0;
    scene.actuators = 2;
    scene.panLaw = PanLaw::both;
    scene.plays[1].pan = 0.2;
    scene.changes = {{0.15, 0, SceneParameter::pan, 0.9, 0.1}, {0.2, 1, SceneParameter::stretch, 1.3, 0.0}};
    Profile hot = playerProfile(Technology::vca);
    hot.drive.impedance = 8.0;
    hot.drive.maxVoltageRms = 4.0;
    hot.drive.maxPower = 0.2;
    hot.drive.thermalTime = 0.05;
    Profile narrow = playerProfile(Technology::lra);
    narrow.drive.excursion = 1e-4;
    narrow.drive.maxExcursion = 1.5e-4;
    Profile motor = playerProfile(Technology::erm);
    motor.polyphony = 0;
    motor.drive.impedance = 30.0;
    motor.drive.maxVoltageRms = 3.0;
    motor.drive.maxPower = 0.1;
    motor.drive.thermalTime = 0.1;
    motor.response = {0.05, 0.03};
    Profile flat = playerProfile(Technology::piezo);
    EqualizerSection shelf;
    shelf.gain = -4.0;
    flat.equalizer.pushBack(shelf);
    const std::pair<const char*, const Profile*> all[] = {
        {"plain", nullptr}, {"hot", &hot}, {"narrow", &narrow}, {"motor", &motor}, {"flat", &flat}};
    for (const auto& [name, profile] : all)
        for (const bool protect : {true, false})
        {
            CAPTURE(name, protect);
            const RenderPlan plan = planOf(scene, profile);
            ScenePlayerParams params = playingAt(8000.0);
            params.protect = protect;
            ScenePlayer player(plan, params);
            const auto frames = static_cast<std::size_t>(player.totalFrames()) + 100;
            const auto y = nextFrames(player, 2, frames, 333);
            pinChannels(std::string(name) + (protect ? "" : ", unprotected"), y);
            checkPinned(std::string("synthesis/reduction of ") + name + (protect ? "" : ", unprotected"),
                        {player.maxReduction()}, 1e-3);
            ScenePlayer cut(plan, params);
            CHECK(nextFrames(cut, 2, frames, 17) == y);
            ScenePlayer whole(plan, params);
            CHECK(nextFrames(whole, 2, frames, frames) == y);
        }
}
