// A clip that was designed on one actuator feels alike on another, as far as that can be.

#include "io/ProfileFile.h"
#include "support/Catch.h"
#include "support/Paths.h"

#include <pacini/synthesis/RenderScene.h>
#include <pacini/synthesis/Scene.h>
#include <pacini/synthesis/Transparency.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
Profile shipped(const std::string& name)
{
    auto profile = readProfile(sourceFolder() / "profiles" / (name + ".json"));
    REQUIRE(profile.ok());
    return std::move(profile).value();
}

Clip steadyTone(double frequency, double amplitude)
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands.push_back({0.8 * frequency, frequency, 1.2 * frequency, 0, {{0.0, amplitude}, {1.0, amplitude}}, {}});
    return clip;
}

class Keep : public RenderSink
{
public:
    Result<void> take(const RenderBlock& block) override
    {
        const auto& first = block.channels.front();
        samples.insert(samples.end(), first.begin(), first.end());
        return {};
    }
    std::vector<float> samples;
};

/// RMS of the skin's acceleration in the middle of a clip, dB.
double feltLevel(const Clip& clip, const Profile& profile)
{
    RenderParams params;
    params.compile.sampleRate = 8000.0;
    params.compile.adaptation.dynamicRange = false;
    params.felt.emplace();
    Keep sink;
    REQUIRE(renderScene(sceneOf(clip), &profile, params, sink).ok());
    double power = 0.0;
    const auto begin = sink.samples.size() / 2;
    const auto end = sink.samples.size() * 9 / 10;
    for (auto n = begin; n < end; ++n)
        power += static_cast<double>(sink.samples[n]) * static_cast<double>(sink.samples[n]);
    return Decibels::fromPower(power / static_cast<double>(end - begin)).value;
}

AdaptationParams levelsAsTheyAre()
{
    AdaptationParams params;
    params.dynamicRange = false;
    return params;
}
} // namespace

TEST_CASE("A tone is felt as strongly on another actuator as on the one it was designed for", "[synthesis]")
{
    double largestBefore = 0.0;
    for (const char* from : {"quest-controller", "l5-wristband", "dualsense-voice-coil", "phone-taptic"})
        for (const char* to : {"l5-wristband", "l5-test-jig", "wideband-exciter", "quest-controller"})
            for (const double frequency : {80.0, 120.0, 160.0, 240.0})
            {
                CAPTURE(from, to, frequency);
                const Profile designed = shipped(from);
                const Profile played = shipped(to);
                const auto within = [&](const Profile& profile)
                {
                    const auto range = fitActuator(profile, {}).range;
                    return frequency >= range.lowFrequency && frequency <= range.highFrequency;
                };
                if (!within(designed) || !within(played))
                    continue;
                const Clip clip = steadyTone(frequency, 0.02); // full drive is not reached anywhere
                const double wanted = feltLevel(clip, designed);
                largestBefore = std::max(largestBefore, std::abs(feltLevel(clip, played) - wanted));
                const auto made = transparentClip(clip, designed, played, levelsAsTheyAre());
                REQUIRE(made.ok());
                CHECK(made->lost.empty());
                CHECK(validate(made->clip).ok());
                CHECK(feltLevel(made->clip, played) == Approx(wanted).margin(0.5));
            }
    CHECK(largestBefore > 10.0); // or the test says nothing
}

TEST_CASE("A glide that crosses a resonance is followed between its points", "[synthesis]")
{
    const Profile designed = shipped("quest-controller");
    const Profile played = shipped("l5-test-jig");
    Clip clip = steadyTone(100.0, 0.02);
    clip.bands[0].pitch = {{0.0, 70.0}, {1.0, 280.0}};
    const auto made = transparentClip(clip, designed, played, levelsAsTheyAre());
    REQUIRE(made.ok());
    const FeltResponse there(designed, levelsAsTheyAre());
    const FeltResponse here(played, levelsAsTheyAre());
    for (double t = 0.0; t <= 1.0; t += 0.01)
    {
        const double f = 70.0 + 210.0 * t;
        const double wanted = there.at(f) * 0.02;
        CHECK(here.at(f) * valueAt(made->clip.bands[0].amplitude, t) == Approx(wanted).epsilon(0.12));
    }
}

TEST_CASE("What cannot feel alike is told, and nothing passes full drive", "[synthesis]")
{
    const auto lostOf = [](const Clip& clip, const char* from, const char* to)
    {
        const auto made = transparentClip(clip, shipped(from), shipped(to));
        REQUIRE(made.ok());
        CHECK(validate(made->clip).ok());
        CHECK(detail::peakOf(made->clip) <= 1.0 + 1e-12);
        std::string text;
        for (const std::string& what : made->lost)
            text += what + "\n";
        return text;
    };
    CHECK(
        lostOf(steadyTone(100.0, 1.0), "wideband-exciter", "phone-taptic").find("weaker than where it was designed") !=
        std::string::npos);
    CHECK(lostOf(steadyTone(60.0, 0.001), "l5-wristband", "lra-175").find("1 of 1 bands lie outside of") !=
          std::string::npos);
    Clip two = steadyTone(150.0, 0.001);
    two.bands.push_back(steadyTone(185.0, 0.001).bands[0]);
    CHECK(lostOf(two, "l5-wristband", "lra-175").find("2 bands share 1 voice") != std::string::npos);
    CHECK(lostOf(steadyTone(150.0, 0.001), "l5-wristband", "l5-wristband").empty());
}

TEST_CASE("A clip for the actuator that it was designed on stays as it is adapted", "[synthesis]")
{
    const Profile profile = shipped("quest-controller");
    Clip clip = steadyTone(120.0, 0.5);
    clip.envelope = {{0.0, 0.0}, {0.5, 0.5}, {1.0, 0.1}};
    clip.transients = {{0.2, 0.7, 0.5}};
    const auto made = transparentClip(clip, profile, profile, levelsAsTheyAre());
    REQUIRE(made.ok());
    for (const double t : {0.1, 0.4, 0.9})
        CHECK(valueAt(made->clip.envelope, t) == Approx(valueAt(clip.envelope, t)));
    CHECK(made->clip.transients[0].amplitude == Approx(0.7));
}

TEST_CASE("Motors and unknown bodies are errors that name their side", "[synthesis]")
{
    const Clip clip = steadyTone(100.0, 0.1);
    const auto placeOf = [&](const char* from, const char* to)
    {
        const auto made = transparentClip(clip, shipped(from), shipped(to));
        REQUIRE_FALSE(made.ok());
        return made.error().where;
    };
    CHECK(placeOf("erm-coin", "lra-175") == "from.technology");
    CHECK(placeOf("lra-175", "erm-coin") == "to.technology");
    CHECK(placeOf("flat-pcm", "lra-175") == "from.body");
    CHECK(placeOf("lra-175", "flat-pcm") == "to.body");
}
