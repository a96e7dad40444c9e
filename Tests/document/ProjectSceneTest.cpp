// Scenes of projects: what they become, and what files keep of them.

#include "document/ProjectScene.h"

#include "document/Document.h"
#include "document/ProjectJson.h"
#include "io/SceneJson.h"
#include "support/Catch.h"

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
    const int first = document.addClip(hum("first", 2.0)).value();
    const int second = document.addClip(hum("second", 1.0)).value();
    ProjectScene scene;
    scene.actuators = 3;
    scene.panLaw = PanLaw::both;
    scene.parts = {{.clip = first, .start = 0.5, .gain = -6.0, .pan = 0.25},
                   {.clip = second, .track = 1, .start = 1.0, .transposition = 3.0, .delay = 0.1, .priority = 2},
                   {.clip = first, .track = 1, .start = 3.0}};
    scene.parts[2].curves = {{SceneParameter::pan, {{0.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}}},
                             {SceneParameter::transposition, {{0.0, 0.0}, {0.5, 12.0}}}};
    REQUIRE(document.setScene(scene, "Scene"));
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
    later.parts[2].delay = 0.25;
    Document moved = sceneDocument();
    REQUIRE(moved.setScene(later, "Delay"));
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
    REQUIRE(document.removeClip(first, "Remove"));
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
    REQUIRE(read);
    CHECK(read->project.scene == document.project().scene);
    CHECK(read->project == document.project());
    Document plain;
    REQUIRE(plain.addClip(hum("one", 1.0)));
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
        moved.parts[0].start = start;
        REQUIRE(document.setScene(moved, "Move", gesture));
    }
    CHECK(document.steps().size() == steps + 1);
    document.undo();
    CHECK(document.project().scene.parts[0].start == 0.5);
    ProjectScene bad = document.project().scene;
    bad.parts[1].pan = 2.0;
    const auto refused = document.setScene(bad, "Pan");
    REQUIRE_FALSE(refused);
    CHECK(refused.error().where == "parts[1].pan");
    CHECK(document.project().scene.parts[1].pan == 0.5);
}
