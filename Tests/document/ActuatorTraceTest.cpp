#include "document/ActuatorTrace.h"

#include "support/Catch.h"
#include "support/ShippedProfile.h"

#include <pacini/actuator/ActuatorFit.h>
#include <pacini/actuator/Strength.h>
#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
/// A plain actuator that bears everything.
Profile plainActuator()
{
    Profile profile;
    profile.name = "plain";
    profile.technology = Technology::vca;
    profile.range = {40.0, 400.0, 60.0};
    profile.equalizer = {};
    return profile;
}

Band bandAt(double frequency, Curve amplitude)
{
    return {frequency / 1.1, frequency, frequency * 1.1, 0, std::move(amplitude), {}};
}

std::shared_ptr<const ActuatorTrace> trace(const Clip& clip, const Profile& profile, double strength = standardStrength)
{
    const std::atomic<bool> cancelled{false};
    auto made = traceActuator(clip, profile, strength, cancelled);
    REQUIRE(made.ok());
    REQUIRE(*made != nullptr);
    return *made;
}
} // namespace

TEST_CASE("A trace shows the peak of the drive, and a band that goes under the threshold of touch as not felt there")
{
    Profile profile = plainActuator();
    profile.technology = Technology::pcm; // nothing is fitted or filtered
    profile.range.dynamicRange = 40.0;
    Clip clip;
    clip.duration = 4.0;
    clip.bands = {bandAt(100.0, {{0.0, 0.5}, {2.0, 0.5}, {2.0, 0.005}, {4.0, 0.005}})};
    const auto made = trace(clip, profile);
    CHECK(made->peaks.size() == 800);
    CHECK(static_cast<double>(made->peaks[200]) == Approx(0.5).epsilon(0.02));
    CHECK(static_cast<double>(made->peaks[600]) == Approx(0.005).epsilon(0.02));
    // -46 dB of a threshold of -40 dB
    const auto parts = ActuatorTrace::parts(made->sources.at(0).losses);
    REQUIRE(parts.size() == 1);
    CHECK(parts[0].loss == Loss::belowTouch);
    CHECK(parts[0].time.from == Approx(2.0).margin(0.006));
    CHECK(parts[0].time.to == Approx(4.0).margin(0.006));
    CHECK(made->textOf(made->sources[0], 600) == "not felt: 6 dB below the touch threshold");
    CHECK(made->textOf(made->sources[0], 200).empty());
    CHECK(made->textOf(600) == "not felt: 6 dB below the touch threshold");
    CHECK(made->losses[200] == Loss::none);
    CHECK(!made->stepAt(-0.1));
    CHECK(!made->stepAt(4.1));
    CHECK(made->stepAt(2.0026) == 400);
}

TEST_CASE("A pitch that leaves the range is out of range just then, and told with what is played instead")
{
    Profile profile = plainActuator();
    profile.resonance = {100.0, 1.0};
    profile.equalizer.pushBack({}); // an equaliser of its own: the range is not extended
    Clip clip;
    clip.duration = 2.0;
    clip.bands = {bandAt(200.0, {{0.0, 0.3}, {2.0, 0.3}}), bandAt(390.0, {{0.0, 0.3}, {2.0, 0.3}})};
    clip.bands[1].lowFrequency = 300.0;
    clip.bands[1].highFrequency = 700.0;
    clip.bands[1].pitch = {{0.0, 350.0}, {1.0, 350.0}, {1.0, 600.0}, {2.0, 600.0}};
    const auto made = trace(clip, profile);
    const auto& losses = made->sources.at(1).losses;
    const auto parts = ActuatorTrace::parts(losses);
    REQUIRE(parts.size() == 1);
    CHECK(parts[0] == LostPart{{1.0, 2.0}, Loss::outOfRange});
    CHECK(made->textOf(made->sources[1], 300).find("out of range: 600 Hz is played at 400 Hz") == 0);
    CHECK(ActuatorTrace::parts(made->sources[0].losses).empty());
    CHECK(!made->changes.empty());
}

TEST_CASE("With more strength a trace is nearer to the resonance and shows more drive there, as a rendering does")
{
    const Profile profile = test::shippedProfile("lra-175");
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {bandAt(profile.resonance.frequency, {{0.0, 0.3}, {1.0, 0.3}})};
    clip.bands[0].pitch = {{0.0, 175.0}, {0.5, 175.0}, {0.5, 130.0}, {1.0, 130.0}};
    double away = 1000.0;
    for (const double strength : {0.0, standardStrength, 1.0})
    {
        CAPTURE(strength);
        const auto made = trace(clip, profile, strength);
        const ActuatorRange range = fitActuator(profile, {.strength = strength}).range;
        const bool within = range.lowFrequency <= 130.0;
        CHECK(made->sources[0].losses[150] == (within ? Loss::none : Loss::outOfRange));
        CHECK(static_cast<double>(made->sources[0].played[150]) == Approx(within ? 130.0 : range.lowFrequency));
        CHECK(std::abs(175.0 - static_cast<double>(made->sources[0].played[150])) <= away);
        away = std::abs(175.0 - static_cast<double>(made->sources[0].played[150]));

        Scene scene;
        scene.clips = {clip};
        scene.plays.emplace_back();
        CompileParams params;
        params.sampleRate = 16000.0;
        params.adaptation.strength = strength;
        ScenePlayer player(compilePlan(scene, &profile, params).value(), {.sampleRate = 16000.0});
        std::vector<float> rendered(16000);
        std::span<float> out(rendered);
        player.process(std::span(&out, 1));
        for (std::size_t step = 0; step < 200; ++step)
        {
            float peak = 0.0f;
            for (std::size_t i = 80 * step; i < 80 * (step + 1); ++i)
                peak = std::max(peak, std::abs(rendered[i]));
            REQUIRE(made->peaks[step] == peak);
        }
    }
    CHECK(away < 30.0);
    CHECK(trace(clip, profile, 1.0)->peaks[50] > 2.0f * trace(clip, profile, 0.0)->peaks[50]);
}

TEST_CASE("Bands that share a voice, and those that are too weak to matter, are told")
{
    Profile profile = plainActuator();
    profile.polyphony = 2;
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {bandAt(60.0, {{0.0, 0.5}, {1.0, 0.5}}), bandAt(150.0, {{0.0, 0.1}, {1.0, 0.1}}),
                  bandAt(300.0, {{0.0, 0.4}, {1.0, 0.4}})};
    auto made = trace(clip, profile);
    CHECK(made->sources[0].whole == Loss::none);
    CHECK(made->sources[1].whole == Loss::noVoice);
    CHECK(made->sources[2].whole == Loss::none);
    CHECK(made->textOf(made->sources[1], 100).find("neighbouring band") != std::string::npos);

    profile.polyphony = Profile::unlimitedPolyphony;
    clip.bands[1].amplitude = {{0.0, 0.00015}, {1.0, 0.00015}}; // 70 dB below the rest
    made = trace(clip, profile);
    CHECK(made->sources[1].whole == Loss::dropped);
    CHECK(made->textOf(made->sources[1], 100).find("left out with an error of -7") == 0);
    CHECK(made->textOf(made->sources[1], 100).find("dB: is too weak to be perceived") != std::string::npos);

    profile.technology = Technology::erm;
    made = trace(clip, profile);
    CHECK(made->sources[0].whole == Loss::none);
    CHECK(made->sources[2].whole == Loss::noVoice);
}

TEST_CASE("Where protection takes from the drive, the trace says how much and why")
{
    Profile profile = plainActuator();
    profile.technology = Technology::pcm;
    Clip clip;
    clip.duration = 2.0;
    clip.bands = {bandAt(100.0, {{0.0, 0.2}, {1.0, 0.2}, {1.0, 2.0}, {2.0, 2.0}})}; // 6 dB above full drive
    const auto made = trace(clip, profile);
    const auto parts = ActuatorTrace::parts(made->losses);
    REQUIRE(parts.size() == 1);
    CHECK(parts[0].loss == Loss::limited);
    CHECK(parts[0].time.from == Approx(1.0).margin(0.01));
    CHECK(static_cast<double>(made->reductions[350]) == Approx(6.02).margin(0.4));
    CHECK(made->textOf(350).find("protection reduces by 6.") == 0);
    CHECK(made->textOf(350).find("dB: full drive") != std::string::npos);
    CHECK(made->reductions[100] == 0.0f);
    for (const float peak : made->peaks)
        CHECK(peak <= 1.0f);
}

TEST_CASE("A trace that is not wanted any more ends early, and a wrong profile is an error")
{
    Clip clip;
    clip.duration = 60.0;
    clip.bands = {bandAt(100.0, {{0.0, 0.2}})};
    const std::atomic<bool> cancelled{true};
    const auto made = traceActuator(clip, plainActuator(), standardStrength, cancelled);
    REQUIRE(!made.ok());
    CHECK(made.error().code == ErrorCode::cancelled);
    Profile wrong = plainActuator();
    wrong.range.lowFrequency = -1.0;
    const std::atomic<bool> going{false};
    CHECK(!traceActuator(clip, wrong, standardStrength, going).ok());
}
