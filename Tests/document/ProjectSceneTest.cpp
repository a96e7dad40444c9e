// Scenes of projects: what they become, and what files keep of them.

#include "document/ProjectScene.h"

#include "document/Amendments.h"
#include "document/Document.h"
#include "document/ProjectEdits.h"
#include "document/ProjectJson.h"
#include "io/SceneJson.h"
#include "support/Catch.h"
#include "support/RandomScene.h"
#include "support/RandomTexture.h"

#include <pacini/synthesis/SceneTimeline.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>

using namespace pacini;

namespace
{
Clip hum(const std::string& name, double duration)
{
    Clip clip;
    clip.name = name;
    clip.duration = duration;
    clip.bands = {{80.0, 100.0, 120.0, 0, {{0.0, 0.5}, {duration, 0.5}}, {}}};
    return clip;
}

/// Two clips, three parts, one with curves.
Document sceneDocument()
{
    Document document;
    const int first = addClip(document, hum("first", 2.0)).value();
    const int second = addClip(document, hum("second", 1.0)).value();
    ProjectScene scene;
    scene.actuators = 3;
    scene.panLaw = PanLaw::both;
    scene.parts = {{.clip = first}, {.clip = second, .track = 1}, {.clip = first, .track = 1}};
    scene.parts[0].play.start = 0.5;
    scene.parts[0].play.gain = -6.0;
    scene.parts[0].play.pan = 0.25;
    scene.parts[1].play.start = 1.0;
    scene.parts[1].play.transposition = 3.0;
    scene.parts[1].play.priority = 2;
    scene.parts[1].play.delay = 0.1;
    scene.parts[2].play.start = 3.0;
    scene.parts[2].curves = {{SceneParameter::pan, {{0.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}}},
                             {SceneParameter::transposition, {{0.0, 0.0}, {0.5, 12.0}}}};
    REQUIRE(document.commit("Scene", withScene(document.project(), scene)));
    return document;
}
} // namespace

TEST_CASE("Parts of a scene become plays of their clips, and curves become changes that glide between their points")
{
    const Document document = sceneDocument();
    const auto [scene, parts] = sceneOf(document.project());
    REQUIRE(validate(scene));
    CHECK(scene.actuators == 3);
    CHECK(scene.clips.size() == 2);
    REQUIRE(scene.plays.size() == 3);
    CHECK(parts == std::vector<std::size_t>{0, 1, 2});
    CHECK(scene.plays[0].gain == -6.0);
    CHECK(scene.plays[1].transposition == 3.0);
    CHECK(scene.plays[1].delay == 0.1);
    CHECK(scene.plays[2].clip == scene.plays[0].clip);
    CHECK(scene.plays[2].pan == 0.0);
    REQUIRE(scene.changes.size() == 2);
    CHECK(scene.changes[0] == SceneChange{3.0, 2, SceneParameter::pan, 1.0, 1.0});
    CHECK(scene.changes[1] == SceneChange{3.5, 2, SceneParameter::transposition, 12.0, 0.0});
    // A part that comes later takes its curves along.
    ProjectScene later = document.project().scene;
    later.parts[2].play.delay = 0.25;
    Document moved = sceneDocument();
    REQUIRE(moved.commit("Delay", withScene(moved.project(), later)));
    CHECK(sceneOf(moved.project()).scene.changes[0].time == 3.25);
    // As `pacini render` reads it.
    const auto read = readSceneJson(writeSceneJson(scene),
                                    [](const std::string&) -> Result<Clip> {
                                        return Error{ErrorCode::io, "", "no files"};
                                    });
    REQUIRE(read);
    CHECK(*read == scene);
}

TEST_CASE("A part whose clip is removed stays, is not played, and plays again when that is undone")
{
    Document document = sceneDocument();
    const int first = document.project().clips.front()->id;
    REQUIRE(document.commit("Remove", withoutClips(document.project(), {first})));
    CHECK(document.project().scene.parts.size() == 3);
    const auto [scene, parts] = sceneOf(document.project());
    CHECK(scene.plays.size() == 1);
    CHECK(parts == std::vector<std::size_t>{1});
    document.undo();
    CHECK(sceneOf(document.project()).scene.plays.size() == 3);
}

TEST_CASE("Project files keep the scene, and old files have none")
{
    const Document document = sceneDocument();
    const std::string text = projectJson(document.project());
    const auto read = readProjectJson(text, {});
    CAPTURE(read ? "" : read.error().text());
    REQUIRE(read);
    CHECK(read->project.scene == document.project().scene);
    CHECK(read->project == document.project());
    // One of a version that did not know what is as usual here.
    auto json = nlohmann::json::parse(text);
    for (const char* key : {"duration", "gain", "panDelay"})
        json["scene"].erase(key);
    for (auto& part : json["scene"]["parts"])
        for (const char* key : {"passes", "loop", "stretch", "tones", "events", "noise"})
            CHECK(part.erase(key) == 1);
    const std::string older = json.dump();
    const auto old = readProjectJson(older, {});
    REQUIRE(old);
    CHECK(old->project.scene == document.project().scene);
    Document plain;
    REQUIRE(addClip(plain, hum("one", 1.0)));
    CHECK(projectJson(plain.project()).find("\"scene\"") == std::string::npos);
    for (const auto& [from, to, where] : {std::tuple("\"actuators\": 3", "\"actuators\": 99", "scene.actuators"),
                                          {"\"clipId\": 1", "\"clipId\": -1", "scene.parts[0].clipId"},
                                          {"\"start\": 0.5", "\"start\": -1", "scene.parts[0].start"}})
    {
        std::string bad = text;
        const auto at = bad.find(from);
        CAPTURE(from);
        REQUIRE(at != std::string::npos);
        bad.replace(at, std::string(from).size(), to);
        const auto refused = readProjectJson(bad, {});
        REQUIRE_FALSE(refused);
        CHECK(refused.error().where == where);
    }
}

TEST_CASE("A gesture over the scene is one step, and a scene that is not valid changes nothing")
{
    Document document = sceneDocument();
    const std::size_t steps = document.steps().size();
    const Gesture gesture = document.beginGesture();
    for (const double start : {0.6, 0.7, 0.8})
    {
        ProjectScene moved = document.project().scene;
        moved.parts[0].play.start = start;
        REQUIRE(document.commit("Move", withScene(document.gestureStart(gesture), moved), gesture));
    }
    CHECK(document.steps().size() == steps + 1);
    document.undo();
    CHECK(document.project().scene.parts[0].play.start == 0.5);
    ProjectScene bad = document.project().scene;
    bad.parts[1].play.pan = 2.0;
    const auto refused = document.commit("Pan", withScene(document.project(), bad));
    REQUIRE_FALSE(refused);
    CHECK(refused.error().where == "parts[1].pan");
    CHECK(document.project().scene.parts[1].play.pan == 0.5);
}

TEST_CASE("Scenes of any shape become parts that play as they did")
{
    for (std::uint64_t seed = 1; seed <= 60; ++seed)
    {
        CAPTURE(seed);
        Scene scene = test::randomScene(seed);
        if (seed % 3 == 0) // some without an end of their own
        {
            scene.duration = 0.0;
            for (ScenePlay& play : scene.plays)
                play.passes = std::max<std::size_t>(1, play.passes);
        }
        Document document;
        REQUIRE(openScene(document, scene, "scene", "Open scene"));
        const Project& project = document.project();
        CHECK(project.clips.size() == scene.clips.size());
        CHECK(project.clips.front()->group == "scene");
        const Scene again = sceneOf(project).scene;
        REQUIRE(validate(again));
        REQUIRE(again.plays.size() == scene.plays.size());
        const SceneTimeline before = timelineOf(scene), after = timelineOf(again);
        CHECK(after.duration == Approx(before.duration));
        for (std::size_t i = 0; i < scene.plays.size(); ++i)
        {
            CAPTURE(i);
            const ScenePlay &was = scene.plays[i], &is = again.plays[i];
            CHECK(again.clips[is.clip] == scene.clips[was.clip]);
            CHECK(is.name == was.name);
            CHECK(is.variation == was.variation);
            CHECK(is.loop == was.loop);
            const TimedPlay &old = before.plays[i], &now = after.plays[i];
            CHECK(now.end == Approx(old.end).margin(1e-6));
            for (double time = is.start + is.delay; time < old.end; time += 0.037)
            {
                CAPTURE(time);
                CHECK(valueAt(now.timeline.level, time) == Approx(valueAt(old.timeline.level, time)).margin(1e-9));
                if (!old.timeline.delay.empty())
                    CHECK(valueAt(now.timeline.delay, time) == Approx(valueAt(old.timeline.delay, time)).margin(1e-9));
                for (std::size_t a = 0; a < old.timeline.gains.size(); ++a)
                    CHECK(valueAt(now.timeline.gains[a], time) ==
                          Approx(valueAt(old.timeline.gains[a], time)).margin(1e-4));
            }
        }
        // No two parts lie over each other, and files keep all of it.
        const auto& parts = project.scene.parts;
        for (std::size_t i = 0; i < parts.size(); ++i)
            for (std::size_t k = 0; k < i; ++k)
                if (parts[i].track == parts[k].track)
                    CHECK((parts[i].play.start + lengthOf(project, parts[i]) <= parts[k].play.start + 1e-9 ||
                           parts[k].play.start + lengthOf(project, parts[k]) <= parts[i].play.start + 1e-9));
        const auto read = readProjectJson(projectJson(project), {});
        REQUIRE(read);
        CHECK(read->project.scene == project.scene);
    }
}

TEST_CASE("Scenes with textures become parts that play them as they did, and come back from project and scene files")
{
    for (std::uint64_t seed = 1; seed <= 30; ++seed)
    {
        CAPTURE(seed);
        const Scene scene = test::texturedScene(seed);
        REQUIRE(validate(scene));
        Document document;
        REQUIRE(openScene(document, scene, "scene", "Open scene"));
        const auto read = readProjectJson(projectJson(document.project()), {});
        CAPTURE(read ? "" : read.error().text());
        REQUIRE(read);
        CHECK(read->project == document.project());
        const Scene again = sceneOf(read->project).scene;
        REQUIRE(validate(again));
        CHECK(again.textures == scene.textures);
        REQUIRE(again.plays.size() == scene.plays.size());
        const SceneTimeline before = timelineOf(scene), after = timelineOf(again);
        for (std::size_t i = 0; i < scene.plays.size(); ++i)
        {
            CAPTURE(i);
            CHECK(again.plays[i].texture == scene.plays[i].texture);
            CHECK(again.plays[i].variation == scene.plays[i].variation);
            const TimedPlay &old = before.plays[i], &now = after.plays[i];
            CHECK(now.end == Approx(old.end).margin(1e-6));
            if (!scene.plays[i].texture)
                continue;
            for (double time = old.start; time < old.end; time += 0.037)
            {
                CHECK(valueAt(now.timeline.speed, time) == Approx(valueAt(old.timeline.speed, time)).margin(1e-9));
                CHECK(valueAt(now.timeline.force, time) == Approx(valueAt(old.timeline.force, time)).margin(1e-9));
            }
        }
    }
}

TEST_CASE("A texture plays instead of its clip when something is drawn in that, and a project names a wrong one")
{
    Document document = sceneDocument(); // clips that sound
    ProjectScene scene = document.project().scene;
    scene.textures.push_back({std::make_shared<const Texture>(test::randomTexture(1))});
    scene.parts[1].play.texture = 0;
    scene.parts[1].play.speed = 0.25;
    scene.parts[1].curves = {{SceneParameter::speed, {{0.0, 0.2}, {0.5, 1.0}}}};
    REQUIRE(document.commit("Texture", withScene(document.project(), scene)));
    const Scene built = sceneOf(document.project()).scene;
    REQUIRE(validate(built));
    CHECK(isSilent(built.clips[built.plays[1].clip]));
    CHECK(built.clips[built.plays[1].clip].duration == 1.0);
    CHECK_FALSE(isSilent(built.clips[built.plays[0].clip]));
    CHECK(built.changes.front() == SceneChange{1.1, 1, SceneParameter::speed, 1.0, 0.5});
    const std::string text = projectJson(document.project());
    for (const auto& [from, to, where] : {std::tuple("\"texture\": 0", "\"texture\": 1", "scene.parts[1].texture"),
                                          {"\"texture\": 0", "\"texture\": 0.5", "scene.parts[1].texture"},
                                          {"\"pitch\": ", "\"pitch\": 7", "scene.textures[0].pitch"}})
    {
        CAPTURE(to);
        std::string bad = text;
        const auto at = bad.find(from);
        REQUIRE(at != std::string::npos);
        bad.replace(at, std::string(from).size(), to);
        const auto refused = readProjectJson(bad, {});
        REQUIRE_FALSE(refused);
        CHECK(refused.error().where == where);
    }
}

TEST_CASE("A scene that is opened into another one takes its place until that is undone")
{
    Document document = sceneDocument();
    const ProjectScene before = document.project().scene;
    REQUIRE(openScene(document, test::randomScene(5), "other", "Open scene"));
    CHECK(document.project().clips.size() > 2);
    CHECK(document.project().scene != before);
    document.undo();
    CHECK(document.project().scene == before);
    CHECK(document.project().clips.size() == 2);
    // Into a project without one it has been there from the start, as sounds that are opened.
    Document begun;
    REQUIRE(openScene(begun, test::randomScene(5), "other", "Open scene"));
    CHECK_FALSE(begun.steps().canUndo());
    Scene bad = test::randomScene(5);
    bad.plays.front().pan = 2.0;
    CHECK_FALSE(openScene(begun, bad, "bad", "Open scene"));
}

TEST_CASE("Parts that are repeated last as long as their passes, and without end until the others end")
{
    Document document = sceneDocument(); // of 2 s and 1 s
    ProjectScene scene = document.project().scene;
    scene.parts[0].play.loop = limits::duration;
    scene.parts[0].play.passes = 3;
    scene.parts[1].play.loop = 0.5;
    scene.parts[1].play.stretch = 2.0;
    scene.parts.resize(2);
    REQUIRE(document.commit("Loops", withScene(document.project(), scene)));
    const Project& project = document.project();
    CHECK(lengthOf(project, project.scene.parts[0]) == 6.0);
    CHECK(sceneEnd(project) == 6.5);
    CHECK(lengthOf(project, project.scene.parts[1]) == Approx(6.5 - 1.1));
    const Scene built = sceneOf(project).scene;
    REQUIRE(validate(built));
    CHECK(built.plays[0].loop == 2.0);
    CHECK(built.duration == 6.5);
}
