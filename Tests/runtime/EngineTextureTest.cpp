#include "support/Catch.h"
#include "support/HeapGuard.h"
#include "support/Measure.h"

#include <pacini/runtime/Engine.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
constexpr double textureEngineRate = 8000.0;

std::shared_ptr<const Texture> bark()
{
    Texture texture;
    texture.nodes.push_back({0.5, 0.1, {-0.6, 0.8}});
    texture.tones.push_back({300.0, 0.0, {0.05}});
    return std::make_shared<const Texture>(texture);
}

std::unique_ptr<Engine> textureEngine(std::size_t actuators = 1, const std::optional<Profile>& profile = {})
{
    EngineParams params;
    params.sampleRate = textureEngineRate;
    for (std::size_t a = 0; a < actuators; ++a)
        params.actuators.push_back({profile, 1.0, Seconds(0.0)});
    auto engine = Engine::make(params);
    REQUIRE(engine.ok());
    return std::move(*engine);
}

std::vector<float> pulled(Engine& engine, std::size_t frames, std::size_t block = 64)
{
    std::vector<float> out(frames);
    for (std::size_t n = 0; n < frames; n += block)
    {
        const auto part = std::span(out).subspan(n, std::min(block, frames - n));
        engine.render(std::span(&part, 1));
    }
    return out;
}

PlaySettings moving(double speed)
{
    PlaySettings settings;
    settings.controls.textureSpeed = speed;
    return settings;
}
} // namespace

TEST_CASE("An engine plays a texture by speed and force until it is stopped", "[runtime][texture]")
{
    const auto engine = textureEngine();
    const auto play = engine->play(bark(), moving(0.0));
    REQUIRE(play.ok());
    CHECK(test::rms(pulled(*engine, 8000)) == 0.0);
    CHECK(engine->status(*play).state == PlayState::playing);
    REQUIRE(engine->set(*play, LiveControl::textureSpeed, 0.5, Seconds(0.0)).ok());
    // Within 9 ms.
    CHECK(test::rms(std::span<const float>(pulled(*engine, 120)).subspan(72)) > 0.01);
    const double loud = test::rms(pulled(*engine, 16000));
    CHECK(20.0 * std::log10(loud / std::hypot(0.1, 0.05)) == Approx(0.0).margin(1.0));
    REQUIRE(engine->set(*play, LiveControl::textureForce, 0.25, Seconds(0.01)).ok());
    pulled(*engine, 800);
    CHECK(test::rms(pulled(*engine, 16000)) == Approx(0.5 * loud).epsilon(0.1));
    // Faders of clips: noise and tones are its roles.
    REQUIRE(engine->set(*play, LiveControl::noise, 0.0, Seconds(0.0)).ok());
    pulled(*engine, 800);
    CHECK(test::rms(pulled(*engine, 16000)) == Approx(0.025).epsilon(0.03));
    REQUIRE(engine->set(*play, LiveControl::tones, 0.0, Seconds(0.0)).ok());
    pulled(*engine, 800);
    CHECK(test::rms(pulled(*engine, 800)) < 1e-9);
    REQUIRE(engine->set(*play, LiveControl::tones, 1.0, Seconds(0.0)).ok());
    REQUIRE(engine->pause(*play).ok());
    pulled(*engine, 800);
    CHECK(test::rms(pulled(*engine, 800)) == 0.0);
    REQUIRE(engine->resume(*play).ok());
    pulled(*engine, 800);
    CHECK(test::rms(pulled(*engine, 800)) > 0.01);
    CHECK(engine->seek(*play, 1.0).error().where == "position");
    CHECK(engine->set(*play, LiveControl::textureSpeed, 1.5).error().where == "textureSpeed");
    CHECK(engine->set(*play, LiveControl::textureSpeed, std::nan("")).error().where == "textureSpeed");
    REQUIRE(engine->stop(*play).ok());
    pulled(*engine, 800);
    CHECK(engine->status(*play).state == PlayState::ended);
    CHECK(test::rms(pulled(*engine, 800)) == 0.0);
}

TEST_CASE("A texture that is moved takes no memory in the audio thread", "[runtime][texture]")
{
    const auto engine = textureEngine();
    const auto play = engine->play(bark(), moving(0.2));
    REQUIRE(play.ok());
    pulled(*engine, 256);
    std::vector<float> out(64);
    const std::span<float> channel(out);
    for (int i = 0; i < 200; ++i)
    {
        REQUIRE(engine->set(*play, LiveControl::textureSpeed, 0.5 + 0.5 * std::sin(i), Seconds(0.002 * (i % 4))).ok());
        REQUIRE(engine->set(*play, LiveControl::textureForce, (i % 10) / 9.0, Seconds(0.0)).ok());
        const test::HeapGuard guard;
        engine->render(std::span(&channel, 1));
        CHECK(guard.traffic() == 0);
    }
}

TEST_CASE("A texture depends on commands and frames, not on blocks", "[runtime][texture]")
{
    const auto performed = [](std::size_t block)
    {
        const auto engine = textureEngine();
        PlaySettings settings = moving(0.3);
        settings.variation.seed = 7;
        const auto play = engine->play(bark(), settings, 500);
        REQUIRE(play.ok());
        REQUIRE(engine->set(*play, LiveControl::textureSpeed, 0.9, Seconds(0.1), 900).ok());
        REQUIRE(engine->set(*play, LiveControl::textureForce, 0.2, Seconds(0.05), 1303).ok());
        REQUIRE(engine->stop(*play, Seconds(0.05), 3001).ok());
        return pulled(*engine, 4000, block);
    };
    const auto one = performed(64);
    CHECK(performed(1) == one);
    CHECK(performed(333) == one);
    CHECK(performed(4000) == one);
}

TEST_CASE("Motors alone refuse a texture; the actuators of a row get it by its pan", "[runtime][texture]")
{
    Profile motor;
    motor.technology = Technology::erm;
    motor.resonance = {150.0, 2.0};
    const auto motors = textureEngine(1, motor);
    CHECK(motors->play(bark(), moving(0.5)).error().where == "texture");
    const auto row = textureEngine(2);
    PlaySettings left = moving(0.5);
    left.controls.pan = 0.0;
    REQUIRE(row->play(bark(), left).ok());
    std::vector<float> a(4000), b(4000);
    const std::array<std::span<float>, 2> out{std::span(a), std::span(b)};
    row->render(out);
    CHECK(test::rms(a) > 0.05);
    CHECK(test::rms(b) < 1e-9);
}
