#include "io/SceneFile.h"

#include "io/ClipFile.h"
#include "io/SceneJson.h"
#include "io/TextureFile.h"
#include "io/formats/json/ClipJson.h"
#include "support/Catch.h"
#include "support/RandomScene.h"
#include "support/TempFolder.h"

#include <cmath>
#include <optional>
#include <string>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// Clips called a.pacb and folder/b.json, and none else.
Result<Clip> twoClips(const std::string& file)
{
    if (file == "a.pacb")
        return sceneClip(3);
    if (file == "folder/b.json")
        return sceneClip(4);
    return Error{ErrorCode::io, "", "does not exist"};
}

const std::string head = R"({"format": "pacini.scene", "version": 1, )";

Scene sceneOf(const std::string& members)
{
    const auto scene = readSceneJson(head + members + "}", twoClips);
    INFO(members);
    INFO((scene.ok() ? "" : scene.error().text()));
    REQUIRE(scene.ok());
    return *scene;
}

std::string whereOf(const std::string& members)
{
    INFO(members);
    const auto scene = readSceneJson(head + members + "}", twoClips);
    REQUIRE_FALSE(scene.ok());
    CHECK(scene.error().message.size() > 5);
    return scene.error().where;
}
} // namespace

TEST_CASE("A play of a texture names it by index, name or file, and lasts as long as it says", "[io][scene]")
{
    Texture wood;
    wood.name = "wood";
    wood.nodes.push_back({0.5, 0.1, {-0.5}});
    const std::string embedded = R"({"texture": )" + textureJson(wood) + "}";
    const auto file = [&](const std::string& name) -> Result<Texture>
    {
        if (name == "sub/wood.texture.json")
            return wood;
        return Error{ErrorCode::io, "", "does not exist"};
    };
    const auto read = [&](const std::string& members)
    {
        return readSceneJson(head + members + "}", twoClips, nullptr, file);
    };
    for (
        const std::string& members :
        {R"("textures": [)" + embedded + R"(], "plays": [{"texture": 0, "duration": 2, "speed": 0.2}])",
         R"("textures": [)" + embedded + R"(], "plays": [{"texture": "wood", "duration": 2, "speed": 0.2}])",
         std::string(R"("plays": [{"texture": "sub/wood.texture.json", "duration": 2, "speed": 0.2}])"),
         std::string(
             R"("textures": ["sub/wood.texture.json"], "plays": [{"texture": "wood.texture.json", "duration": 2, "speed": 0.2}])")})
    {
        INFO(members);
        const auto scene = read(members + R"(, "changes": [{"time": 1, "play": 0, "parameter": "speed", "value": 1}])");
        INFO((scene.ok() ? "" : scene.error().text()));
        REQUIRE(scene.ok());
        REQUIRE(scene->plays.size() == 1);
        CHECK(scene->plays[0].texture == std::optional<std::size_t>(0));
        CHECK(scene->plays[0].speed == 0.2);
        CHECK(scene->plays[0].force == 1.0);
        CHECK(scene->clips.at(scene->plays[0].clip).duration == 2.0);
        CHECK(scene->textures == std::vector<Texture>{wood});
        CHECK(scene->changes[0].parameter == SceneParameter::speed);
    }
    const auto where = [&](const std::string& members)
    {
        const auto scene = read(members);
        REQUIRE_FALSE(scene.ok());
        return scene.error().where;
    };
    CHECK(where(R"("plays": [{}])") == "plays[0].clip");
    CHECK(where(R"("plays": [{"texture": 0, "duration": 1}])") == "plays[0].texture");
    CHECK(where(R"("plays": [{"texture": "none", "duration": 1}])") == "plays[0].texture");
    CHECK(where(R"("plays": [{"texture": "sub/wood.texture.json"}])") == "plays[0].duration");
    CHECK(where(R"("plays": [{"texture": "sub/wood.texture.json", "duration": -1}])") == "plays[0].duration");
    CHECK(where(R"("plays": [{"clip": "a.pacb", "duration": 1}])") == "plays[0].duration");
    CHECK(where(R"("plays": [{"clip": "a.pacb", "texture": "sub/wood.texture.json"}])") == "plays[0].texture");
    CHECK(where(R"("plays": [{"texture": "sub/wood.texture.json", "duration": 1, "speed": 2}])") == "plays[0].speed");
    CHECK(where(R"("textures": [{"file": "none"}])") == "textures[0]");
    CHECK(where(R"("textures": [{}])") == "textures[0]");
    CHECK(where(R"("textures": [{"texture": {"format": "pacini.texture", "version": 1, "pitch": 1, "levelBySpeed": 1,
        "levelByForce": 1, "nodes": [{"speed": 1, "level": 1, "reflection": [{}]}]}}])") ==
          "textures[0].texture.nodes[0].reflection[0]");
    // Where no files are read.
    CHECK(whereOf(R"("plays": [{"texture": "sub/wood.texture.json", "duration": 1}])") == "plays[0].texture");
}

TEST_CASE("A scene that is written and read is the same scene", "[io][scene]")
{
    const TempFolder folder;
    for (std::uint64_t seed = 1; seed <= 30; ++seed)
    {
        CAPTURE(seed);
        const Scene scene = seed % 3 == 0 ? texturedScene(seed) : randomScene(seed);
        REQUIRE(validate(scene).ok());
        const std::string text = writeSceneJson(scene);
        const auto read = readSceneJson(text, twoClips);
        INFO((read.ok() ? "" : read.error().text()));
        REQUIRE(read.ok());
        CHECK((*read == scene));
        CHECK(writeSceneJson(*read) == text);
        const auto path = folder / "x.scene.json";
        const auto bytes = writeScene(path, scene);
        REQUIRE(bytes.ok());
        CHECK(*bytes == text.size());
        const auto again = readScene(path);
        REQUIRE(again.ok());
        CHECK((*again == scene));
    }
    Scene tooWide;
    tooWide.actuators = 99;
    CHECK_FALSE(writeScene(folder / "no.json", tooWide).ok());
    CHECK(folder.entries() == 1);
}

TEST_CASE("Only the clip of a play is needed", "[io][scene]")
{
    const Scene scene = sceneOf(R"("plays": [{"clip": "a.pacb"}])");
    CHECK((scene.plays == std::vector<ScenePlay>{ScenePlay{}}));
    CHECK((scene.clips == std::vector<Clip>{sceneClip(3)}));
    CHECK(scene.actuators == 1);
    CHECK(
        (sceneOf(R"("unknown": {"clips": [1, {"x": null}]}, "plays": [{"clip": "a.pacb", "colour": [[]]}])") == scene));
    CHECK((sceneOf("\"name\": \"empty\"").plays.empty()));
}

TEST_CASE("A play names its clip by index, file, file name or name", "[io][scene]")
{
    const std::string embedded = writeClipJson(sceneClip(7));
    const std::string clips = R"("clips": ["a.pacb", {"file": "folder/b.json"}, {"clip": )" + embedded + "}], ";
    const auto clipOfPlay = [&](const std::string& reference)
    {
        const Scene scene = sceneOf(clips + R"("plays": [{"clip": )" + reference + "}]");
        CHECK(scene.clips.size() == 3);
        return scene.plays[0].clip;
    };
    CHECK(clipOfPlay("1") == 1);
    CHECK(clipOfPlay("\"a.pacb\"") == 0);
    CHECK(clipOfPlay("\"./a.pacb\"") == 0);
    CHECK(clipOfPlay("\"folder/b.json\"") == 1);
    CHECK(clipOfPlay("\"b.json\"") == 1);
    CHECK(clipOfPlay("\"clip 4\"") == 1);
    CHECK(clipOfPlay("\"clip 7\"") == 2);
    CHECK(whereOf(clips + R"("plays": [{"clip": 0}, {"clip": 3}])") == "plays[1].clip");
    CHECK(whereOf(clips + R"("plays": [{"clip": 0.5}])") == "plays[0].clip");
    CHECK(whereOf(clips + R"("plays": [{"clip": "c.pacb"}])") == "plays[0].clip");
    // Two clips of one name: it would be a guess which is meant.
    CHECK(whereOf(R"("clips": [{"clip": )" + embedded + R"(}, {"clip": )" + embedded +
                  R"(}], "plays": [{"clip": "clip 7"}])") == "plays[0].clip");
}

TEST_CASE("A clip file is read once, however often a scene names it", "[io][scene]")
{
    int reads = 0;
    const auto counting = [&](const std::string& file)
    {
        ++reads;
        return twoClips(file);
    };
    const auto scene = readSceneJson(head + R"("clips": ["a.pacb", "folder/b.json", {"file": "./a.pacb"}],
        "plays": [{"clip": 2}, {"clip": "a.pacb"}, {"clip": 1}, {"clip": "folder/../a.pacb"}]})",
                                     counting);
    REQUIRE(scene.ok());
    CHECK(reads == 2);
    CHECK(scene->clips.size() == 2);
    CHECK(scene->plays[0].clip == 0);
    CHECK(scene->plays[2].clip == 1);
    CHECK(scene->plays[3].clip == 0);
}

TEST_CASE("A loop of true is the whole clip, a variation may be just a number, plays are changed by name",
          "[io][scene]")
{
    const Scene scene = sceneOf(R"("duration": 9,
        "plays": [{"clip": "a.pacb", "name": "rain", "loop": true, "variation": 0.3},
                  {"clip": "a.pacb", "name": "hit", "loop": false,
                   "variation": {"amount": 0.2, "scope": "band", "seed": "18446744073709551615"}}],
        "changes": [{"time": 1, "play": "hit", "parameter": "pan", "value": 1},
                    {"time": 1, "play": 0, "parameter": "stretch", "value": 2, "glide": 0}])");
    CHECK(scene.plays[0].loop == scene.clips[0].duration);
    CHECK(scene.plays[1].loop == 0.0);
    CHECK((scene.plays[0].variation == VariationParams{0.3, VariationScope::breakpoint, 0}));
    CHECK((scene.plays[1].variation == VariationParams{0.2, VariationScope::band, ~std::uint64_t(0)}));
    CHECK((scene.changes[0] == SceneChange{1.0, 1, SceneParameter::pan, 1.0, 0.005}));
    CHECK((scene.changes[1] == SceneChange{1.0, 0, SceneParameter::stretch, 2.0, 0.0}));
}

TEST_CASE("A play has levels of its clip's roles in dB, which change over time", "[io][scene]")
{
    const Scene scene = sceneOf(R"("plays": [{"clip": "a.pacb", "tones": -6, "noise": -120}],
        "changes": [{"time": 1, "play": 0, "parameter": "tones", "value": 0, "glide": 0.5},
                    {"time": 2, "play": 0, "parameter": "events", "value": 3},
                    {"time": 3, "play": 0, "parameter": "noise", "value": -3}])");
    CHECK(scene.plays[0].tones == -6.0);
    CHECK(scene.plays[0].events == 0.0);
    CHECK(scene.plays[0].noise == -120.0);
    CHECK((scene.changes[0] == SceneChange{1.0, 0, SceneParameter::tones, 0.0, 0.5}));
    CHECK((scene.changes[1] == SceneChange{2.0, 0, SceneParameter::events, 3.0, 0.005}));
    CHECK((scene.changes[2] == SceneChange{3.0, 0, SceneParameter::noise, -3.0, 0.005}));
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "noise": 61}])") == "plays[0].noise");
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "tones": "loud"}])") == "plays[0].tones");
}

TEST_CASE("A bad scene is refused with its place", "[io][scene]")
{
    CHECK(whereOf(R"("plays": 1)") == "plays");
    CHECK(whereOf(R"("plays": {})") == "plays");
    CHECK(whereOf(R"("plays": [1])") == "plays[0]");
    CHECK(whereOf(R"("plays": ["a.pacb"])") == "plays[0]");
    CHECK(whereOf(R"("plays": [{}])") == "plays[0].clip");
    CHECK(whereOf(R"("plays": [{"clip": null}])") == "plays[0].clip");
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "start": "now"}])") == "plays[0].start");
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "start": -1}])") == "plays[0].start");
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "start": 1, "start": 2}])") == "plays[0].start");
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "loop": "yes"}])") == "plays[0].loop");
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "loop": true}])") == "plays[0].passes");
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "passes": 0.5}])") == "plays[0].passes");
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "passes": 1e300}])") == "plays[0].passes");
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "priority": 1e12}])") == "plays[0].priority");
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "pan": 2}])") == "plays[0].pan");
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "variation": []}])") == "plays[0].variation");
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "variation": {"scope": "note"}}])") == "plays[0].variation.scope");
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "variation": {"seed": "1x"}}])") == "plays[0].variation.seed");
    CHECK(whereOf(R"("plays": [{"clip": "a.pacb", "variation": 2}])") == "plays[0].variation");
    CHECK(whereOf(R"("actuators": 2.5)") == "actuators");
    CHECK(whereOf(R"("actuators": 17)") == "actuators");
    CHECK(whereOf(R"("panLaw": "loud")") == "panLaw");
    CHECK(whereOf(R"("gain": true)") == "gain");
    CHECK(whereOf(R"("duration": 1e999)") == "duration");
    CHECK(whereOf(R"("duration": NaN)") == "line 1, column 54");
    CHECK(whereOf(R"("clips": [{}])") == "clips[0]");
    CHECK(whereOf(R"("clips": [{"file": "a.pacb", "clip": {"format": "pacini.clip", "version": 1, "duration": 0,
        "bands": []}}])") == "clips[0]");
    CHECK(whereOf(R"("clips": [7])") == "clips[0]");
    CHECK(whereOf(R"("clips": [""])") == "clips[0]");
    CHECK(whereOf(R"("clips": ["a.pacb", "no.pacb"])") == "clips[1]");
    CHECK(whereOf(R"("clips": [{"clip": []}])") == "clips[0].clip");
    CHECK(whereOf(R"("clips": [{"clip": {"format": "pacini.clip", "version": 2}}])") == "clips[0].clip.version");
    CHECK(whereOf(R"("clips": [{"clip": {"format": "pacini.clip", "version": 1, "bands": []}}])") ==
          "clips[0].clip.duration");
    CHECK(whereOf(R"("clips": [{"clip": {"format": "pacini.clip", "version": 1, "duration": 0, "bands": [],
        "envelope": [{"time": 3, "amplitude": 0}]}}])") == "clips[0].clip.envelope[0].time");
    const std::string play = R"("plays": [{"clip": "a.pacb", "name": "x"}, {"clip": "a.pacb", "name": "x"}], )";
    CHECK(whereOf(play + R"("changes": [{}])") == "changes[0].time");
    const auto change = [&](const std::string& members)
    {
        return play + R"("changes": [{"time": 1, "parameter": "gain", "value": 0, )" + members + "}]";
    };
    CHECK(whereOf(change(R"("play": 2)")) == "changes[0].play");
    CHECK(whereOf(change(R"("play": "y")")) == "changes[0].play");
    CHECK(whereOf(change(R"("play": "x")")) == "changes[0].play"); // two are called so
    CHECK(whereOf(change(R"("play": 0, "glide": -1)")) == "changes[0].glide");
    CHECK(whereOf(play + R"("changes": [{"time": 1, "play": 0, "parameter": "rate", "value": 0}])") ==
          "changes[0].parameter");

    const auto errorOf = [](const std::string& text)
    {
        const auto scene = readSceneJson(text, twoClips);
        REQUIRE_FALSE(scene.ok());
        return scene.error();
    };
    CHECK(errorOf(R"({"format": "pacini.scene", "version": 2})").code == ErrorCode::unsupportedVersion);
    CHECK(errorOf(R"({"format": "pacini.scene"})").where == "version");
    CHECK(errorOf(R"({"version": 1})").where == "format");
    CHECK(errorOf(R"({"format": "pacini.clip", "version": 1})").where == "format");
    CHECK(errorOf("[]").message.find("object") != std::string::npos);
    CHECK(errorOf(head + R"("x": )" + std::string(100'000, '[')).code == ErrorCode::tooLarge);
}

TEST_CASE("Absurd counts are refused as they come", "[io][scene]")
{
    const auto repeated = [](const std::string& name, const std::string& item, std::size_t count)
    {
        std::string text = head + "\"" + name + "\": [";
        for (std::size_t i = 0; i < count; ++i)
            text += (i > 0 ? "," : "") + item;
        return text;
    };
    // None of the texts is closed: more is not looked at.
    for (const auto& [name, item, count] :
         {std::tuple("plays", R"({"clip":0})", 10'001u), std::tuple("clips", "\"a.pacb\"", 10'001u),
          std::tuple("changes", R"({"time":0,"play":0,"parameter":"gain","value":0})", 1'000'001u)})
    {
        const auto scene = readSceneJson(repeated(name, item, count), twoClips);
        REQUIRE_FALSE(scene.ok());
        CHECK(scene.error().code == ErrorCode::tooLarge);
        std::string last = name;
        last.append("[").append(std::to_string(count - 1)).append("]");
        CHECK(scene.error().where == last);
    }
}

TEST_CASE("Clip files are found beside the scene, or in a folder that is named", "[io][scene]")
{
    const TempFolder folder;
    std::filesystem::create_directories(folder / "scenes");
    std::filesystem::create_directories(folder / "clips");
    REQUIRE(writeClip(folder / "clips" / "door.pacb", sceneClip(5), packedFormat()).ok());
    const auto path = put(folder / "scenes" / "a.json", head + R"("plays": [{"clip": "../clips/door.pacb"}]})");
    CHECK(readScene(path).ok());
    const auto bare = put(folder / "scenes" / "b.json", head + R"("clips": ["door.pacb"]})");
    CHECK(readScene(bare, folder / "clips").ok());
    const auto missing = readScene(bare);
    REQUIRE_FALSE(missing.ok());
    CHECK(missing.error().where == "clips[0]");
    CHECK(missing.error().message.find("door.pacb: does not exist") == 0);
    put(folder / "scenes" / "door.pacb", "PACBroken");
    CHECK(readScene(bare).error().message.find("door.pacb: ") == 0);
    CHECK_FALSE(readScene(folder / "none.json").ok());
}

TEST_CASE("What is rendered is a scene when its format says so", "[io][scene]")
{
    const TempFolder folder;
    REQUIRE(writeClip(folder / "clip.json", sceneClip(5), jsonFormat()).ok());
    REQUIRE(writeClip(folder / "clip.pacb", sceneClip(5), packedFormat()).ok());
    REQUIRE(writeScene(folder / "scene", randomScene(2)).ok());
    put(folder / "late.json", R"({"nested": {"format": "pacini.clip"}, "version": 1, "format": "pacini.scene"})");
    CHECK(readClipOrScene(folder / "clip.json")->content.index() == 0);
    CHECK(readClipOrScene(folder / "clip.pacb")->content.index() == 0);
    CHECK(readClipOrScene(folder / "scene")->content.index() == 1);
    CHECK(readClipOrScene(folder / "late.json")->content.index() == 1);
    put(folder / "other.json", R"({"format": "pacini.profile", "version": 1})");
    CHECK(readClipOrScene(folder / "other.json").error().where == "format");
    CHECK_FALSE(readClipOrScene(folder / "none").ok());
}
