#include "support/Catch.h"
#include "support/HeapGuard.h"

#include <pacini/foundation/Random.h>
#include <pacini/runtime/Engine.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
constexpr double soakRate = 2000.0;
constexpr std::size_t soakBlock = 200;

std::shared_ptr<const LoadedClip> soakedHum(double seconds, double frequency, double level)
{
    Clip clip;
    clip.duration = seconds;
    clip.bands = {{0.9 * frequency, frequency, 1.1 * frequency, 0, {{0.0, level}}, {}}};
    clip.transients = {{0.5 * seconds, 2.0 * level, 0.5}};
    const auto made = LoadedClip::ofClip(clip);
    REQUIRE(made.ok());
    return *made;
}

std::vector<float> renderSoaked(Engine& engine)
{
    std::vector<float> out(soakBlock);
    const std::span<float> channel(out);
    engine.render(std::span(&channel, 1));
    return out;
}

/// Plays for `seconds` of the engine's time while plays come, change, are left out and go, then stops all of them and
/// compares the engine with a new one.
void soak(double seconds, std::uint64_t seed)
{
    EngineParams params;
    params.sampleRate = soakRate;
    params.actuators.resize(1);
    params.maxPlays = 12;
    auto made = Engine::make(params);
    REQUIRE(made.ok());
    const auto engine = std::move(made).value();
    const std::vector<std::shared_ptr<const LoadedClip>> clips{soakedHum(0.4, 90.0, 0.1), soakedHum(2.0, 60.0, 0.1),
                                                               soakedHum(0.05, 150.0, 0.1)};
    Random random(seed);
    std::vector<PlayId> plays;
    const auto blocks = static_cast<std::int64_t>(seconds * soakRate / static_cast<double>(soakBlock));
    float most = 0.0f;
    std::size_t traffic = 0, begun = 0;
    bool finite = true;
    for (std::int64_t b = 0; b < blocks; ++b)
    {
        if (random.next() % 4 == 0)
        {
            PlaySettings settings;
            settings.loop = random.next() % 2 == 0 ? 0.05 : 0.0;
            settings.from = random.uniform(0.0, 0.04);
            settings.controls.gain = random.uniform(0.0, 1.0);
            const auto play = engine->play(clips[random.next() % 3], settings, engine->framesRendered() + 100);
            if (play.ok())
            {
                ++begun;
                if (plays.size() < 32)
                    plays.push_back(*play);
                else
                    plays[random.next() % 32] = *play;
            }
        }
        if (!plays.empty())
        {
            const PlayId play = plays[random.next() % plays.size()];
            switch (random.next() % 8)
            {
            case 0:
                static_cast<void>(engine->set(play, LiveControl::gain, random.uniform(0.0, 1.0), 0.1_s));
                break;
            case 1:
                static_cast<void>(engine->set(play, LiveControl::transposition, random.uniform(-12.0, 12.0)));
                break;
            case 2:
                static_cast<void>(engine->set(play, LiveControl::speed, random.uniform(0.5, 2.0)));
                break;
            case 3:
            case 6:
            case 7:
                static_cast<void>(engine->stop(play));
                break;
            case 4:
                static_cast<void>(random.next() % 2 == 0 ? engine->pause(play) : engine->resume(play));
                break;
            case 5:
                static_cast<void>(engine->setBudget({0.0, random.next() % 8}));
                break;
            default:
                break;
            }
        }
        std::vector<float> out(soakBlock);
        const std::span<float> channel(out);
        {
            const test::HeapGuard guard;
            engine->render(std::span(&channel, 1));
            traffic += guard.traffic();
        }
        for (const float v : out)
        {
            finite = finite && std::isfinite(v);
            most = std::max(most, std::abs(v));
        }
    }
    CHECK(finite);
    CHECK(traffic == 0);
    CHECK(most <= 1.0f);
    CHECK(most > 0.1f);
    CHECK(engine->framesRendered() == blocks * static_cast<std::int64_t>(soakBlock));

    // Nothing is left behind, and a play sounds as in a new engine.
    for (const PlayId play : plays)
        static_cast<void>(engine->stop(play));
    for (std::uint32_t group = 0; group < limits::groups; ++group)
        REQUIRE(engine->stopGroup(group).ok());
    REQUIRE(engine->setBudget({}).ok());
    for (int i = 0; i < 50; ++i)
        renderSoaked(*engine);
    CHECK(engine->meters().playing == 0);
    auto fresh = Engine::make(params);
    REQUIRE(fresh.ok());
    PlaySettings settings;
    settings.loop = 2.0;
    renderSoaked(**fresh); // its latency lies before its first frame
    REQUIRE(engine->play(clips[1], settings).ok());
    REQUIRE((*fresh)->play(clips[1], settings).ok());
    double worst = 0.0;
    for (int i = 0; i < 300; ++i)
    {
        const std::vector<float> old = renderSoaked(*engine), wanted = renderSoaked(**fresh);
        for (std::size_t k = 0; k < soakBlock; ++k)
            worst = std::max(worst, std::abs(static_cast<double>(old[k]) - static_cast<double>(wanted[k])));
    }
    CHECK(worst < 1e-6);
    WARN(seconds << " s, " << begun << " plays, up to " << most << " of full drive; against a new engine " << worst);
}
} // namespace

TEST_CASE("An engine that has run for half an hour is as a new one", "[runtime]")
{
    soak(1800.0, 1);
}

TEST_CASE("An engine that has run for three hours is as a new one", "[runtime][slow]")
{
    soak(3.0 * 3600.0, 2);
}

TEST_CASE("An engine that has run for a day is as a new one", "[.soak]")
{
    soak(24.0 * 3600.0, 3);
}
