#include "document/ProjectJson.h"

#include "document/Base64.h"
#include "document/RecentFiles.h"
#include "io/AudioWriter.h"
#include "support/Catch.h"
#include "support/ChangedText.h"
#include "support/RandomProfile.h"
#include "support/TempFolder.h"

#include <pacini/actuator/Strength.h>

#include <cmath>
#include <filesystem>
#include <limits>

using namespace pacini;
using test::changed;

namespace
{
std::shared_ptr<const Clip> someClip(double level)
{
    Clip clip;
    clip.duration = 2.0;
    clip.envelope = {{0.0, level}, {2.0, 0.25}};
    clip.bands = {{50.0, 60.0, 70.0, 0, {{0.0, 0.5}}, {}}};
    return std::make_shared<const Clip>(clip);
}

/// One edit of each kind, with values that are not the defaults.
std::vector<Edit> allEdits()
{
    const EditScope scope{{0.25, 1.5}, false, {{LaneKind::amplitude, 0}, {LaneKind::envelope, 0}}, false};
    const std::vector<double> two = {60.0, 0.0};
    std::vector<Edit> edits = {
        {LanePatch{{LaneKind::pitch, 3}, {0.1, 0.9}, {{0.1, 50.5}, {0.9, 51.5}}}, {123.25}, 2.0},
        {TransientPatch{Transient{0.5, 0.25, 0.75}, Transient{0.6, 0.5, 1.0}}, {}, 2.0},
        {TransientPatch{std::nullopt, Transient{0.6, 0.5, 1.0}}, {}, 2.0},
        {TransientPatch{Transient{0.5, 0.25, 0.75}, std::nullopt}, {}, 2.0},
        {MarkersEdit{{{0.5, "a \"b\""}, {1.0, "ü"}}}, {}, 2.0},
        {RenameEdit{"new"}, {}, 2.0},
        {GainEdit{scope, -3.5}, two, 2.0},
        {FadeEdit{scope, FadeDirection::out, FadeShape::square}, two, 2.0},
        {InvertEdit{scope}, two, 2.0},
        {QuantiseEdit{scope, {0.125, 0.05, 0.5}}, two, 2.0},
        {HumaniseEdit{scope, {0.01, 2.0, 0.5, std::numeric_limits<std::uint64_t>::max()}}, two, 2.0},
        {TransposeEdit{-7.0}, {}, 2.0},
        {TrimEdit{{0.5, 1.75}}, {}, 2.0},
        {CutEdit{{0.5, 0.75}}, {}, 1.25},
        {InsertEdit{0.5, someClip(0.1)}, {}, 1.0},
        {RepeatEdit{3}, {}, 3.0},
        {ReverseEdit{}, {}, 9.0},
        {StretchEdit{0.5}, {}, 9.0},
        {ReplaceEdit{someClip(0.2)}, {}, 4.5},
        {ThinEdit{{0.25, 1.5}, 0.02, 0.125}, {}, 4.5},
    };
    Edit lost = edits[6];
    std::get<GainEdit>(lost.operation).scope.lanes[0].index = std::numeric_limits<std::size_t>::max();
    edits.push_back(lost);
    return edits;
}

Project fullProject(const std::filesystem::path& folder)
{
    Project project;
    project.notes = "line\nline \xC3\xA4";
    AudioReference sound;
    sound.id = 3;
    sound.path = folder / "sounds" / "a b.wav";
    sound.bytes = 0xFFFFFFFFFFFFull;
    sound.duration = 1.25;
    sound.sampleRate = 44100.0;
    sound.channels = 2;
    sound.hash = "0123456789abcdef";
    project.sources.push_back(sound);
    sound.id = 4;
    sound.embedded = std::make_shared<const std::string>("\x01\x02\x03\x04");
    project.sources.push_back(sound);
    project.groups = {"one", "two"};
    project.profile.name = "wristband";
    project.profile.embedded = test::randomProfile(3);
    project.profile.strength = 0.25;
    std::vector<std::shared_ptr<const Edit>> edits;
    for (const Edit& edit : allEdits())
        edits.push_back(std::make_shared<const Edit>(edit));
    ClipItem item;
    item.id = 7;
    item.group = "two";
    item.notes = "notes";
    item.source = 4;
    item.encoder.bands = 9;
    item.encoder.spacing = BandSpacing::linear;
    item.encoder.normalise = false;
    item.encoder.audible = 0.25;
    item.encoder.onsets.sensitivity = 2.0;
    item.analysis = someClip(0.3);
    item.clip = someClip(0.4);
    item.edits = EditList::of(edits);
    item.unfitting = {{20, "no band is left"}};
    project.clips.push_back(std::make_shared<const ClipItem>(item));
    item.id = 8;
    item.clip = item.analysis;
    item.edits = {};
    item.unfitting.clear();
    project.clips.push_back(std::make_shared<const ClipItem>(item));
    return project;
}
} // namespace

TEST_CASE("A project with every kind of entry reads back as it was written")
{
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "projects";
    const Project project = fullProject(folder);
    const std::string text = projectJson(project, {.folder = folder});
    const auto read = readProjectJson(text, folder);
    INFO((read ? "" : read.error().text()));
    REQUIRE(read);
    CHECK(read->project == project);
    CHECK(*read->project.sources[1].embedded == *project.sources[1].embedded);
    CHECK_FALSE(read->recovery);
    CHECK(text.find("\"path\": \"sounds/a b.wav\"") != std::string::npos);
    CHECK(projectJson(read->project, {.folder = folder}) == text);
    // The whole folder may move.
    const auto moved = readProjectJson(text, folder.parent_path() / "elsewhere");
    REQUIRE(moved);
    CHECK(moved->project.sources[0].path == folder.parent_path() / "elsewhere" / "sounds" / "a b.wav");
}

TEST_CASE("A project from before what is heard was felt keeps its clips as they are")
{
    std::string text = projectJson(fullProject("/"));
    for (std::size_t at; (at = text.find("\"audible\": 0.25,")) != std::string::npos;)
        text.erase(at, std::string("\"audible\": 0.25,").size());
    const auto read = readProjectJson(text);
    REQUIRE(read);
    CHECK(read->project.clips[0]->encoder.audible == 0.0);
}

TEST_CASE(
    "A project from before there was a strength plays its actuator as it did; without an actuator it has the usual one")
{
    std::string text = projectJson(fullProject("/"));
    text = changed(text, "\"strength\": 0.25", "\"other\": 0");
    const auto read = readProjectJson(text);
    REQUIRE(read);
    CHECK(read->project.profile.embedded);
    CHECK(read->project.profile.strength == 0.0);
    CHECK(Project{}.profile.strength == standardStrength);
    const auto none = readProjectJson(R"({"format": "pacini.project", "version": 1, "profile": {"name": ""}})");
    REQUIRE(none);
    CHECK(none->project.profile.strength == standardStrength);
}

TEST_CASE("Damaged projects are refused with the place")
{
    const std::string text = projectJson(fullProject("/"));
    const auto errorOf = [](const std::string& damaged)
    {
        const auto read = readProjectJson(damaged);
        REQUIRE_FALSE(read);
        return read.error();
    };
    CHECK(errorOf(changed(text, "\"pacini.project\"", "\"pacini.clip\"")).where == "format");
    CHECK(errorOf(changed(text, "\"version\": 1", "\"version\": 2")).code == ErrorCode::unsupportedVersion);
    CHECK(errorOf(changed(text, "\"source\": 4", "\"source\": 5")).where == "clips[0].source");
    CHECK(errorOf(changed(text, "\"strength\": 0.25", "\"strength\": 1.25")).where == "profile.strength");
    CHECK(errorOf(changed(text, "\"id\": 8", "\"id\": 7")).where == "clips[1].id");
    CHECK(errorOf(changed(text, "\"id\": 4", "\"id\": 3")).where == "sources[1].id");
    CHECK(errorOf(changed(text, "\"kind\": \"fade\"", "\"kind\": \"fades\"")).where == "clips[0].edits[7].kind");
    CHECK(errorOf(changed(text, "\"time\": 0, \"amplitude\": 0.4", "\"time\": -1, \"amplitude\": 0.4")).where ==
          "clips[0].clip.envelope[0].time");
    CHECK(errorOf(changed(text, "\"edit\": 20", "\"edit\": 21")).where == "clips[0].unfitting[0].edit");
    CHECK(errorOf(changed(text, "\"embedded\": \"", "\"embedded\": \"?")).where == "sources[1].embedded");
    CHECK(errorOf(text.substr(0, text.size() / 2)).where.find("line") == 0);
    CHECK_FALSE(readProjectJson(""));
    CHECK_FALSE(readProjectJson("[]"));
    CHECK_FALSE(readProjectJson(R"({"format": "pacini.project", "version": 1, "clips": [{"id": 1, "clip": 0}]})"));
}

TEST_CASE("Base64 is that of RFC 4648 and refuses what is not")
{
    CHECK(toBase64("") == "");
    CHECK(toBase64("f") == "Zg==");
    CHECK(toBase64("fo") == "Zm8=");
    CHECK(toBase64("foo") == "Zm9v");
    CHECK(toBase64("foobar") == "Zm9vYmFy");
    for (const char* text : {"Z", "Zg=", "Z===", "====", "Zm9v?m9v", "Zg==Zg=="})
        CHECK_FALSE(fromBase64(text));
    std::string all;
    for (int i = 0; i < 1000; ++i)
        all += static_cast<char>(i * 7);
    CHECK(fromBase64(toBase64(all)) == all);
}

TEST_CASE("A sound is found again where it moved, and a changed one is noticed")
{
    const test::TempFolder folder;
    const std::vector<float> samples(4800, 0.25f);
    std::filesystem::create_directory(folder / "inside");
    REQUIRE(writeAudio(folder / "a.wav", samples, {.sampleRate = 48000}));
    const auto described = describeAudio(folder / "a.wav", true);
    REQUIRE(described);
    AudioReference sound = described->reference;
    CHECK(sound.duration == Approx(0.1));
    CHECK(sound.channels == 1);
    const std::filesystem::path folders[] = {folder.path()};
    CHECK_FALSE(locateAudio(sound, folders)->moved);
    std::filesystem::rename(folder / "a.wav", folder / "inside" / "a.wav");
    const auto found = locateAudio(sound, folders);
    REQUIRE(found);
    CHECK(found->moved);
    CHECK(found->path == folder / "inside" / "a.wav");
    REQUIRE(writeAudio(folder / "inside" / "a.wav", std::vector<float>(4800, 0.5f), {.sampleRate = 48000}));
    CHECK(locateAudio(sound, folders).error().code == ErrorCode::io);
    REQUIRE(writeAudio(folder / "a.wav", std::vector<float>(4800, 0.5f), {.sampleRate = 48000}));
    CHECK(locateAudio(sound, folders)->changed);
    // The embedded copy has it all the same.
    const auto audio = loadAudio(sound, folders, folder.path());
    REQUIRE(audio);
    REQUIRE(audio->frames() == 4800);
    std::vector<float> read(4800);
    audio->read(0, read);
    CHECK(read[7] == Approx(0.25f).margin(1e-4));
}

TEST_CASE("Recent files are newest first, without repetition, twelve at the most, and survive")
{
    const test::TempFolder folder;
    RecentFiles recent(folder / "settings" / "recent.json");
    for (int i = 0; i < 15; ++i)
        REQUIRE(recent.add(folder / (std::to_string(i) + ".pacini")));
    REQUIRE(recent.add(folder / "10.pacini"));
    RecentFiles again(folder / "settings" / "recent.json");
    CHECK(again.files() == recent.files());
    REQUIRE(again.files().size() == 12);
    CHECK(again.files()[0] == folder / "10.pacini");
    CHECK(again.files()[1] == folder / "14.pacini");
    CHECK_FALSE(RecentFiles::exists(again.files()[0]));
    test::put(folder / "settings" / "recent.json", "{damaged");
    CHECK(RecentFiles(folder / "settings" / "recent.json").files().empty());
}
