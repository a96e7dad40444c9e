#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/synthesis/PlayTimeline.h>
#include <pacini/synthesis/Variation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
Scene placedScene(PanLaw law, int actuators, double pan)
{
    Scene scene;
    scene.clips.resize(1);
    scene.clips[0].duration = 1.0;
    scene.plays.resize(1);
    scene.plays[0].pan = pan;
    scene.plays[0].gain = -6.0;
    scene.gain = 20.0;
    scene.actuators = actuators;
    scene.panLaw = law;
    scene.panDelay = 0.03;
    return scene;
}

PlayTimeline timelineOf(const Scene& scene)
{
    return makeTimeline(scene, 0, scene.changes);
}

std::vector<double> numbersOf(const std::vector<Curve>& curves)
{
    std::vector<double> all;
    for (const Curve& curve : curves)
    {
        all.push_back(static_cast<double>(curve.size()));
        for (const Breakpoint& point : curve)
        {
            all.push_back(point.time);
            all.push_back(point.value);
        }
    }
    return all;
}
} // namespace

TEST_CASE("Panning divides a play between its two neighbours by sine and cosine", "[scene]")
{
    CHECK(panGain(PanLaw::constantPower, 0.3, 0, 1) == 1.0);
    CHECK(panGain(PanLaw::delay, 0.3, 1, 4) == Approx(0.5));
    CHECK(panGain(PanLaw::delay, 0.3, 0, 1) == 1.0);
    for (const PanLaw law : {PanLaw::constantPower, PanLaw::both})
        for (const double pan : {0.0, 0.1, 0.25, 0.5, 0.7, 1.0})
            for (std::size_t a = 0; a < 5; ++a)
            {
                CAPTURE(pan, a);
                const double away = std::abs(4.0 * pan - static_cast<double>(a));
                const double wanted = away < 1.0 ? std::cos(std::numbers::pi * away / 2.0) : 0.0;
                CHECK(panGain(law, pan, a, 5) == Approx(wanted).margin(1e-12));
            }
    CHECK(panGain(PanLaw::constantPower, 0.0, 1, 2) == 0.0);
}

TEST_CASE("Panning by time delays each actuator by its part of the row", "[scene]")
{
    CHECK(panDelay(0.2, 0, 1, 0.05) == 0.0);
    CHECK(panDelay(0.0, 0, 5, 0.05) == 0.0);
    CHECK(panDelay(0.0, 4, 5, 0.05) == Approx(0.05));
    CHECK(panDelay(0.6, 1, 5, 0.05) == Approx(0.05 * 0.35));
    CHECK(panDelay(0.2, 3, 5, 0.05) == Approx(0.05 * 0.55));
}

TEST_CASE("A play that nothing changes has one level and delay for each actuator", "[scene]")
{
    const double level = std::pow(10.0, 14.0 / 20.0);
    {
        const PlayTimeline timeline = timelineOf(placedScene(PanLaw::constantPower, 1, 0.2));
        REQUIRE(timeline.gains.size() == 1);
        REQUIRE(timeline.gains[0].size() == 1);
        CHECK(timeline.gains[0][0].time == 0.0);
        CHECK(timeline.gains[0][0].value == Approx(level));
        CHECK(timeline.delays.empty());
        CHECK(timeline.changes.empty());
    }
    for (const PanLaw law : {PanLaw::constantPower, PanLaw::delay, PanLaw::both})
    {
        const PlayTimeline timeline = timelineOf(placedScene(law, 3, 0.25));
        REQUIRE(timeline.gains.size() == 3);
        const double gains[] = {std::sqrt(0.5), std::sqrt(0.5), 0.0};
        const double delays[] = {0.0075, 0.0075, 0.0225};
        REQUIRE(timeline.delays.size() == (law == PanLaw::constantPower ? 0u : 3u));
        for (std::size_t a = 0; a < 3; ++a)
        {
            CHECK(timeline.gains[a].size() == 1);
            CHECK(timeline.gains[a][0].value ==
                  Approx(level * (law == PanLaw::delay ? 1.0 / std::sqrt(3.0) : gains[a])));
            if (law != PanLaw::constantPower)
            {
                REQUIRE(timeline.delays[a].size() == 1);
                CHECK(timeline.delays[a][0].time == 0.0);
                CHECK(timeline.delays[a][0].value == Approx(delays[a]));
            }
        }
    }
    CHECK(timelineOf(placedScene(PanLaw::delay, 1, 0.25)).delays.empty());
}

TEST_CASE("Gains glide in a straight line from what has been reached, and step where they have no time", "[scene]")
{
    Scene scene = placedScene(PanLaw::constantPower, 1, 0.5);
    scene.gain = 0.0;
    scene.plays[0].gain = 0.0;
    scene.changes = {{1.0, 0, SceneParameter::gain, 20.0, 1.0},   // to 10 at 2 s
                     {1.5, 0, SceneParameter::gain, -200.0, 0.5}, // from 5.5 to 0 at 2 s
                     {3.0, 0, SceneParameter::gain, 0.0, 0.0}};   // steps to 1
    const Curve curve = timelineOf(scene).gains[0];
    for (const auto& [time, value] : {std::pair{0.0, 1.0},
                                      {0.999, 1.0},
                                      {1.0, 1.0},
                                      {1.25, 3.25},
                                      {1.5, 5.5},
                                      {1.75, 2.75},
                                      {2.0, 0.0},
                                      {2.5, 0.0},
                                      {2.9999, 0.0},
                                      {3.0, 1.0},
                                      {9.0, 1.0}})
    {
        CAPTURE(time);
        CHECK(valueAt(curve, time) == Approx(value).margin(1e-9));
    }
    REQUIRE(curve.size() == 6);
    CHECK(curve[4].time == 3.0);
    CHECK(curve[4].value == 0.0);
    CHECK(curve[5].time == 3.0);
    // A step at the very start has no side before it.
    scene.changes = {{0.0, 0, SceneParameter::gain, 20.0, 0.0}};
    CHECK(timelineOf(scene).gains[0] == Curve{{0.0, 10.0}});
}

TEST_CASE("A glide that is overtaken ends where the next begins", "[scene]")
{
    detail::GlideCurve glide(1.0);
    CHECK(glide.curve() == Curve{{0.0, 1.0}});
    glide.glideTo(3.0, 1.0, 2.0);
    CHECK(glide.curve() == Curve{{0.0, 1.0}, {1.0, 1.0}, {3.0, 3.0}});
    glide.glideTo(0.0, 2.0, 4.0);
    CHECK(glide.curve() == Curve{{0.0, 1.0}, {1.0, 1.0}, {2.0, 2.0}, {6.0, 0.0}});
    glide.glideTo(5.0, 6.0, 0.0);
    CHECK(glide.curve() == Curve{{0.0, 1.0}, {1.0, 1.0}, {2.0, 2.0}, {6.0, 0.0}, {6.0, 0.0}, {6.0, 5.0}});
}

TEST_CASE("Bends are those of both curves, and pieces where the second moves", "[scene]")
{
    const Curve a = {{0.0, 1.0}, {0.5, 1.0}, {3.0, 2.0}};
    const Curve b = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 1.0}, {2.0, 0.5}};
    CHECK(detail::bends(a, b, 4) == std::vector<double>{0.0, 0.5, 1.0, 1.25, 1.5, 1.75, 2.0, 3.0});
    CHECK(detail::bends({}, {{1.0, 0.0}, {2.0, 0.0}}, 2) == std::vector<double>{1.0, 2.0});
    CHECK(detail::bends(a, b, 1) == std::vector<double>{0.0, 0.5, 1.0, 2.0, 3.0});
    CHECK(detail::bends({}, {{0.0, 0.0}, {1.0, 2.0}}, 2) == std::vector<double>{0.0, 0.5, 1.0});
    CHECK(detail::bends(a, {}, 4) == std::vector<double>{0.0, 0.5, 3.0});
}

TEST_CASE("Both sides of a step are told, that before it from a nanosecond earlier", "[scene]")
{
    const auto step = [](double at)
    {
        return at < 1.0 - 1.5e-9 ? 9.0 : at < 1.0 - 0.7e-9 ? 2.0 : 3.0;
    };
    Curve curve;
    detail::appendSides(curve, 1.0, step);
    REQUIRE(curve.size() == 2);
    CHECK(curve[0] == Breakpoint{1.0, 2.0});
    CHECK(curve[1] == Breakpoint{1.0, 3.0});
    detail::appendSides(curve, 2.0, step);
    CHECK(curve.size() == 3);
    curve.clear();
    // Less than a millionth is no step, and there is nothing before the start.
    detail::appendSides(curve, 1.0, [](double at) { return at < 1.0 ? 2.0 : 2.0 + 0.9e-6; });
    CHECK(curve.size() == 1);
    detail::appendSides(curve, 1.0, [](double at) { return at < 1.0 ? 2.0 : 2.0 + 1.1e-6; });
    CHECK(curve.size() == 3);
    curve.clear();
    detail::appendSides(curve, 1e-9, [](double at) { return at < 1e-9 ? 0.0 : 1.0; });
    CHECK(curve.size() == 1);
    detail::appendSides(curve, 1.1e-9, [](double at) { return at < 1e-9 ? 0.0 : 1.0; });
    CHECK(curve.size() == 3);
}

TEST_CASE("A pan follows its cosine within -80 dB on the way", "[scene]")
{
    for (const int actuators : {2, 5})
    {
        Scene scene = placedScene(PanLaw::constantPower, actuators, 0.0);
        scene.gain = 0.0;
        scene.plays[0].gain = 0.0;
        scene.changes = {{1.0, 0, SceneParameter::pan, 1.0, 2.0}};
        const PlayTimeline timeline = timelineOf(scene);
        for (std::size_t a = 0; a < timeline.gains.size(); ++a)
        {
            const Curve& curve = timeline.gains[a];
            CHECK(curve.size() == static_cast<std::size_t>(64 * (actuators - 1) + 2));
            for (double time = 0.5; time < 3.5; time += 0.00137)
            {
                const double pan = std::clamp((time - 1.0) / 2.0, 0.0, 1.0);
                CHECK(std::abs(valueAt(curve, time) -
                               panGain(PanLaw::constantPower, pan, a, static_cast<std::size_t>(actuators))) < 1.1e-4);
            }
        }
    }
    Scene scene = placedScene(PanLaw::delay, 2, 0.0);
    scene.changes = {{1.0, 0, SceneParameter::pan, 1.0, 2.0}};
    const PlayTimeline timeline = timelineOf(scene);
    REQUIRE(timeline.delays.size() == 2);
    for (double time = 0.0; time < 4.0; time += 0.05)
    {
        const double pan = std::clamp((time - 1.0) / 2.0, 0.0, 1.0);
        CHECK(valueAt(timeline.delays[0], time) == Approx(0.03 * pan).margin(1e-12));
        CHECK(valueAt(timeline.delays[1], time) == Approx(0.03 * (1.0 - pan)).margin(1e-12));
    }
}

TEST_CASE("Changes of pitch and speed keep each other, in seconds from the start of the play", "[scene]")
{
    Scene scene = placedScene(PanLaw::both, 2, 0.5);
    scene.plays[0].start = 1.0;
    scene.plays[0].transposition = 3.0;
    scene.plays[0].stretch = 2.0;
    scene.changes = {{0.5, 0, SceneParameter::transposition, 5.0, 0.0},
                     {1.5, 0, SceneParameter::stretch, 4.0, 0.0},
                     {1.7, 0, SceneParameter::gain, -3.0, 0.1},
                     {2.0, 0, SceneParameter::transposition, -7.0, 0.0}};
    const PlayTimeline timeline = timelineOf(scene);
    CHECK(timeline.changes == std::vector<DecoderChange>{{0.0, 5.0, 2.0}, {0.5, 5.0, 4.0}, {1.0, -7.0, 4.0}});
    const DecoderChange usual;
    CHECK(usual.time == 0.0);
    CHECK(usual.transposition == 0.0);
    CHECK(usual.stretch == 1.0);
}

TEST_CASE("Timelines of gains and pans that change at once are what they were", "[scene]")
{
    for (const PanLaw law : {PanLaw::constantPower, PanLaw::delay, PanLaw::both})
        for (const int actuators : {1, 2, 4})
        {
            Scene scene = placedScene(law, actuators, 0.3);
            scene.changes = {{0.1, 0, SceneParameter::gain, -20.0, 0.05},
                             {0.12, 0, SceneParameter::pan, 1.0, 0.3},
                             {0.3, 0, SceneParameter::gain, 3.0, 0.0},
                             {0.35, 0, SceneParameter::pan, 0.1, 0.0},
                             {0.5, 0, SceneParameter::gain, -130.0, 0.01}};
            const PlayTimeline timeline = timelineOf(scene);
            const std::string name = std::to_string(static_cast<int>(law)) + " to " + std::to_string(actuators);
            checkPinned("synthesis/timeline gains, law " + name, numbersOf(timeline.gains));
            if (!timeline.delays.empty())
                checkPinned("synthesis/timeline delays, law " + name, numbersOf(timeline.delays));
        }
}

TEST_CASE("A variation draws one factor for each point or each band, the same on every machine", "[synthesis]")
{
    Clip clip;
    clip.duration = 1.0;
    for (int k = 0; k < 3; ++k)
        clip.bands.push_back({80.0, 100.0, 120.0, 0, {{0.0, 1.0}, {0.3, 0.5}, {0.6, 2.0}}, {{0.0, 90.0}}});
    clip.envelope = {{0.0, 0.5}};
    for (const VariationScope scope : {VariationScope::breakpoint, VariationScope::band})
    {
        Random random(77);
        Clip wanted = clip;
        for (Band& band : wanted.bands)
        {
            double factor = random.uniform(0.6, 1.4);
            for (Breakpoint& point : band.amplitude)
                point.value *= scope == VariationScope::breakpoint ? random.uniform(0.6, 1.4) : factor;
        }
        const Clip varied = vary(clip, {0.4, scope, 77});
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 3; ++i)
                CHECK(varied.bands[k].amplitude[i].value == Approx(wanted.bands[k].amplitude[i].value));
        CHECK(varied.envelope == clip.envelope);
        CHECK(varied.bands[0].pitch == clip.bands[0].pitch);
        // The amount ends at 0 and 1.
        CHECK(vary(clip, {-0.5, scope, 77}) == clip);
        CHECK(vary(clip, {3.0, scope, 77}) == vary(clip, {1.0, scope, 77}));
        CHECK_FALSE(vary(clip, {1.0, scope, 77}) == vary(clip, {0.9, scope, 77}));
        CHECK_FALSE(vary(clip, {1.0, scope, 77}) == clip);
    }
    const VariationParams usual;
    CHECK(usual.amount == 0.0);
    CHECK(usual.scope == VariationScope::breakpoint);
    CHECK(usual.seed == 0);
}
