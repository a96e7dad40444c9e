#include "document/Amendments.h"
#include "document/AudioReference.h"
#include "document/Document.h"
#include "document/FolderFiles.h"
#include "document/ProjectEdits.h"
#include "io/AudioExtensions.h"
#include "io/AudioWriter.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

#include <algorithm>
#include <filesystem>
#include <string>

using namespace pacini;
using pacini::test::TempFolder;

namespace
{
AudioReference soundAt(const std::filesystem::path& path, float level, int id)
{
    REQUIRE(writeAudio(path, std::vector<float>(4800, level), {.sampleRate = 48000}));
    AudioReference reference = describeAudio(path)->reference;
    reference.id = id;
    return reference;
}
} // namespace

TEST_CASE("Missing sounds are found by the file that is shown, by their names beside it, never by another content")
{
    const TempFolder folder;
    std::filesystem::create_directories(folder / "new/inside");
    const std::vector<AudioReference> missing = {soundAt(folder / "a.wav", 0.1f, 1), soundAt(folder / "b.wav", 0.2f, 2),
                                                 soundAt(folder / "c.wav", 0.3f, 3),
                                                 soundAt(folder / "d.wav", 0.4f, 4)};
    std::filesystem::rename(folder / "a.wav", folder / "new/renamed.wav");
    std::filesystem::rename(folder / "b.wav", folder / "new/inside/b.wav");
    std::filesystem::remove(folder / "c.wav");
    std::filesystem::remove(folder / "d.wav");
    (void)soundAt(folder / "new/d.wav", 0.5f, 0);
    const auto found = foundBy(folder / "new/renamed.wav", missing);
    REQUIRE(found.size() == 2);
    CHECK(found[0].id == 1);
    CHECK(found[0].path == folder / "new/renamed.wav");
    CHECK(found[1].id == 2);
    CHECK(found[1].path == folder / "new/inside/b.wav");
    CHECK(found[1].hash == missing[1].hash);
    CHECK(foundBy(folder / "nowhere.wav", missing).empty());
}

TEST_CASE("Several sounds get their new places in one step, or none of them")
{
    const TempFolder folder;
    Document document;
    Clip clip;
    clip.duration = 0.1;
    for (const char* name : {"a.wav", "b.wav"})
    {
        AudioReference sound;
        sound.path = folder / name;
        sound.hash = name;
        REQUIRE(addSound(document, sound, {}, clip));
    }
    auto moved = document.project().sources;
    for (AudioReference& sound : moved)
        sound.path = folder / "new" / sound.path.filename();
    const Project before = document.project();
    REQUIRE(document.commit("Find sounds", withSounds(document.project(), moved)));
    CHECK(document.project().sources == moved);
    CHECK(document.undo());
    CHECK(document.project() == before);
    moved[1].id = 77;
    CHECK_FALSE(document.commit("Find sounds", withSounds(document.project(), moved)));
    CHECK(document.project() == before);
}

TEST_CASE("A folder gives its sounds and clips at every depth, sorted, and nothing else")
{
    const TempFolder folder;
    std::filesystem::create_directories(folder / "b/deep");
    std::filesystem::create_directories(folder / ".hidden");
    for (const char* name : {"z.wav", "a.FLAC", "b/deep/c.haptic", "b/m.json", "notes.txt", "picture.png", "p.pacini",
                             ".dot.wav", ".hidden/x.wav", "wav"})
        test::put(folder / name, "x");
    std::filesystem::create_directories(folder / "folder.wav");
    std::filesystem::create_directory_symlink(folder.path(), folder / "b/round");
    const std::vector<std::filesystem::path> expected = {folder / "a.FLAC", folder / "b/deep/c.haptic",
                                                         folder / "b/m.json", folder / "z.wav"};
    CHECK(openableFiles(folder.path()) == expected);
    CHECK(openableFiles(folder / "missing").empty());
    // What the command looks for in folders, the editor does.
    const auto openable = openableExtensions();
    for (const std::string& extension : audioExtensions())
    {
        INFO(extension);
        CHECK(std::find(openable.begin(), openable.end(), extension) != openable.end());
    }
}
