// What existing files are, and which an export leaves.

#include "io/Overwrite.h"

#include "io/AudioWriter.h"
#include "io/ClipFile.h"
#include "io/ProfileFile.h"
#include "io/SceneFile.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/TempFolder.h"

#include <array>
#include <vector>

using namespace pacini;
using test::bytesOf;
using test::put;
using test::TempFolder;

TEST_CASE("What stands in the way is told by its content", "[overwrite]")
{
    const TempFolder folder;
    const std::vector<float> samples(800, 0.1f);
    REQUIRE(writeAudio(folder / "recording", samples, {.sampleRate = 8000}).ok() == false); // no extension
    REQUIRE(writeAudio(folder / "recording.wav", samples, {.sampleRate = 8000}));
    std::filesystem::rename(folder / "recording.wav", folder / "recording.json"); // whatever it is called
    AudioWriteParams made{.sampleRate = 8000};
    made.origin = originOf("a.json", folder / "made.wav", std::string(16, '0'));
    REQUIRE(writeAudio(folder / "made.wav", samples, made));
    Clip clip;
    clip.duration = 0.5;
    REQUIRE(writeClip(folder / "clip.json", clip, jsonFormat()));
    REQUIRE(writeClip(folder / "clip.pacb", clip, packedFormat()));
    REQUIRE(writeScene(folder / "scene.json", sceneOf(clip)));
    std::filesystem::copy_file(sourceFolder() / "profiles/lra-175.json", folder / "profile.json");
    put(folder / "song.pacini", "{}");
    put(folder / "notes.txt", "hers");
    std::filesystem::create_directory(folder / "sub");
    CHECK(kindOf(folder / "recording.json") == FileKind::sound);
    CHECK(kindOf(folder / "made.wav") == FileKind::madeSound);
    CHECK(kindOf(folder / "clip.json") == FileKind::clip);
    CHECK(kindOf(folder / "clip.pacb") == FileKind::clip);
    CHECK(kindOf(folder / "scene.json") == FileKind::scene);
    CHECK(kindOf(folder / "profile.json") == FileKind::profile);
    CHECK(kindOf(folder / "song.pacini") == FileKind::project);
    CHECK(kindOf(folder / "notes.txt") == FileKind::other);
    CHECK(kindOf(folder / "sub") == FileKind::folder);
    const std::array<std::filesystem::path, 3> results{folder / "new.json", folder / "notes.txt", "-"};
    const auto standing = standingAt(results);
    REQUIRE(standing.size() == 1);
    CHECK(standing[0].path == folder / "notes.txt");
}

TEST_CASE("Files of an export beside its main one are replaced no more than that is", "[overwrite]")
{
    const TempFolder folder;
    const ExportedClip exported{{{"", "main"}, {"-transients", "events"}}, {}};
    const auto main = folder / "clip.ahap", second = folder / "clip-transients.ahap";
    put(second, "hers");
    const auto refused = writeExport(main, exported, Existing::keep);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().where == "clip-transients.ahap");
    CHECK(bytesOf(second) == "hers");
    CHECK_FALSE(std::filesystem::exists(main)); // all of them or none
    put(second, "events");                      // what would be written
    CHECK(writeExport(main, exported, Existing::keep));
    CHECK(bytesOf(main) == "main");
    CHECK_FALSE(writeExport(main, exported, Existing::keep));
    put(second, "hers");
    CHECK(writeExport(main, exported, Existing::replace));
    CHECK(bytesOf(second) == "events");
}
