#include "support/Catch.h"
#include "support/Render.h"

#include <pacini/foundation/Random.h>
#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace pacini;
using test::Channels;

namespace
{
constexpr double sceneRate = 8000.0;

Clip mixture(std::uint64_t seed, bool envelope)
{
    Random random(seed);
    Clip clip;
    clip.duration = 1.0;
    for (const double f : {80.0, 130.0, 260.0})
        clip.bands.push_back({0.9 * f, f, 1.1 * f, 0, {{0.0, random.uniform(0.02, 0.2)}, {1.0, 0.1}}, {}});
    clip.noise = {{100.0, 180.0, {{0.0, random.uniform(0.02, 0.15)}}}};
    clip.transients = {{0.3, 0.6, 0.4}, {0.7, 0.5, 0.9}};
    if (envelope)
        clip.envelope = {{0.0, 0.2}, {0.5, random.uniform(0.1, 0.3)}, {1.0, 0.1}};
    return clip;
}

RenderPlan planned(const Scene& scene, bool leaveOut = true, double tolerance = -60.0)
{
    CompileParams params;
    params.sampleRate = sceneRate;
    params.leaveOut = leaveOut;
    params.tolerance = tolerance;
    const auto plan = compilePlan(scene, nullptr, params);
    if (!plan.ok())
        FAIL(plan.error().where << " " << plan.error().message);
    return *plan;
}

Channels rendered(const RenderPlan& plan, std::size_t block = 4096, bool protect = false)
{
    ScenePlayerParams params;
    params.sampleRate = sceneRate;
    params.protect = protect;
    ScenePlayer player(plan, params);
    return test::renderChannels(player, player.actuators(), block);
}

double energyOf(const Channels& channels)
{
    double sum = 0.0;
    for (const auto& channel : channels)
        for (const float x : channel)
            sum += static_cast<double>(x) * static_cast<double>(x);
    return sum;
}

Channels minus(Channels a, const Channels& b)
{
    for (std::size_t c = 0; c < a.size(); ++c)
        for (std::size_t i = 0; i < a[c].size(); ++i)
            a[c][i] -= b[c][i];
    return a;
}
} // namespace

TEST_CASE("Levels of roles in a scene are exact to the frame and do not depend on blocks", "[scene][roles]")
{
    for (const bool envelope : {false, true})
    {
        Scene scene;
        scene.actuators = 2;
        scene.clips = {mixture(1, envelope)};
        scene.plays.resize(1);
        scene.plays[0].start = 0.1;
        scene.plays[0].pan = 0.3;
        const Channels whole = rendered(planned(scene));
        scene.plays[0].events = -6.0206;
        const Channels events = minus(whole, rendered(planned(scene)));
        scene.plays[0].events = 0.0;
        scene.plays[0].noise = -6.0206;
        const Channels noise = minus(whole, rendered(planned(scene)));
        scene.plays[0].noise = 0.0;
        scene.changes = {{0.2, 0, SceneParameter::events, -6.0206, 0.3}, {0.6, 0, SceneParameter::noise, -6.0206, 0.0}};
        const RenderPlan plan = planned(scene);
        const Channels changed = rendered(plan);
        for (std::size_t c = 0; c < 2; ++c)
            for (std::size_t i = 0; i < whole[c].size(); ++i)
            {
                const double way = std::clamp((static_cast<double>(i) / sceneRate - 0.2) / 0.3, 0.0, 1.0);
                const double wanted = static_cast<double>(whole[c][i]) - way * static_cast<double>(events[c][i]) -
                                      (i < 4800 ? 0.0 : static_cast<double>(noise[c][i]));
                REQUIRE(static_cast<double>(changed[c][i]) == Approx(wanted).margin(3e-6));
            }
        for (const std::size_t block : {std::size_t(1), std::size_t(77)})
            CHECK(rendered(plan, block) == changed);
    }
}

TEST_CASE("A role that is muted throughout is left out of the plan, a play of muted roles as well", "[scene][roles]")
{
    for (const bool envelope : {false, true})
    {
        Scene scene;
        scene.clips = {mixture(1, envelope)};
        scene.plays.resize(2);
        scene.plays[0].tones = -120.0;
        scene.plays[0].events = -200.0;
        scene.plays[1].noise = -130.0;
        scene.plays[1].gain = -3.0;
        scene.changes = {{0.5, 0, SceneParameter::tones, -150.0, 0.1}, {0.6, 1, SceneParameter::tones, 3.0, 0.1}};
        const RenderPlan plan = planned(scene);
        const double nothing = -std::numeric_limits<double>::infinity();
        REQUIRE(plan.leftOut.size() == 3);
        CHECK((plan.leftOut[0] == LeftOut{"plays[0].tones", "is muted", nothing}));
        CHECK((plan.leftOut[1] == LeftOut{"plays[0].events", "is muted", nothing}));
        CHECK((plan.leftOut[2] == LeftOut{"plays[1].noise", "is muted", nothing}));
        ScenePlayerParams params;
        params.sampleRate = sceneRate;
        const ScenePlayer player(plan, params);
        REQUIRE(player.decodedPlays().size() == 2);
        CHECK(player.decodedPlays()[0].decoder.carriers == 0);
        CHECK(player.decodedPlays()[0].decoder.pulses == 0);
        CHECK(player.decodedPlays()[0].decoder.noiseBands == 1);
        CHECK(player.decodedPlays()[1].decoder.carriers == 3);
        CHECK(player.decodedPlays()[1].decoder.noiseBands == 0);
        // Nothing of it is heard: leaving it out costs nothing.
        const Channels all = rendered(planned(scene, false));
        CHECK(energyOf(minus(all, rendered(plan))) < 1e-10 * energyOf(all));

        scene.plays[0].noise = -120.0;
        const RenderPlan less = planned(scene);
        REQUIRE(less.leftOut.size() == 2);
        CHECK((less.leftOut[0] == LeftOut{"plays[0]", "is muted", nothing}));
        scene.changes.push_back({0.7, 0, SceneParameter::noise, -20.0, 0.1});
        CHECK(planned(scene).plays.size() == 2);
    }
}

TEST_CASE("What roles at low levels leave out stays within the error that is predicted", "[scene][roles]")
{
    for (std::uint64_t seed = 1; seed <= 30; ++seed)
        for (const double tolerance : {-20.0, -40.0})
        {
            CAPTURE(seed, tolerance);
            Random random(seed);
            Scene scene;
            scene.gain = seed % 3 == 0 ? 12.0 : -12.0; // some are limited
            for (std::uint64_t k = 0; k < 4; ++k)
                scene.clips.push_back(mixture(100 * seed + k, k % 2 == 0));
            for (std::size_t i = 0; i < 8; ++i)
            {
                ScenePlay play;
                play.clip = i % 4;
                play.start = random.uniform(0.0, 1.0);
                play.gain = random.uniform(-40.0, 0.0);
                play.tones = random.uniform() < 0.3 ? -120.0 : random.uniform(-30.0, 6.0);
                play.events = random.uniform() < 0.3 ? -120.0 : random.uniform(-30.0, 6.0);
                play.noise = random.uniform() < 0.3 ? -120.0 : random.uniform(-30.0, 6.0);
                scene.plays.push_back(play);
            }
            for (std::size_t i = 0; i < 8; ++i)
                scene.changes.push_back({0.1 * static_cast<double>(i), i, static_cast<SceneParameter>(5 + i % 3),
                                         random.uniform(-30.0, 6.0), random.uniform(0.0, 0.5)});
            const RenderPlan plan = planned(scene, true, tolerance);
            CHECK(plan.predictedError <= tolerance);
            const Channels all = rendered(planned(scene, false), 4096, true);
            const double error = energyOf(minus(all, rendered(plan, 4096, true)));
            if (error > 0.0)
                CHECK(10.0 * std::log10(error / energyOf(all)) <= std::max(plan.predictedError, -120.0));
        }
}

TEST_CASE("The timeline of a play has the levels of its roles, none where they are always 1", "[scene][roles]")
{
    Scene scene;
    scene.clips = {mixture(1, true)};
    scene.plays.resize(1);
    CHECK_FALSE(hasRoleLevels(makeTimeline(scene, 0, {})));
    scene.plays[0].noise = -20.0;
    const std::vector<SceneChange> changes = {{1.0, 0, SceneParameter::events, -20.0, 2.0},
                                              {2.0, 0, SceneParameter::noise, -130.0, 0.0}};
    const PlayTimeline timeline = makeTimeline(scene, 0, changes);
    CHECK(hasRoleLevels(timeline));
    CHECK(timeline.roles[Role::tones].empty());
    CHECK(valueAt(timeline.roles[Role::events], 0.5) == 1.0);
    CHECK(valueAt(timeline.roles[Role::events], 2.0) == Approx(0.55));
    CHECK(valueAt(timeline.roles[Role::noise], 1.9) == Approx(0.1));
    CHECK(valueAt(timeline.roles[Role::noise], 2.1) == 0.0);
    CHECK_FALSE(isMuted(timeline, Role::noise));
    CHECK_FALSE(isMuted(timeline, Role::tones));
}
