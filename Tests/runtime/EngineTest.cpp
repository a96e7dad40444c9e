#include "support/ActuatorOf.h"
#include "support/Catch.h"
#include "support/HeapGuard.h"
#include "support/Render.h"

#include <pacini/foundation/Random.h>
#include <pacini/runtime/Engine.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace pacini;
using test::Channels;

namespace
{
constexpr double fs = 8000.0;

Clip humming(double seconds, double level = 0.3, double frequency = 110.0)
{
    Clip clip;
    clip.name = "hum";
    clip.duration = seconds;
    clip.bands = {{0.9 * frequency, frequency, 1.1 * frequency, 0, {{0.0, level}}, {}}};
    return clip;
}

Clip knocking(double seconds)
{
    Clip clip = humming(seconds);
    clip.envelope = {{0.0, 0.1}, {0.5 * seconds, 0.5}, {seconds, 0.0}};
    clip.transients = {{0.2 * seconds, 0.8, 0.5}, {0.7 * seconds, 0.6, 0.9}};
    return clip;
}

/// Tones, noise and events.
Clip rustling(double seconds)
{
    Clip clip = knocking(seconds);
    clip.bands.push_back({250.0, 280.0, 310.0, 1, {{0.0, 0.2}}, {}});
    clip.transients = {{0.3 * seconds, 1.0, 0.5}, {0.7 * seconds, 1.0, 0.9}};
    clip.noise = {{60.0, 150.0, {{0.0, 0.1}}}, {200.0, 400.0, {{0.0, 0.15}, {seconds, 0.05}}}};
    return clip;
}

std::shared_ptr<const LoadedClip> loaded(const Clip& clip)
{
    const auto made = LoadedClip::ofClip(clip);
    REQUIRE(made.ok());
    return *made;
}

Profile lra()
{
    Profile profile = test::actuatorOf(Technology::lra, {175.0, 9.0}, {60.0, 400.0, 40.0});
    profile.drive.overdrive = 1.5;
    return profile;
}

Profile erm()
{
    return test::actuatorOf(Technology::erm, {160.0, 2.0}, {40.0, 300.0, 30.0});
}

EngineParams paramsOf(std::size_t actuators, std::optional<Profile> profile = {})
{
    EngineParams params;
    params.sampleRate = fs;
    params.actuators.assign(actuators, EngineActuator{std::move(profile)});
    return params;
}

std::unique_ptr<Engine> engineOf(const EngineParams& params, const Scene* scene = nullptr)
{
    auto made = Engine::make(params, scene);
    if (!made.ok())
        FAIL(made.error().where << " " << made.error().message);
    return std::move(made).value();
}

/// Renders `frames` on in blocks of `block`, and asks for `before(frame)` in front of each.
template <typename Before>
Channels renderWith(Engine& engine, std::size_t frames, std::size_t block, Before&& before)
{
    Channels out(engine.actuators(), std::vector<float>(frames, 7.0f));
    for (std::size_t i = 0; i < frames;)
    {
        before(i);
        const std::size_t n = std::min(block, frames - i);
        std::vector<std::span<float>> part;
        for (auto& channel : out)
            part.push_back(std::span(channel).subspan(i, n));
        engine.render(part);
        i += n;
    }
    return out;
}

Channels renderBlocks(Engine& engine, std::size_t frames, std::size_t block = 100)
{
    return renderWith(engine, frames, block, [](std::size_t) {});
}

PlayId started(Engine& engine, const std::shared_ptr<const LoadedClip>& clip, const PlaySettings& settings = {},
               std::int64_t frame = 0)
{
    const auto play = engine.play(clip, settings, frame);
    if (!play.ok())
        FAIL(play.error().where << " " << play.error().message);
    return *play;
}

double largest(std::span<const float> x)
{
    float most = 0.0f;
    for (const float v : x)
        most = std::max(most, std::abs(v));
    return static_cast<double>(most);
}

double largestStep(std::span<const float> x)
{
    double most = 0.0;
    for (std::size_t i = 1; i < x.size(); ++i)
        most = std::max(most, std::abs(static_cast<double>(x[i]) - static_cast<double>(x[i - 1])));
    return most;
}

Scene sceneOf(int actuators, std::size_t plays)
{
    Scene scene;
    scene.actuators = actuators;
    scene.clips = {knocking(0.4), humming(0.3, 0.2, 180.0)};
    for (std::size_t i = 0; i < plays; ++i)
    {
        ScenePlay play;
        play.clip = i % 2;
        play.start = 0.07 * static_cast<double>(i);
        play.pan = actuators > 1 ? static_cast<double>(i % 5) / 4.0 : 0.5;
        play.gain = plays > 1 ? -3.0 * static_cast<double>(i % 3) : 0.0;
        scene.plays.push_back(play);
    }
    if (plays > 2)
        scene.changes = {{0.1, 1, SceneParameter::pan, 1.0, 0.1},        {0.12, 2, SceneParameter::delay, 0.01, 0.05},
                         {0.13, 0, SceneParameter::tones, -130.0, 0.02}, {0.2, 0, SceneParameter::gain, -12.0, 0.03},
                         {0.22, 2, SceneParameter::events, -12.0, 0.03}, {0.25, 0, SceneParameter::tones, 0.0, 0.01}};
    return scene;
}
} // namespace

TEST_CASE("An engine plays a scene sample for sample as its player does, on every kind of actuator", "[runtime]")
{
    for (const auto& profile : {std::optional<Profile>(), std::optional(lra()), std::optional(erm())})
        for (const int actuators : {1, 3})
            for (const std::size_t plays : {std::size_t(1), std::size_t(6)})
            {
                CAPTURE(profile.has_value(), actuators, plays);
                const Scene scene = sceneOf(actuators, plays);
                CompileParams compile;
                compile.sampleRate = fs;
                const auto plan = compilePlan(scene, profile ? &*profile : nullptr, compile);
                REQUIRE(plan.ok());
                ScenePlayerParams playing;
                playing.sampleRate = fs;
                ScenePlayer player(*plan, playing);
                const Channels wanted = test::renderChannels(player, static_cast<std::size_t>(actuators), 4096);
                for (const std::size_t block : {std::size_t(64), std::size_t(333), std::size_t(5000)})
                {
                    const auto engine = engineOf(paramsOf(static_cast<std::size_t>(actuators), profile), &scene);
                    CHECK((renderBlocks(*engine, wanted[0].size(), block) == wanted));
                }
            }
}

TEST_CASE("A clip that is played alone is the decoder's, from its frame on", "[runtime]")
{
    const auto clip = loaded(knocking(0.3));
    Scene scene;
    scene.clips = {*clip->unpack()};
    scene.plays.resize(1);
    scene.plays[0].start = 777.0 / fs;
    CompileParams compile;
    compile.sampleRate = fs;
    compile.leaveOut = false;
    const auto plan = compilePlan(scene, nullptr, compile);
    REQUIRE(plan.ok());
    ScenePlayerParams playing;
    playing.sampleRate = fs;
    ScenePlayer player(*plan, playing);
    const Channels wanted = test::renderChannels(player, 1, 4096);

    const auto engine = engineOf(paramsOf(1));
    PlayId id;
    const Channels y = renderWith(*engine, wanted[0].size(), 50,
                                  [&](std::size_t at)
                                  {
                                      if (at == 500)
                                          id = started(*engine, clip, {}, 777);
                                      if (at == 600)
                                          CHECK(engine->status(id).state == PlayState::waiting);
                                      if (at == 1100)
                                      {
                                          CHECK(engine->status(id).state == PlayState::playing);
                                          const double ahead = static_cast<double>(engine->latencyFrames());
                                          CHECK(engine->status(id).position == Approx((1100.0 + ahead - 777.0) / fs));
                                      }
                                  });
    for (std::size_t i = 0; i < y[0].size(); ++i)
        REQUIRE(static_cast<double>(y[0][i]) == Approx(static_cast<double>(wanted[0][i])).margin(1e-6));
    renderBlocks(*engine, 100);
    CHECK(engine->status(id).state == PlayState::ended);
    CHECK(engine->framesRendered() == static_cast<std::int64_t>(wanted[0].size()) + 100);
}

TEST_CASE("A pan places a play between actuators by power, and glides there without a step", "[runtime]")
{
    const auto clip = loaded(humming(2.0, 0.3, 60.0));
    const auto engine = engineOf(paramsOf(3));
    PlaySettings settings;
    settings.controls.pan = 0.25; // halfway between the first two
    const PlayId id = started(*engine, clip, settings);
    Channels y = renderBlocks(*engine, 2000);
    const double half = std::sqrt(0.5) * 0.3;
    CHECK(largest(std::span(y[0]).subspan(500)) == Approx(half).epsilon(0.01));
    CHECK(largest(std::span(y[1]).subspan(500)) == Approx(half).epsilon(0.01));
    CHECK(largest(y[2]) == 0.0);
    REQUIRE(engine->set(id, LiveControl::pan, 1.0, Seconds(0.1)).ok());
    y = renderBlocks(*engine, 2000, 77);
    CHECK(largest(std::span(y[0]).subspan(900)) == 0.0);
    CHECK(largest(std::span(y[2]).subspan(900)) == Approx(0.3).epsilon(0.01));
    // On the way it passes the middle one, and no level jumps: the steps are those of the sine and of the glide.
    CHECK(largest(std::span(y[1]).first(800)) > 0.28);
    const double sineStep = 0.3 * 2.0 * 3.1416 * 60.0 / fs;
    for (const auto& channel : y)
        CHECK(largestStep(channel) < 1.1 * sineStep + 0.3 * 3.0 / 800.0);
}

TEST_CASE("Live delay is exact and glides without a step", "[runtime]")
{
    const auto clip = loaded(knocking(0.5));
    const auto reference = engineOf(paramsOf(1));
    started(*reference, clip);
    const Channels plain = renderBlocks(*reference, 4000);
    const auto engine = engineOf(paramsOf(1));
    PlaySettings settings;
    settings.controls.delay = 240.0 / fs;
    started(*engine, clip, settings);
    const Channels late = renderBlocks(*engine, 4240, 61);
    for (std::size_t i = 0; i < 4240; ++i)
        REQUIRE(static_cast<double>(late[0][i]) ==
                Approx(i < 240 ? 0.0 : static_cast<double>(plain[0][i - 240])).margin(1e-6));
    const auto gliding = engineOf(paramsOf(1));
    const PlayId id = started(*gliding, loaded(humming(2.0, 0.3, 60.0)));
    renderBlocks(*gliding, 1000);
    REQUIRE(gliding->set(id, LiveControl::delay, 0.1, Seconds(0.3)).ok());
    CHECK(largestStep(renderBlocks(*gliding, 6000, 200)[0]) < 1.45 * 0.3 * 2.0 * 3.1416 * 60.0 / fs);
}

TEST_CASE("Gain, intensity and a group's fader multiply, and a group sets what plays in it", "[runtime]")
{
    const auto clip = loaded(humming(5.0, 0.8));
    const auto engine = engineOf(paramsOf(1));
    PlaySettings settings;
    settings.group = 3;
    const PlayId id = started(*engine, clip, settings);
    renderBlocks(*engine, 1000);
    REQUIRE(engine->set(id, LiveControl::gain, 0.5).ok());
    REQUIRE(engine->set(id, LiveControl::intensity, 0.5).ok());
    REQUIRE(engine->setGroup(3, LiveControl::gain, 0.5).ok());
    REQUIRE(engine->setGroup(2, LiveControl::gain, 0.0).ok());
    renderBlocks(*engine, 500);
    CHECK(largest(renderBlocks(*engine, 1000)[0]) == Approx(0.1).epsilon(0.02));
    // A play to come is under the fader too.
    REQUIRE(engine->stop(id).ok());
    renderBlocks(*engine, 500);
    started(*engine, clip, settings);
    renderBlocks(*engine, 500);
    CHECK(largest(renderBlocks(*engine, 1000)[0]) == Approx(0.4).epsilon(0.02));
    REQUIRE(engine->stopGroup(3, Seconds(0.01)).ok());
    renderBlocks(*engine, 200);
    CHECK(largest(renderBlocks(*engine, 500)[0]) == 0.0);
    CHECK(engine->meters().playing == 0);
}

TEST_CASE("Roles of a play and of a group have live levels, exact to the frame and without a step", "[runtime]")
{
    const auto clip = loaded(rustling(2.0));
    EngineParams params = paramsOf(1);
    params.protect = false;
    using Change = std::pair<LiveControl, double>;
    const auto played = [&](const std::vector<Change>& changes, std::size_t block, bool group, double glide = 0.0)
    {
        const auto engine = engineOf(params);
        PlaySettings settings;
        settings.group = 2;
        const PlayId id = started(*engine, clip, settings);
        for (const auto& [control, value] : changes)
            REQUIRE((group ? engine->setGroup(2, control, value, Seconds(glide), 4000)
                           : engine->set(id, control, value, Seconds(glide), 4000))
                        .ok());
        return renderBlocks(*engine, 12000, block)[0];
    };
    const auto whole = played({}, 100, false);
    PerRole<std::vector<double>> parts;
    for (const Role role : allRoles)
    {
        const auto half = played({{controlOf(role), 0.5}}, 100, false);
        for (std::size_t i = 0; i < whole.size(); ++i)
        {
            if (i < 4000)
                REQUIRE(half[i] == whole[i]);
            parts[role].push_back(2.0 * (static_cast<double>(whole[i]) - static_cast<double>(half[i])));
        }
        CHECK(std::any_of(parts[role].begin(), parts[role].end(), [](double x) { return std::abs(x) > 0.05; }));
        CHECK(played({{controlOf(role), 0.5}}, 333, true) == half);
    }
    const auto mixed =
        played({{LiveControl::tones, 0.2}, {LiveControl::events, 1.5}, {LiveControl::noise, 0.7}}, 250, false, 0.1);
    for (std::size_t i = 0; i < whole.size(); ++i)
    {
        const double way = std::clamp((static_cast<double>(i) - 4000.0) / 800.0, 0.0, 1.0);
        REQUIRE(static_cast<double>(mixed[i]) ==
                Approx(static_cast<double>(whole[i]) - way * 0.8 * parts[Role::tones][i] +
                       way * 0.5 * parts[Role::events][i] - way * 0.3 * parts[Role::noise][i])
                    .margin(1e-5));
    }

    // Faders of a play and of its group multiply, and plays to come are under the group's.
    const auto engine = engineOf(params);
    const auto hum = loaded(humming(5.0, 0.8));
    PlaySettings settings;
    settings.controls.roles[Role::tones] = 0.5;
    REQUIRE(engine->setGroup(0, LiveControl::tones, 0.25, Seconds(0.0)).ok());
    renderBlocks(*engine, 100);
    const PlayId id = started(*engine, hum, settings);
    renderBlocks(*engine, 500);
    CHECK(largest(renderBlocks(*engine, 1000)[0]) == Approx(0.1).epsilon(0.02));
    // They stay where it seeks to and where another clip takes its place.
    REQUIRE(engine->seek(id, 1.0).ok());
    renderBlocks(*engine, 500);
    CHECK(largest(renderBlocks(*engine, 1000)[0]) == Approx(0.1).epsilon(0.02));
    REQUIRE(engine->replace(id, loaded(humming(5.0, 0.4))).ok());
    renderBlocks(*engine, 500);
    CHECK(largest(renderBlocks(*engine, 1000)[0]) == Approx(0.05).epsilon(0.02));
    REQUIRE(engine->set(id, LiveControl::tones, 0.0).ok());
    renderBlocks(*engine, 500);
    CHECK(largest(renderBlocks(*engine, 1000)[0]) == 0.0);
    REQUIRE(engine->set(id, LiveControl::tones, 1.0).ok());
    const Channels back = renderBlocks(*engine, 1000);
    CHECK(largest(back[0]) == Approx(0.1).epsilon(0.02));
    CHECK(largestStep(back[0]) < 1.1 * 0.1 * 2.0 * 3.1416 * 110.0 / fs + 0.1 / 40.0);
    CHECK(engine->set(id, LiveControl::noise, -0.1).error().where == "noise");
    CHECK(engine->set(id, LiveControl::events, 1001.0).error().where == "events");
    settings.controls.roles[Role::noise] = -1.0;
    CHECK(engine->play(hum, settings).error().where == "noise");
}

TEST_CASE("A role at 0 is not predicted to cost anything, nor to be missed", "[runtime]")
{
    EngineParams params = paramsOf(1);
    const auto clip = loaded(rustling(5.0));
    const auto costOf = [&](const std::vector<LiveControl>& silent)
    {
        const auto engine = engineOf(params);
        const PlayId id = started(*engine, clip);
        for (const LiveControl control : silent)
            REQUIRE(engine->set(id, control, 0.0).ok());
        renderBlocks(*engine, 1000);
        return engine->meters().cost;
    };
    const double all = costOf({});
    CHECK(costOf({LiveControl::noise}) < all - 2.0 * 28.0 * 0.5);
    CHECK(costOf({LiveControl::tones}) < all - 2.0 * 4.0 * 0.5);
    CHECK(costOf({LiveControl::events}) < all);
    CHECK(costOf({LiveControl::tones, LiveControl::noise}) < 0.2 * all);
    // Of two plays the one whose tones are at 0 brings less.
    params.budget.voices = 1;
    const auto engine = engineOf(params);
    const PlayId loud = started(*engine, loaded(humming(5.0, 0.6)));
    const PlayId soft = started(*engine, loaded(humming(5.0, 0.3)));
    renderBlocks(*engine, 1000);
    CHECK(engine->status(soft).state == PlayState::leftOut);
    REQUIRE(engine->set(loud, LiveControl::tones, 0.1).ok());
    renderBlocks(*engine, 1000);
    CHECK(engine->status(loud).state == PlayState::leftOut);
}

TEST_CASE("A play pauses and goes on where it was", "[runtime]")
{
    const auto clip = loaded(knocking(0.5));
    const auto reference = engineOf(paramsOf(1));
    started(*reference, clip);
    const Channels plain = renderBlocks(*reference, 4000);
    for (const std::size_t block : {std::size_t(50), std::size_t(333)})
    {
        const auto engine = engineOf(paramsOf(1));
        const PlayId id = started(*engine, clip);
        REQUIRE(engine->pause(id, Seconds(0.0), 1000).ok());
        REQUIRE(engine->resume(id, Seconds(0.0), 3000).ok());
        PlayState between = PlayState::ended;
        const Channels y = renderWith(*engine, 6000, block,
                                      [&](std::size_t at)
                                      {
                                          if (at > 2000 && at < 2400)
                                              between = engine->status(id).state;
                                      });
        CHECK(between == PlayState::paused);
        for (std::size_t i = 0; i < 6000; ++i)
        {
            const std::size_t from = i < 1000 ? i : i - 2000;
            const bool sounds = i < 1000 || i >= 3000;
            REQUIRE(static_cast<double>(y[0][i]) ==
                    Approx(sounds ? static_cast<double>(plain[0][from]) : 0.0).margin(1e-6));
        }
        CHECK(engine->status(id).state == PlayState::ended);
    }
}

TEST_CASE("A loop without end goes round without a click, in phase with its clip", "[runtime]")
{
    const auto clip = loaded(humming(0.5, 0.3, 50.0));
    const auto engine = engineOf(paramsOf(1));
    PlaySettings settings;
    settings.loop = 0.5;
    const PlayId id = started(*engine, clip, settings);
    const Channels y = renderBlocks(*engine, 30 * 8000, 480);
    CHECK(engine->status(id).state == PlayState::playing);
    CHECK(largestStep(y[0]) < 1.3 * 0.3 * 2.0 * 3.1416 * 50.0 / fs);
    for (std::size_t i = 1000; i < y[0].size(); i += 800)
        CHECK(largest(std::span(y[0]).subspan(i - 800, 800)) > 0.15);
    // A finite one ends.
    settings.passes = 3;
    const PlayId three = started(*engine, clip, settings, engine->framesRendered());
    renderBlocks(*engine, 11000);
    CHECK(engine->status(three).state == PlayState::playing);
    renderBlocks(*engine, 1200);
    CHECK(engine->status(three).state == PlayState::ended);
}

TEST_CASE("Seeking goes on at the place, and a clip is replaced while it plays", "[runtime]")
{
    Clip rising = humming(4.0);
    rising.bands[0].amplitude = {{0.0, 0.0}, {4.0, 0.8}};
    const auto clip = loaded(rising);
    const auto engine = engineOf(paramsOf(1));
    const PlayId id = started(*engine, clip);
    renderBlocks(*engine, 4000);
    REQUIRE(engine->seek(id, 3.0).ok());
    renderBlocks(*engine, 400);
    CHECK(largest(renderBlocks(*engine, 400)[0]) == Approx(0.62).margin(0.03));
    CHECK(engine->status(id).position == Approx(3.1).margin(0.01));
    // Longer than what is played unheard: cut off.
    const auto longer = loaded(humming(100.0, 0.1));
    REQUIRE(engine->replace(id, longer).ok());
    renderBlocks(*engine, 400);
    CHECK(largest(renderBlocks(*engine, 400)[0]) == Approx(0.1).margin(0.01));
    CHECK(engine->status(id).position == Approx(3.2).margin(0.02));
    REQUIRE(engine->seek(id, 50.0).ok());
    renderBlocks(*engine, 400);
    CHECK(engine->status(id).position == Approx(50.05).margin(0.02));
    REQUIRE(engine->set(id, LiveControl::speed, 2.0).ok());
    renderBlocks(*engine, 8000);
    CHECK(engine->status(id).position == Approx(52.05).margin(0.05));
}

TEST_CASE("What has ended, what is out of range and what is too much are errors", "[runtime]")
{
    EngineParams params = paramsOf(2);
    params.maxPlays = 2;
    params.maxCommands = 16;
    const auto engine = engineOf(params);
    const auto clip = loaded(knocking(0.1));
    const PlayId id = started(*engine, clip);
    CHECK(engine->set(id, LiveControl::gain, std::nan("")).error().where == "gain");
    CHECK(engine->set(id, LiveControl::speed, 0.0).error().where == "speed");
    CHECK(engine->set(id, LiveControl::delay, 0.3).error().where == "delay");
    CHECK(engine->setGroup(32, LiveControl::gain, 1.0).error().where == "group");
    CHECK(engine->setActuatorGain(2, 1.0).error().where == "actuator");
    CHECK(engine->setActuatorGain(1, 1.5).error().where == "value");
    PlaySettings wrong;
    wrong.loop = 1.0;
    CHECK(engine->play(clip, wrong).error().where == "loop");
    wrong = {};
    wrong.controls.pan = -1.0;
    CHECK(engine->play(clip, wrong).error().where == "pan");
    started(*engine, clip);
    CHECK(engine->play(clip).error().where == "plays");
    for (int i = 0; i < 100 && engine->set(id, LiveControl::gain, 1.0).ok(); ++i)
    {
    }
    CHECK(engine->set(id, LiveControl::gain, 1.0).error().where == "commands");
    renderBlocks(*engine, 2000);
    CHECK(engine->set(id, LiveControl::gain, 1.0).error().where == "play");
    CHECK(engine->stop({}).error().where == "play");
    CHECK(engine->status({77, 1}).state == PlayState::ended);
    const PlayId again = started(*engine, clip);
    CHECK(engine->status(id).state == PlayState::ended);
    CHECK(engine->status(again).state == PlayState::waiting);

    params.actuators[1].gain = 2.0;
    CHECK(Engine::make(params).error().where == "actuators[1].gain");
    const Scene scene = sceneOf(3, 1);
    CHECK(Engine::make(paramsOf(2), &scene).error().where == "scene.actuators");
}

TEST_CASE("Each actuator is played by its own profile, gain and delay", "[runtime]")
{
    EngineParams params = paramsOf(3);
    params.actuators[0].profile = lra();
    params.actuators[2].profile = erm();
    params.actuators[1].gain = 0.5;
    params.actuators[1].delay = Seconds(100.0 / fs);
    params.panLaw = PanLaw::delay;
    params.panDelay = Seconds(0.0);
    const auto engine = engineOf(params);
    const auto clip = loaded(humming(1.0, 0.5));
    started(*engine, clip);
    const Channels y = renderBlocks(*engine, 4000);
    const double third = 0.5 / std::sqrt(3.0);
    CHECK(largest(std::span(y[1]).first(100)) == 0.0);
    CHECK(largest(std::span(y[1]).subspan(1000)) == Approx(0.5 * third).epsilon(0.02));
    CHECK(largest(y[0]) > 0.0);
    // A motor is driven by the strength.
    CHECK(std::all_of(y[2].begin() + 2000, y[2].end(), [](float v) { return v > 0.0f; }));
    // The same signals as engines of one actuator each make, in time.
    EngineParams alone = paramsOf(1, lra());
    const auto single = engineOf(alone);
    PlaySettings settings;
    settings.controls.gain = 1.0 / std::sqrt(3.0);
    started(*single, clip, settings);
    const Channels s = renderBlocks(*single, 4000);
    for (std::size_t i = 0; i < 4000; ++i)
        REQUIRE(static_cast<double>(y[0][i]) == Approx(static_cast<double>(s[0][i])).margin(1e-5));
}

TEST_CASE("What does not fit in the budget is left out, least important first", "[runtime]")
{
    EngineParams params = paramsOf(1);
    params.budget.voices = 2;
    const auto engine = engineOf(params);
    PlaySettings settings;
    settings.priority = 1;
    settings.controls.gain = 1.0;
    const PlayId loud = started(*engine, loaded(humming(2.0, 0.4, 60.0)), settings);
    settings.controls.gain = 0.1;
    const PlayId faint = started(*engine, loaded(humming(2.0, 0.4, 90.0)), settings);
    settings.priority = 0;
    settings.controls.gain = 0.01;
    const PlayId kept = started(*engine, loaded(humming(2.0, 0.4, 120.0)), settings);
    renderBlocks(*engine, 1000);
    CHECK(engine->status(loud).state == PlayState::playing);
    CHECK(engine->status(kept).state == PlayState::playing);
    CHECK(engine->status(faint).state == PlayState::leftOut);
    CHECK(engine->meters().leftOut == 1);
    CHECK(engine->meters().playing == 2);
    CHECK(engine->meters().leftOutError == Approx(-20.0).margin(0.3));
    // By time: nothing fits.
    REQUIRE(engine->setBudget({0.001, 0}).ok());
    renderBlocks(*engine, 1000);
    CHECK(largest(renderBlocks(*engine, 1000)[0]) == 0.0);
    // What is left out ends when it would have.
    renderBlocks(*engine, 16000);
    CHECK(engine->status(loud).state == PlayState::ended);
    CHECK(engine->meters().playing == 0);
}

namespace
{
/// Random commands for random frames, all of them known `ahead` frames before.
struct Performance
{
    struct Step
    {
        std::int64_t frame;
        int what;
        std::size_t play;
        double value;
        LiveControl control;
    };
    std::vector<Step> steps;

    explicit Performance(std::uint64_t seed, std::int64_t frames)
    {
        Random random(seed);
        std::int64_t at = 0;
        while (at < frames)
        {
            at += static_cast<std::int64_t>(random.next() % 300);
            steps.push_back({at, static_cast<int>(random.next() % 10), random.next() % 64, random.uniform(0.0, 1.0),
                             static_cast<LiveControl>(random.next() % 10)});
        }
    }
};

double valueOf(LiveControl control, double x)
{
    switch (control)
    {
    case LiveControl::delay:
        return 0.25 * x;
    case LiveControl::transposition:
        return 24.0 * x - 12.0;
    case LiveControl::speed:
        return 0.25 + 2.0 * x;
    case LiveControl::priority:
        return std::floor(3.0 * x);
    case LiveControl::tones:
    case LiveControl::events:
    case LiveControl::noise:
        return std::max(0.0, 1.8 * x - 0.8);
    default:
        return x;
    }
}

Channels perform(const Performance& performance, const EngineParams& params, std::size_t frames, std::size_t block,
                 std::size_t ahead)
{
    const auto engine = engineOf(params);
    const std::vector<std::shared_ptr<const LoadedClip>> clips{loaded(knocking(0.3)), loaded(rustling(0.4)),
                                                               loaded(knocking(0.05))};
    std::vector<PlayId> plays;
    std::size_t next = 0;
    return renderWith(
        *engine, frames, block,
        [&](std::size_t at)
        {
            while (next < performance.steps.size() &&
                   performance.steps[next].frame < static_cast<std::int64_t>(at + block + ahead))
            {
                const Performance::Step& step = performance.steps[next++];
                PlaySettings settings;
                settings.controls.gain = 0.3;
                settings.controls.pan = step.value;
                settings.group = static_cast<std::uint32_t>(step.play % 3);
                settings.loop = step.play % 4 == 0 ? 0.05 : 0.0;
                const PlayId target = plays.empty() ? PlayId{} : plays[plays.size() - 1 - step.play % plays.size()];
                // What has ended meanwhile is an error in some of the runs: no difference.
                if (step.what < 4)
                    plays.push_back(started(*engine, clips[step.play % 3], settings, step.frame));
                else if (step.what < 7)
                    static_cast<void>(engine->set(target, step.control, valueOf(step.control, step.value),
                                                  Seconds(0.1 * step.value), step.frame));
                else if (step.what == 7)
                    static_cast<void>(engine->stop(target, Seconds(0.02), step.frame));
                else if (step.what == 8)
                    static_cast<void>(step.value < 0.5 ? engine->pause(target, Seconds(0.01), step.frame)
                                                       : engine->resume(target, Seconds(0.01), step.frame));
                else
                    static_cast<void>(engine->setGroup(static_cast<std::uint32_t>(step.play % 3),
                                                       step.play % 2 == 0 ? LiveControl::gain : step.control,
                                                       valueOf(step.control, step.value), Seconds(0.05), step.frame));
            }
        });
}
} // namespace

TEST_CASE("Blocks and the time at which commands come change nothing", "[runtime]")
{
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
    {
        CAPTURE(seed);
        const Performance performance(seed, 20000);
        EngineParams params = paramsOf(2, seed % 2 == 0 ? std::optional(lra()) : std::nullopt);
        params.panLaw = seed % 3 == 0 ? PanLaw::both : PanLaw::constantPower;
        params.maxPlays = 1000;
        params.budget.voices = seed > 4 ? 5 : 0;
        const Channels wanted = perform(performance, params, 24000, 256, 64);
        CHECK(largest(wanted[0]) > 0.05);
        CHECK((perform(performance, params, 24000, 64, 64) == wanted));
        CHECK((perform(performance, params, 24000, 1777, 500) == wanted));
        CHECK((perform(performance, params, 24000, 7, 5000) == wanted));
        for (const auto& channel : wanted)
            CHECK(std::all_of(channel.begin(), channel.end(), [](float v) { return std::abs(v) <= 1.0f; }));
    }
}

namespace
{
/// How many of the performances with seeds [from, to), under tight budgets of voices, of time or of both, differ in
/// some size of blocks.
int differingUnderBudgets(std::uint64_t from, std::uint64_t to)
{
    int differing = 0;
    for (std::uint64_t seed = from; seed < to; ++seed)
    {
        const Performance performance(seed, 20000);
        Random random(seed + 1000);
        EngineParams params = paramsOf(1 + seed % 3, seed % 2 == 0 ? std::optional(lra()) : std::nullopt);
        if (seed % 5 == 0)
            params.actuators.back().profile = erm();
        params.panLaw = seed % 7 == 0 ? PanLaw::both : PanLaw::constantPower;
        params.maxPlays = 1000;
        const std::size_t voices = 1 + random.next() % 6;
        const double time = random.uniform(8.0, 100.0); // of plays that are predicted to take 5 to 40 ns each
        if (seed % 3 != 1)
            params.budget.voices = voices;
        if (seed % 3 != 0)
            params.budget.nanosecondsPerFrame = time;
        const Channels wanted = perform(performance, params, 24000, 256, 64);
        for (const auto& [block, ahead] :
             {std::pair<std::size_t, std::size_t>{7, 5000}, {64, 64}, {100, 24000}, {1777, 500}})
            if (perform(performance, params, 24000, block, ahead) != wanted)
            {
                UNSCOPED_INFO("seed " << seed << ", blocks of " << block);
                ++differing;
            }
    }
    return differing;
}
} // namespace

TEST_CASE("Blocks change nothing under tight budgets of voices and of time", "[runtime]")
{
    CHECK(differingUnderBudgets(1, 31) == 0);
}

TEST_CASE("Blocks change nothing under tight budgets, a thousand times", "[runtime][slow]")
{
    CHECK(differingUnderBudgets(31, 1031) == 0);
}

TEST_CASE("Rendering touches no heap, whatever is started, changed, replaced and stopped", "[runtime]")
{
    EngineParams params = paramsOf(3, lra());
    params.actuators[1].profile.reset();
    const auto engine = engineOf(params);
    const auto clip = loaded(rustling(0.3));
    Random random(5);
    std::vector<PlayId> plays;
    Channels out(3, std::vector<float>(300));
    std::vector<std::span<float>> spans(out.begin(), out.end());
    std::size_t traffic = 0;
    for (int i = 0; i < 400; ++i)
    {
        PlaySettings settings;
        settings.loop = i % 3 == 0 ? 0.1 : 0.0;
        if (const auto play = engine->play(clip, settings); play.ok())
            plays.push_back(*play);
        const PlayId target = plays[random.next() % plays.size()];
        static_cast<void>(engine->seek(target, 0.2));
        static_cast<void>(engine->set(target, LiveControl::pan, random.uniform(0.0, 1.0)));
        static_cast<void>(engine->set(target, LiveControl::transposition, 3.0));
        static_cast<void>(engine->set(target, static_cast<LiveControl>(7 + i % 3), i % 5 == 0 ? 1.0 : 0.0));
        if (i % 2 == 0)
            static_cast<void>(engine->stop(target));
        const test::HeapGuard guard;
        engine->render(spans);
        traffic += guard.traffic();
    }
    CHECK(traffic == 0);
}

TEST_CASE("One thread renders while another plays and a third looks", "[runtime]")
{
    const auto engine = engineOf(paramsOf(2));
    const auto clip = loaded(knocking(0.1));
    std::atomic<bool> done{false};
    std::atomic<std::size_t> seen{0};
    std::thread audio(
        [&]
        {
            Channels out(2, std::vector<float>(64));
            std::vector<std::span<float>> spans(out.begin(), out.end());
            while (!done.load())
                engine->render(spans);
        });
    std::thread viewer(
        [&]
        {
            while (!done.load())
                seen += engine->meters().playing + (engine->status({0, 1}).position >= 0.0 ? 1u : 0u);
        });
    Random random(3);
    std::vector<PlayId> plays;
    for (int i = 0; i < 3000; ++i)
    {
        if (const auto play = engine->play(clip); play.ok())
            plays.push_back(*play);
        if (!plays.empty())
        {
            const PlayId target = plays[random.next() % plays.size()];
            static_cast<void>(engine->set(target, LiveControl::gain, 0.5));
            if (i % 5 == 0)
                static_cast<void>(engine->stop(target));
        }
        if (i % 100 == 0)
            std::this_thread::yield();
    }
    for (int i = 0; i < 5000 && seen == 0; ++i) // on a busy machine the viewer may not have had its turn
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    done.store(true);
    audio.join();
    viewer.join();
    CHECK(seen > 0);
    CHECK(plays.size() > 100);
}

namespace
{
/// A hum that changes all the time, so that nothing but the right place of it will do.
Clip wandering(double seconds)
{
    Clip clip = humming(seconds, 0.1, 110.0);
    for (int i = 0; i <= 40; ++i)
    {
        const double t = seconds * i / 40.0;
        clip.bands[0].pitch.push_back({t, 100.0 + 40.0 * ((i * 7) % 5)});
        clip.envelope.push_back({t, 0.05 + 0.05 * ((i * 3) % 4)});
    }
    clip.bands.push_back({240.0, 260.0, 280.0, 0, {{0.0, 0.05}}, {}});
    clip.transients = {{0.4 * seconds, 0.5, 0.5}, {0.8 * seconds, 0.5, 0.5}};
    return clip;
}
} // namespace

TEST_CASE("What was left out comes back when there is room, where it would be by then", "[runtime]")
{
    for (const double loop : {0.0, 3.0})
        for (const bool changes : {false, true})
        {
            CAPTURE(loop, changes);
            const auto clip = loaded(wandering(loop > 0.0 ? 3.0 : 30.0));
            PlaySettings settings;
            settings.loop = loop;
            const auto run = [&](bool limited)
            {
                const auto engine = engineOf(paramsOf(2));
                const PlayId id = started(*engine, clip, settings);
                return std::pair(renderWith(*engine, 200000, 250,
                                            [&](std::size_t at)
                                            {
                                                if (limited && at == 4000)
                                                    REQUIRE(engine->setBudget({0.001, 0}).ok());
                                                if (changes && at == 30000)
                                                {
                                                    REQUIRE(engine->set(id, LiveControl::transposition, 3.0).ok());
                                                    REQUIRE(engine->set(id, LiveControl::speed, 0.9).ok());
                                                }
                                                if (changes && at == 140000) // on its way when it comes back
                                                {
                                                    REQUIRE(engine->set(id, LiveControl::gain, 0.4, 3.0_s).ok());
                                                    REQUIRE(engine->set(id, LiveControl::pan, 0.9, 3.0_s).ok());
                                                    REQUIRE(engine->set(id, LiveControl::delay, 0.1, 2.0_s).ok());
                                                }
                                                if (limited && at == 150000)
                                                {
                                                    CHECK(engine->status(id).state == PlayState::leftOut);
                                                    REQUIRE(engine->setBudget({0.0, 0}).ok());
                                                }
                                                if (limited && at == 150250)
                                                    CHECK(engine->status(id).state == PlayState::playing);
                                            }),
                                 engine->status(id).position);
            };
            const auto [whole, end] = run(false);
            const auto [cut, cutEnd] = run(true);
            CHECK(cutEnd == Approx(end).margin(1e-6));
            for (std::size_t a = 0; a < 2; ++a)
            {
                CHECK(largest(std::span(cut[a]).subspan(4300, 145000)) == 0.0);
                CHECK(largest(std::span(cut[a]).subspan(150000, 1000)) > 0.01);
                CHECK(largestStep(std::span(cut[a]).subspan(149000, 2000)) < 0.1);
                // The leveller and the delay line have their past again.
                for (std::size_t i = 152000; i < 200000; ++i)
                    REQUIRE(static_cast<double>(cut[a][i]) == Approx(static_cast<double>(whole[a][i])).margin(1e-5));
            }
        }
}

TEST_CASE("A play that is left out pauses, goes on, moves and ends as it would", "[runtime]")
{
    EngineParams params = paramsOf(1);
    params.budget.voices = 1;
    const auto engine = engineOf(params);
    PlaySettings settings;
    settings.priority = 0;
    const PlayId kept = started(*engine, loaded(humming(60.0, 0.1, 60.0)), settings);
    settings.priority = 1;
    const auto clip = loaded(humming(10.0, 0.4, 90.0));
    const PlayId out = started(*engine, clip, settings);
    CHECK(largest(renderBlocks(*engine, 8000)[0]) < 0.101); // nothing of it is heard before it is left out
    CHECK(engine->status(out).state == PlayState::leftOut);
    CHECK(engine->status(out).position == Approx(1.0).margin(0.01));
    REQUIRE(engine->pause(out).ok());
    renderBlocks(*engine, 16000);
    CHECK(engine->status(out).state == PlayState::paused);
    CHECK(engine->status(out).position == Approx(1.0).margin(0.01));
    REQUIRE(engine->resume(out).ok());
    renderBlocks(*engine, 8000);
    CHECK(engine->status(out).state == PlayState::leftOut);
    CHECK(engine->status(out).position == Approx(2.0).margin(0.01));
    REQUIRE(engine->seek(out, 7.0).ok());
    renderBlocks(*engine, 8000);
    CHECK(engine->status(out).position == Approx(8.0).margin(0.01));
    REQUIRE(engine->stop(kept).ok());
    renderBlocks(*engine, 2000);
    CHECK(engine->status(out).state == PlayState::playing);
    CHECK(largest(renderBlocks(*engine, 1000)[0]) == Approx(0.4).epsilon(0.02));
    REQUIRE(engine->setBudget({0.001, 0}).ok());
    renderBlocks(*engine, 12000);
    CHECK(engine->status(out).state == PlayState::leftOut);
    renderBlocks(*engine, 2000);
    CHECK(engine->status(out).state == PlayState::ended);
}

TEST_CASE("A loop fades out over its joints", "[runtime]")
{
    const auto engine = engineOf(paramsOf(1));
    PlaySettings settings;
    settings.loop = 1.0;
    const PlayId id = started(*engine, loaded(humming(1.0, 0.4, 90.0)), settings);
    renderBlocks(*engine, 8000 * 6);
    REQUIRE(engine->stop(id, 8.0_s).ok()); // stretches of it are 10 s long
    renderBlocks(*engine, 8000 * 6);
    CHECK(largest(renderBlocks(*engine, 800)[0]) == Approx(0.1).margin(0.01));
    renderBlocks(*engine, 8000 * 2);
    CHECK(engine->status(id).state == PlayState::ended);
}

TEST_CASE("A clip plays as rendered, sample for sample, where an engine is made so", "[runtime]")
{
    Clip clip = knocking(0.6);
    clip.bands.push_back({300.0, 310.0, 320.0, 1, {{0.0, 0.1}, {0.6, 0.3}}, {}});
    clip.bands.push_back({350.0, 360.0, 370.0, 2, {{0.0, 1e-5}}, {}}); // too weak to matter
    for (const auto& profile : {std::optional<Profile>(), std::optional(lra()), std::optional(erm())})
        for (const int actuators : {1, 2})
        {
            CAPTURE(profile.has_value(), actuators);
            Scene scene;
            scene.actuators = actuators;
            scene.clips = {clip};
            scene.plays.emplace_back();
            CompileParams compile;
            compile.sampleRate = fs;
            const auto plan = compilePlan(scene, profile ? &*profile : nullptr, compile);
            REQUIRE(plan.ok());
            CHECK((plan->leftOut.empty() == (profile && profile->technology == Technology::erm)));
            ScenePlayerParams playing;
            playing.sampleRate = fs;
            ScenePlayer player(*plan, playing);
            const Channels wanted = test::renderChannels(player, static_cast<std::size_t>(actuators), 512);
            EngineParams params = paramsOf(static_cast<std::size_t>(actuators), profile);
            params.asRendered = true;
            params.longestDelay = Seconds(0.0);
            const auto engine = engineOf(params);
            const auto loadedClip = LoadedClip::asItIs(clip);
            REQUIRE(loadedClip.ok());
            started(*engine, *loadedClip);
            const Channels heard = renderBlocks(*engine, wanted[0].size());
            CHECK(largest(wanted[0]) > 0.05);
            if (actuators == 1)
                CHECK((heard == wanted));
            for (std::size_t c = 0; c < heard.size(); ++c)
                for (std::size_t i = 0; i < heard[c].size(); ++i)
                    REQUIRE(heard[c][i] == Approx(static_cast<double>(wanted[c][i])).margin(1e-6));
        }
    EngineParams params = paramsOf(1);
    params.asRendered = true;
    params.budget.voices = 2;
    CHECK(Engine::make(params).error().where == "budget");
}

TEST_CASE("A clip that is replaced in time goes on as if it had always played", "[runtime]")
{
    const Clip before = humming(30.0);
    Clip after = before;
    after.transients = {{29.0, 0.8, 0.5}};
    for (const double loop : {0.0, 0.7})
    {
        CAPTURE(loop);
        PlaySettings settings;
        settings.loop = loop;
        const auto plain = engineOf(paramsOf(1));
        started(*plain, *LoadedClip::asItIs(before), settings);
        const Channels wanted = renderBlocks(*plain, 16000);
        const auto engine = engineOf(paramsOf(1));
        const PlayId id = started(*engine, *LoadedClip::asItIs(before), settings);
        Channels heard = renderBlocks(*engine, 4000);
        const auto latency = static_cast<std::int64_t>(engine->latencyFrames());
        const InTime here{engine->framesRendered() + latency, 100};
        const double place = engine->status(id).position;
        const Channels meanwhile = renderBlocks(*engine, 1000); // while it is built
        REQUIRE(engine->replace(id, *LoadedClip::asItIs(after), place, here).ok());
        const Channels more = renderBlocks(*engine, 11000);
        heard[0].insert(heard[0].end(), meanwhile[0].begin(), meanwhile[0].end());
        heard[0].insert(heard[0].end(), more[0].begin(), more[0].end());
        for (std::size_t i = 0; i < wanted[0].size(); ++i)
            REQUIRE(heard[0][i] == Approx(static_cast<double>(wanted[0][i])).margin(1e-5));
    }
}

TEST_CASE("A row may be panned by delays that are zero", "[runtime]")
{
    EngineParams params = paramsOf(2);
    params.panLaw = PanLaw::delay;
    params.panDelay = Seconds(0.0);
    params.longestDelay = Seconds(0.0);
    const auto engine = engineOf(params);
    PlaySettings settings;
    settings.controls.pan = 1.0;
    started(*engine, loaded(humming(1.0)), settings);
    const Channels heard = renderBlocks(*engine, 2000);
    CHECK(largest(heard[0]) == Approx(0.3 / std::sqrt(2.0)).margin(0.01));
    CHECK(heard[0] == heard[1]);
}
