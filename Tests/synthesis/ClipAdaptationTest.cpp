#include "io/ShippedProfiles.h"
#include "support/Catch.h"
#include "support/ClipSamples.h"
#include "support/Measure.h"
#include "support/Paths.h"
#include "support/Render.h"
#include "support/ShippedProfile.h"

#include <pacini/actuator/FeltModel.h>
#include <pacini/actuator/Strength.h>
#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/ScenePlayer.h>
#include <pacini/synthesis/VoiceLimit.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace pacini;
using test::drive;
using test::shippedProfile;

namespace
{
Band band(double hertz, double level, int priority = 0)
{
    return {hertz / 1.2, hertz, hertz * 1.2, priority, {{0.0, level}, {1.0, level}}, {{0.0, hertz}, {1.0, hertz}}};
}

/// Frames in which the magnitude rises from 10 to 90 % of its largest value in the first half.
std::size_t riseFrames(const std::vector<float>& y)
{
    const auto half = y.begin() + static_cast<std::ptrdiff_t>(y.size() / 2);
    float peak = 0.0f;
    for (auto v = y.begin(); v != half; ++v)
        peak = std::max(peak, std::abs(*v));
    const auto reaches = [&](float part)
    {
        return std::find_if(y.begin(), half, [&](float v) { return std::abs(v) >= part * peak; }) - y.begin();
    };
    return static_cast<std::size_t>(reaches(0.9f) - reaches(0.1f));
}
} // namespace

TEST_CASE("An adapted clip lies within the actuator's range and voices, and is a valid clip", "[adaptation]")
{
    for (const auto& entry : shippedProfiles(sourceFolder()))
    {
        const Profile profile = shippedProfile(entry.name);
        if (profile.technology == Technology::pcm)
            continue;
        for (std::uint64_t seed = 1; seed < 30; ++seed)
        {
            AdaptationParams params;
            params.strength = seed % 3 == 0 ? standardStrength : static_cast<double>(seed % 5) / 4.0;
            CAPTURE(entry.name, seed, params.strength);
            const ActuatorRange range = fitActuator(profile, {params.maxBoost, params.strength}).range;
            const Clip adapted = adaptClip(test::randomClip(seed), profile, params).clip;
            REQUIRE(validate(adapted).ok());
            CHECK(adapted.bands.size() <= static_cast<std::size_t>(std::max(profile.polyphony, 1)));
            if (profile.technology == Technology::erm)
                continue; // frequency follows strength
            for (const Band& b : adapted.bands)
            {
                CHECK(b.centreFrequency >= range.lowFrequency * (1.0 - 1e-9));
                CHECK(b.centreFrequency <= range.highFrequency * (1.0 + 1e-9));
                for (const Breakpoint& point : b.pitch)
                {
                    REQUIRE(point.value >= range.lowFrequency * (1.0 - 1e-9));
                    REQUIRE(point.value <= range.highFrequency * (1.0 + 1e-9));
                }
            }
        }
    }
}

TEST_CASE("What fits an actuator stays as it is", "[adaptation]")
{
    Profile wide;
    wide.technology = Technology::vca;
    wide.range = {1.0, 20000.0, 100.0};
    for (std::uint64_t seed = 1; seed < 20; ++seed)
    {
        const Clip clip = test::randomClip(seed);
        const AdaptedClip adapted = adaptClip(clip, wide);
        CHECK(adapted.changes.empty());
        CHECK(adapted.clip == clip);
    }
}

TEST_CASE("Voices that merge keep their power, and the pitch is that of whichever sounds", "[adaptation]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {band(60.0, 0.3, 2), band(70.0, 0.4, 1), band(300.0, 0.2, 0)};
    mergeVoices(clip, 2);
    REQUIRE(clip.bands.size() == 2);
    CHECK(valueAt(clip.bands[0].amplitude, 0.5) == Approx(0.5));
    CHECK(valueAt(clip.bands[0].pitch, 0.5) == Approx(60.0 * std::pow(70.0 / 60.0, 0.64)));
    CHECK(valueAt(clip.bands[1].amplitude, 0.5) == Approx(0.2));
    CHECK(valueAt(clip.bands[1].pitch, 0.5) == Approx(300.0));

    // The least of all goes to its nearest neighbour, and a silent one takes nothing with it.
    clip.bands = {band(60.0, 0.3), band(250.0, 0.0, 5), band(300.0, 0.2)};
    mergeVoices(clip, 2);
    REQUIRE(clip.bands.size() == 2);
    CHECK(valueAt(clip.bands[0].pitch, 0.5) == Approx(60.0));
    CHECK(valueAt(clip.bands[1].pitch, 0.5) == Approx(300.0));
}

TEST_CASE("Flattening starts and stops a slow actuator sooner", "[adaptation]")
{
    // A burst at the resonance of an LRA, felt through its body.
    const Profile profile = shippedProfile("lra-175");
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {{160.0, 175.0, 190.0, 0, {{0.1, 0.0}, {0.1, 0.1}, {0.6, 0.1}, {0.6, 0.0}}, {}}};
    const auto felt = [&](const CompileParams& params)
    {
        return test::felt(drive(clip, profile, params), profile);
    };
    CompileParams asItIs;
    asItIs.adapt = false;
    CHECK(static_cast<double>(riseFrames(felt({}))) < 0.4 * static_cast<double>(riseFrames(felt(asItIs))));
}

TEST_CASE("Voices go to the plays of most priority, then strength, and are lost and won in time", "[adaptation]")
{
    const std::vector<VoiceClaim> claims = {{0.0, 4.0, 1, 1, 0.5}, {1.0, 2.0, 1, 0, 0.1}, {3.0, 5.0, 1, 1, 0.9}};
    const auto one = voiceLosses(claims, 1);
    CHECK(one[0] == std::vector<VoiceLoss>{{1.0, 2.0}, {3.0, 4.0}});
    CHECK(one[1].empty());
    CHECK(one[2].empty());
    for (const auto& losses : voiceLosses(claims, 2))
        CHECK(losses.empty());

    const Curve gated = withoutVoice({{0.0, 1.0}, {10.0, 0.0}}, one[0]);
    CHECK(valueAt(gated, 0.5) == Approx(0.95));
    CHECK(valueAt(gated, 1.0) == Approx(0.9));
    CHECK(valueAt(gated, 1.5) == 0.0);
    CHECK(valueAt(gated, 2.5) == Approx(0.75));
    CHECK(valueAt(gated, 3.5) == 0.0);
    CHECK(valueAt(gated, 5.0) == Approx(0.5));
}

TEST_CASE("An actuator of one voice plays one of two clips at a time", "[adaptation]")
{
    const Profile profile = shippedProfile("lra-175");
    Scene scene;
    Clip low, high;
    low.duration = high.duration = 1.0;
    low.bands = {band(160.0, 0.1)};
    high.bands = {band(190.0, 0.1)};
    scene.clips = {low, high};
    scene.plays.resize(2);
    scene.plays[1].clip = 1;
    scene.plays[1].start = 0.5;
    scene.plays[1].priority = 1; // waits for the first
    const auto plan = compilePlan(scene, &profile);
    REQUIRE(plan.ok());
    ScenePlayer player(*plan);
    std::vector<float> y(static_cast<std::size_t>(player.totalFrames()));
    const std::span<float> all(y);
    player.process(std::span(&all, 1));
    const auto crossings = [&](double from, double to)
    {
        int count = 0;
        for (auto n = static_cast<std::size_t>(from * 48000.0); n < static_cast<std::size_t>(to * 48000.0); ++n)
            count += y[n] <= 0.0f && y[n + 1] > 0.0f ? 1 : 0;
        return count / (to - from);
    };
    CHECK(crossings(0.55, 0.95) == Approx(160.0).margin(3.0));
    CHECK(crossings(1.05, 1.45) == Approx(190.0).margin(3.0));
}

TEST_CASE("A motor gets a voltage, not a vibration", "[adaptation]")
{
    const Profile profile = shippedProfile("erm-coin");
    Clip clip;
    clip.duration = 2.0;
    clip.bands = {{150.0, 200.0, 250.0, 0, {{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.8}, {1.5, 0.8}, {1.5, 0.0}}, {}}};
    const auto y = drive(clip, profile);
    const auto mean = [&](double from, double to)
    {
        double sum = 0.0;
        for (auto n = static_cast<std::size_t>(from * 48000.0); n < static_cast<std::size_t>(to * 48000.0); ++n)
            sum += static_cast<double>(y[n]);
        return sum / (48000.0 * (to - from));
    };
    CHECK(mean(0.0, 0.45) == Approx(0.0).margin(1e-3));
    CHECK(mean(1.0, 1.4) == Approx(std::sqrt(0.8) / profile.drive.overdrive).epsilon(0.02));
    CHECK(mean(1.5, 1.52) < -0.3); // braking
    CHECK(mean(1.8, 2.0) == Approx(0.0).margin(1e-3));
    for (float v : y)
        REQUIRE(std::abs(v) <= 1.0f);
}

TEST_CASE("No scene drives an actuator beyond full scale", "[adaptation]")
{
    for (const auto& entry : shippedProfiles(sourceFolder()))
    {
        const Profile profile = shippedProfile(entry.name);
        for (std::uint64_t seed = 1; seed < 5; ++seed)
        {
            Clip clip = test::randomClip(seed);
            for (Band& b : clip.bands)
                for (Breakpoint& point : b.amplitude)
                    point.value *= 20.0;
            for (float v : drive(clip, profile))
                REQUIRE(std::abs(v) <= 1.0f);
        }
    }
}

TEST_CASE("The look-ahead of the protection is taken out of the output", "[adaptation]")
{
    Profile profile = shippedProfile("l5-wristband");
    profile.equalizer.clear();
    CompileParams params;
    params.adapt = false;
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {band(150.0, 0.1)};
    clip.bands[0].amplitude = {{0.1, 0.0}, {0.2, 0.1}, {0.3, 0.0}};
    ScenePlayerParams without;
    without.protect = false;
    const auto a = drive(clip, profile, params), b = drive(clip, profile, params, without);
    REQUIRE(a.size() == b.size());
    double error = 0.0;
    for (std::size_t n = 0; n < a.size(); ++n)
        error = std::max(error, std::abs(static_cast<double>(a[n] - b[n])));
    CHECK(error < 0.005); // the high-pass of the protection turns 150 Hz by a degree or two
}
