#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/synthesis/RenderScene.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
/// Noise around 150 Hz, or a tone of 100 Hz at full speed.
Texture rubbed(bool tone = false)
{
    Texture texture;
    texture.name = tone ? "wheel" : "wood";
    texture.nodes.push_back({0.5, tone ? 1e-6 : 0.1, {-0.6, 0.8}});
    if (tone)
        texture.tones.push_back({100.0, 0.0, {0.1}});
    return texture;
}

/// A scene of a texture for `seconds`.
Scene rubbing(double seconds, const Texture& texture = rubbed())
{
    Scene scene;
    scene.textures.push_back(texture);
    Clip silent;
    silent.duration = seconds;
    scene.clips.push_back(silent);
    scene.plays.emplace_back();
    scene.plays[0].texture = 0;
    return scene;
}

std::vector<float> rendered(const Scene& scene, const Profile* profile = nullptr, std::size_t block = 1024)
{
    RenderParams params;
    params.compile.sampleRate = 8000.0;
    params.blockFrames = block;
    auto made = renderScene(scene, profile, params);
    REQUIRE(made.ok());
    return std::move(made->samples);
}

double rmsBetween(const std::vector<float>& x, double from, double to)
{
    return test::rms(
        std::span(x).subspan(static_cast<std::size_t>(from * 8000.0), static_cast<std::size_t>((to - from) * 8000.0)));
}
} // namespace

TEST_CASE("A texture of a scene sounds as long as its clip, by its speed over time", "[scene][texture]")
{
    Scene scene = rubbing(4.0);
    scene.plays[0].start = 1.0;
    scene.plays[0].speed = 0.0;
    scene.changes = {{2.0, 0, SceneParameter::speed, 0.5, 0.0}, {4.0, 0, SceneParameter::force, 0.25, 0.0}};
    const auto x = rendered(scene);
    REQUIRE(x.size() == 40000);
    CHECK(rmsBetween(x, 0.0, 1.99) == 0.0);
    CHECK(20.0 * std::log10(rmsBetween(x, 2.05, 3.95) / 0.1) == Approx(0.0).margin(1.5));
    CHECK(20.0 * std::log10(rmsBetween(x, 4.05, 4.95) / 0.05) == Approx(0.0).margin(2.0));
    // A step of the speed is felt where it is written, not later by the delay of the player.
    CHECK(rmsBetween(x, 2.0, 2.01) > 0.02);
    const auto first = std::find_if(x.begin(), x.end(), [](float sample) { return std::abs(sample) > 1e-3f; });
    CHECK(static_cast<double>(first - x.begin()) / 8000.0 == Approx(2.0).margin(0.003));
}

TEST_CASE("What a scene with a texture plays does not depend on blocks, and has gains, pans and levels of roles",
          "[scene][texture]")
{
    Scene scene = rubbing(2.0, rubbed(true));
    scene.textures.push_back(rubbed());
    scene.plays.push_back(scene.plays[0]);
    scene.plays[1].texture = 1;
    scene.plays[1].delay = 0.01;
    scene.plays[1].pan = 0.2;
    scene.actuators = 2;
    scene.changes = {{0.5, 0, SceneParameter::speed, 1.0, 0.7},
                     {0.6, 1, SceneParameter::noise, -12.0, 0.2},
                     {0.9, 1, SceneParameter::force, 0.3, 0.2},
                     {1.0, 0, SceneParameter::pan, 0.0, 0.3}};
    const auto whole = rendered(scene);
    CHECK(rendered(scene, nullptr, 1) == whole);
    CHECK(rendered(scene, nullptr, 77) == whole);

    Scene quiet = rubbing(2.0);
    quiet.plays[0].gain = -20.0;
    CHECK(rmsBetween(rendered(quiet), 0.1, 1.9) ==
          Approx(0.1 * rmsBetween(rendered(rubbing(2.0)), 0.1, 1.9)).epsilon(1e-4));
    Scene tone = rubbing(2.0, rubbed(true));
    tone.plays[0].tones = -20.0;
    CHECK(rmsBetween(rendered(tone), 0.1, 1.9) == Approx(0.01).epsilon(0.02));
    tone.plays[0].tones = -1000.0;
    CHECK(rmsBetween(rendered(tone), 0.1, 1.9) < 1e-4);
}

TEST_CASE("A texture loops on and fades at its ends, and two of them are not the same noise", "[scene][texture]")
{
    Scene scene = rubbing(0.5);
    scene.plays[0].loop = 0.5;
    scene.plays[0].passes = 4;
    const auto x = rendered(scene);
    REQUIRE(x.size() == 16000);
    double repeated = 0.0, power = 0.0;
    for (std::size_t n = 1000; n < 4000; ++n)
    {
        repeated += static_cast<double>(x[n]) * static_cast<double>(x[n + 4000]);
        power += static_cast<double>(x[n]) * static_cast<double>(x[n]);
    }
    CHECK(std::abs(repeated) < 0.3 * power);
    CHECK(std::abs(x.back()) < 1e-3f);
    CHECK(std::abs(x.front()) < 0.02f);
    Scene two = rubbing(1.0);
    two.plays.push_back(two.plays[0]);
    CHECK(rmsBetween(rendered(two), 0.1, 0.9) < 1.7 * rmsBetween(rendered(rubbing(1.0)), 0.1, 0.9));
}

TEST_CASE("What a texture adds is predicted: weak ones are left out, motors refuse them", "[scene][texture]")
{
    Scene scene = rubbing(2.0);
    scene.plays.push_back(scene.plays[0]);
    scene.plays[1].gain = -90.0;
    scene.plays.push_back(scene.plays[0]);
    scene.plays[2].speed = 0.0;
    const auto plan = compilePlan(scene);
    REQUIRE(plan.ok());
    CHECK(plan->plays.size() == 1);
    REQUIRE(plan->leftOut.size() == 2);

    Profile motor;
    motor.technology = Technology::erm;
    motor.resonance = {150.0, 2.0};
    const auto refused = compilePlan(rubbing(2.0), &motor);
    REQUIRE(refused.ok());
    REQUIRE(refused->leftOut.size() == 1);
    CHECK(refused->leftOut[0].reason.find("motor") != std::string::npos);
    CHECK(refused->leftOut[0].unplayable);
    CHECK(refused->leftOut[0].error == 0.0);
    CHECK(refused->predictedError == 0.0);
    CHECK(refused->culledError < -1000.0);
    // Beside a clip it is as much of the whole as its power is, also when everything is to be played.
    Scene both = rubbing(2.0);
    Clip tone;
    tone.duration = 2.0;
    tone.bands = {{150.0, 150.0, 150.0, 0, {{0.0, 0.1 * std::numbers::sqrt2}, {2.0, 0.1 * std::numbers::sqrt2}}, {}}};
    both.clips.push_back(tone);
    both.plays.emplace_back();
    both.plays[1].clip = 1;
    motor.range.dynamicRange = 60.0;
    for (const bool leaveOut : {true, false})
    {
        CompileParams params;
        params.leaveOut = leaveOut;
        params.adaptation.dynamicRange = false;
        const auto mixed = compilePlan(both, &motor, params);
        REQUIRE(mixed.ok());
        REQUIRE(mixed->leftOut.size() == 1);
        CHECK(mixed->leftOut[0].error == Approx(10.0 * std::log10(0.5)).margin(0.3));
        CHECK(mixed->predictedError == Approx(mixed->leftOut[0].error));
        CHECK(mixed->culledError < -1000.0);
    }
    // What is muted is not lost.
    Scene muted = rubbing(2.0);
    muted.plays[0].gain = -120.0;
    const auto silent = compilePlan(muted, &motor);
    REQUIRE(silent->leftOut.size() == 1);
    CHECK(silent->leftOut[0].reason == "is muted");
    CHECK(silent->predictedError < -1000.0);
    // With an actuator it goes through the output filter of all that plays.
    Profile lra;
    lra.technology = Technology::lra;
    lra.resonance = {150.0, 10.0};
    CHECK(test::rms(rendered(rubbing(1.0), &lra)) > 0.005);
}

TEST_CASE("Rules of textures in scenes", "[scene][texture]")
{
    const auto wrong = [](auto&& change)
    {
        Scene scene = rubbing(1.0);
        change(scene);
        const auto valid = validate(scene);
        return valid ? std::string() : valid.error().where;
    };
    CHECK(wrong([](Scene&) {}).empty());
    CHECK(wrong([](Scene& s) { s.plays[0].texture = 1; }) == "plays[0].texture");
    CHECK(wrong([](Scene& s) { s.clips[0].transients.push_back({0.1, 1.0, 0.5}); }) == "plays[0].texture");
    CHECK(wrong([](Scene& s) { s.plays[0].speed = 1.5; }) == "plays[0].speed");
    CHECK(wrong([](Scene& s) { s.plays[0].force = std::nan(""); }) == "plays[0].force");
    CHECK(wrong(
              [](Scene& s) {
                  s.changes.push_back({0.0, 0, SceneParameter::speed, -0.1, 0.0});
              }) == "changes[0].value");
    CHECK(wrong([](Scene& s) { s.textures[0].nodes[0].level = -1.0; }) == "textures[0].nodes[0].level");
}
