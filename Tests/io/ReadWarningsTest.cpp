// Keys that no reader knows, and what they are meant to be.

#include "io/ReadWarnings.h"

#include "io/ClipFile.h"
#include "io/ProfileFile.h"
#include "io/SceneFields.h"
#include "io/SceneFile.h"
#include "io/SceneJson.h"
#include "io/formats/json/ClipJson.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/RandomScene.h"
#include "support/TempFolder.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

using namespace pacini;
using namespace pacini::test;

namespace
{
using Strings = std::vector<std::string>;

Result<Clip> anyFile(const std::string&)
{
    return sceneClip(3);
}

/// What reading a scene with these members warns of.
Strings sceneWarnings(const std::string& members)
{
    ReadWarnings warnings;
    const auto scene =
        readSceneJson(R"({"format": "pacini.scene", "version": 1, )" + members + "}", anyFile, &warnings);
    INFO((scene.ok() ? "" : scene.error().text()));
    REQUIRE(scene.ok());
    return warnings.texts();
}

const std::string clipStart = R"({"format": "pacini.clip", "version": 1, "duration": 1, )";

Strings clipWarnings(const std::string& members)
{
    ReadWarnings warnings;
    const auto clip = readClipJson(clipStart + members + "}", largestClipText, &warnings);
    REQUIRE(clip.ok());
    return warnings.texts();
}

/// The keys that the reader of scenes knows in a T.
template <typename T, typename Fields>
std::set<std::string> namesOf(Fields fields)
{
    const auto keys = FieldsHandler::keysOf<T>(fields);
    return {keys.begin(), keys.end()};
}

std::string textOf(const std::filesystem::path& path)
{
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The keys that a line of the documents' table of a scene lists, without the values in brackets.
std::set<std::string> keysInTable(const std::string& page, const std::string& lineStart)
{
    const auto begin = page.find("| " + lineStart);
    REQUIRE(begin != std::string::npos);
    std::string line = page.substr(begin, page.find('\n', begin) - begin);
    line = line.substr(line.find('|', 2)); // the second column
    line = std::regex_replace(line, std::regex(R"(\([^)]*\))"), "");
    std::set<std::string> keys;
    const std::regex key("`([A-Za-z]+)`");
    for (std::sregex_iterator it(line.begin(), line.end(), key), end; it != end; ++it)
        keys.insert((*it)[1]);
    return keys;
}

std::set<std::string> keysInSchema(const nlohmann::json& object)
{
    std::set<std::string> keys;
    for (const auto& [key, value] : object.at("properties").items())
        keys.insert(key);
    return keys;
}
} // namespace

TEST_CASE("A key that is unknown is named with its place and the nearest known one", "[io][keys]")
{
    CHECK(sceneWarnings(R"("plays": [{"clip": "a"}, {"clip": "b", "gian": -3}])") ==
          Strings{R"(plays[1].gian: is unknown; did you mean "gain"?)"});
    CHECK(sceneWarnings(R"("plays": [{"clip": "a", "speed": 2, "pitch": [1, {"gian": 3}], "Volume": 3}])") ==
          Strings{R"(plays[0].speed: is unknown; did you mean "stretch"?)",
                  R"(plays[0].pitch: is unknown; did you mean "transposition"?)",
                  R"(plays[0].Volume: is unknown; did you mean "gain"?)"});
    CHECK(sceneWarnings(R"("colour": "red")") == Strings{"colour: is unknown"});
    CHECK(sceneWarnings(R"("plays": [{"clip": "a", "name": "x", "variation": {"amount": 0.1, "sede": 3}}],
                          "changes": [{"time": 0, "play": 0, "parameter": "gain", "value": 1, "ramp": 2}])") ==
          Strings{R"(plays[0].variation.sede: is unknown; did you mean "seed"?)",
                  R"(changes[0].ramp: is unknown; did you mean "glide"?)"});
    CHECK(
        sceneWarnings(R"("clips": [{"clip": )" + clipStart + R"("bands": [], "event": 1}}], "plays": [{"clip": 0}])") ==
        Strings{R"(clips[0].clip.event: is unknown; did you mean "transients"?)"});
    CHECK(clipWarnings(R"("bands": [], "transients": [{"time": 0, "amplitude": 1, "sharpness": 1, "sharpnes": 2}])") ==
          Strings{R"(transients[0].sharpnes: is unknown; did you mean "sharpness"?)"});
    CHECK(clipWarnings(R"("bands": [], "encoder": {"anything": 1})").empty());
    CHECK(clipWarnings(R"("bands": [], "envelop": [{"time": 0}])") ==
          Strings{R"(envelop: is unknown; did you mean "envelope"?)"});

    ReadWarnings warnings;
    REQUIRE(readProfileJson(R"({"format": "pacini.profile", "version": 1, "name": "x", "technology": "lra",
        "resonance": {"frequency": 175, "Q": 8}, "drive": {"maxVoltage": 2}, "eq": [], "sources": {"any": "text"}})",
                            &warnings)
                .ok());
    CHECK(warnings.texts() == Strings{R"(resonance.Q: is unknown; did you mean "q"?)",
                                      R"(drive.maxVoltage: is unknown; did you mean "maxVoltageRms"?)",
                                      R"(eq: is unknown; did you mean "equalizer"?)"});
}

TEST_CASE("Keys that are remarks are nobody's mistake", "[io][keys]")
{
    CHECK(sceneWarnings(R"("$schema": "x", "_comment": "x", "//": "x", "plays": [{"clip": "a", "_gain": 1}])").empty());
}

TEST_CASE("A strict reader stops at the first key that is unknown", "[io][keys]")
{
    ReadWarnings strict(true);
    const auto scene =
        readSceneJson(R"({"format": "pacini.scene", "version": 1, "plays": [{"clip": "a", "gian": 1, "sped": 2}]})",
                      anyFile, &strict);
    REQUIRE_FALSE(scene.ok());
    CHECK(scene.error().text() == R"(plays[0].gian: is unknown; did you mean "gain"?)");
    CHECK(scene.error().code == ErrorCode::invalidData);
    const auto clip = readClipJson(clipStart + R"("bands": [], "nam": "x"})", largestClipText, &strict);
    REQUIRE_FALSE(clip.ok());
    CHECK(clip.error().where == "nam");
    const auto profile = readProfileJson(R"({"format": "pacini.profile", "version": 1, "name": "x",
        "technology": "lra", "resonance": {"frequency": 175, "quality": 8}})",
                                         &strict);
    REQUIRE_FALSE(profile.ok());
    CHECK(profile.error().text() == R"(resonance.quality: is unknown; did you mean "q"?)");
    CHECK(strict.texts().empty());
}

TEST_CASE("Of very many warnings the first are kept and the others counted, quickly", "[io][keys]")
{
    std::string text = clipStart + R"("bands": [], "envelope": [)";
    constexpr int count = 200'000;
    for (int i = 0; i < count; ++i)
        text += std::string(i > 0 ? "," : "") + R"({"time": 0.5, "amplitude": 0.1, "volumen": 1})";
    text += "]}";
    const auto timed = [&](ReadWarnings* warnings)
    {
        const auto start = std::chrono::steady_clock::now();
        REQUIRE(readClipJson(text, largestClipText, warnings).ok());
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    ReadWarnings warnings;
    const double without = timed(nullptr), with = timed(&warnings);
    const Strings all = warnings.texts();
    REQUIRE(all.size() == ReadWarnings::maxKept + 1);
    CHECK(all[1] == R"(envelope[1].volumen: is unknown; did you mean "amplitude"?)");
    CHECK(all.back() == "and " + std::to_string(count - 20) + " more of this kind");
    CHECK(with < 3.0 * without + 0.5);
}

TEST_CASE("Nearest keys are slips of the pen or other words, and nothing far-fetched", "[io][keys]")
{
    const std::vector<std::string_view> play{"name", "clip",          "start",   "loop",     "passes",   "gain",
                                             "pan",  "transposition", "stretch", "priority", "variation"};
    for (const auto& [given, meant] : std::vector<std::pair<std::string, std::string>>{{"gian", "gain"},
                                                                                       {"Gain", "gain"},
                                                                                       {"gains", "gain"},
                                                                                       {"volume", "gain"},
                                                                                       {"speed", "stretch"},
                                                                                       {"rate", "stretch"},
                                                                                       {"tempo", "stretch"},
                                                                                       {"strech", "stretch"},
                                                                                       {"pitch", "transposition"},
                                                                                       {"transpose", "transposition"},
                                                                                       {"semitones", "transposition"},
                                                                                       {"repeat", "loop"},
                                                                                       {"loops", "loop"},
                                                                                       {"repeats", "passes"},
                                                                                       {"count", "passes"},
                                                                                       {"delay", "start"},
                                                                                       {"strat", "start"},
                                                                                       {"panning", "pan"},
                                                                                       {"balance", "pan"},
                                                                                       {"prio", "priority"},
                                                                                       {"random", "variation"},
                                                                                       {"variaton", "variation"},
                                                                                       {"colour", ""},
                                                                                       {"x", ""},
                                                                                       {"", ""},
                                                                                       {"mute", ""},
                                                                                       {"enabled", ""},
                                                                                       {std::string(1000, 'g'), ""}})
    {
        CAPTURE(given);
        CHECK(nearestKey(given, play) == meant);
    }
}

TEST_CASE("What ships is known to the last key", "[io][keys]")
{
    for (const auto& entry : std::filesystem::directory_iterator(sourceFolder() / "profiles"))
    {
        CAPTURE(entry.path().string());
        ReadWarnings strict(true);
        CHECK((entry.path().extension() != ".json" || readProfile(entry.path(), &strict).ok()));
    }
    ReadWarnings strict(true);
    const auto scene = readSceneJson(textOf(sourceFolder() / "Resources/demo/workshop.scene.json"), anyFile, &strict);
    CHECK((scene.ok() ? "" : scene.error().text()) == "");
}

TEST_CASE("Any reader of clips and scenes tells of keys, those of a scene's clip files too", "[io][keys]")
{
    const TempFolder folder;
    const auto put = [&](const char* name, const std::string& text)
    {
        std::ofstream(folder / name) << text;
        return folder / name;
    };
    const auto clip = put("a.json", clipStart + R"("bands": [], "tranients": []})");
    CHECK(readClip(clip)->warnings == Strings{R"(tranients: is unknown; did you mean "transients"?)"});
    CHECK_FALSE(readClip(clip, true).ok());
    CHECK(readClip(clip, true).error().where == "tranients");
    const auto scene =
        put("s.json", R"({"format": "pacini.scene", "version": 1, "plays": [{"clip": "a.json", "tempo": 2}]})");
    const auto read = readClipOrScene(scene);
    REQUIRE(read.ok());
    CHECK(read->formatName() == "scene");
    CHECK(read->warnings == Strings{R"(plays[0].tempo: is unknown; did you mean "stretch"?)",
                                    R"(a.json: tranients: is unknown; did you mean "transients"?)"});
    CHECK_FALSE(readClipOrScene(scene, {{}, true}).ok());
    CHECK(readClip(scene).error().message.starts_with("is a scene"));
    // A scene may name clips of other programs.
    put("tap.ahap", R"({"Version": 1, "Pattern": [{"Event": {"Time": 0, "EventType": "HapticTransient"}}]})");
    const auto foreign =
        readClipOrScene(put("f.json", R"({"format": "pacini.scene", "version": 1, "plays": [{"clip": "tap.ahap"}]})"));
    REQUIRE(foreign.ok());
    CHECK(std::get<Scene>(foreign->content).clips[0].transients.size() == 1);
    CHECK(readClipOrScene(folder / "tap.ahap")->formatName() == "ahap");
}

TEST_CASE("The page about scenes lists every key, as the schema and the reader know them", "[io][keys]")
{
    const std::string page = textOf(sourceFolder() / "Resources/docs/scenes.md");
    const auto schema = nlohmann::json::parse(textOf(sourceFolder() / "Resources/schema/pacini.scene.schema.json"));
    CHECK(keysInTable(page, "the scene |") == namesOf<sceneFields::Draft>(sceneFields::document));
    CHECK(keysInTable(page, "an entry of `clips`") == namesOf<sceneFields::DraftClip>(sceneFields::clipEntry));
    auto playKeys = namesOf<sceneFields::DraftPlay>(sceneFields::playFields);
    CHECK(playKeys.count("speed") == 0);
    playKeys.insert({"speed", "force"}); // of plays of textures
    CHECK(keysInTable(page, "a play |") == playKeys);
    CHECK(keysInTable(page, "a `variation`") == namesOf<VariationParams>(sceneFields::variationFields));
    CHECK(keysInTable(page, "a change |") == namesOf<sceneFields::DraftChange>(sceneFields::changeFields));
    CHECK(keysInSchema(schema) == namesOf<sceneFields::Draft>(sceneFields::document));
    CHECK(keysInSchema(schema["$defs"]["play"]) == playKeys);
    CHECK(keysInSchema(schema["$defs"]["variation"]) == namesOf<VariationParams>(sceneFields::variationFields));
    CHECK(keysInSchema(schema["$defs"]["change"]) == namesOf<sceneFields::DraftChange>(sceneFields::changeFields));
}
