#include "document/ClipExport.h"

#include "io/AudioWriter.h"
#include "support/Catch.h"
#include "support/Render.h"
#include "support/ShippedProfile.h"
#include "support/TempFolder.h"

#include <pacini/actuator/Strength.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using test::bytesOf;
using test::put;
using test::TempFolder;

namespace
{
Clip hum()
{
    Clip clip;
    clip.name = "hum";
    clip.duration = 0.5;
    clip.bands = {{100.0, 150.0, 220.0, 0, {{0.0, 0.5}, {0.5, 0.5}}, {}}};
    return clip;
}
} // namespace

TEST_CASE("An export never has the name of the recording that its clip was made from", "[document]")
{
    const TempFolder folder;
    put(folder / "bell.wav", "the recording");
    Clip clip;
    clip.name = "bell";
    clip.duration = 0.1;
    for (const ClipFormat& format : exportFormats())
    {
        CAPTURE(format.name);
        CHECK(exportName(clip, format) != "bell.wav");
        ExportChoice choice;
        choice.format = std::string(format.name);
        choice.folder = folder.path();
        static_cast<void>(exportClips({std::make_shared<const Clip>(clip)}, choice)); // some want more than nothing
        CHECK(bytesOf(folder / "bell.wav") == "the recording");
    }
    CHECK(std::filesystem::exists(folder / "bell.haptic.wav"));
}

TEST_CASE("The drive signal of an export is the one that is rendered with the same strength", "[document]")
{
    const TempFolder folder;
    const Clip clip = hum();
    const Profile profile = test::shippedProfile("lra-175");
    std::string before;
    for (const double strength : {0.0, standardStrength, 1.0})
    {
        CAPTURE(strength);
        ExportChoice choice;
        choice.format = "wav";
        choice.folder = folder.path();
        choice.file = "hum.wav";
        choice.replaceable = Replaceable::named;
        choice.params.sampleRate = 8000;
        choice.params.profile = profile;
        choice.params.strength = strength;
        REQUIRE(exportClips({std::make_shared<const Clip>(clip)}, choice));

        CompileParams params;
        params.sampleRate = 8000.0;
        params.adaptation.strength = strength; // as `pacini render --strength` has it
        const auto rendered = test::drive(clip, profile, params, {.sampleRate = 8000.0});
        REQUIRE(writeAudio(folder / "rendered.wav", rendered, {.sampleRate = 8000}));
        CHECK(bytesOf(folder / "hum.wav") == bytesOf(folder / "rendered.wav"));
        CHECK(std::exchange(before, bytesOf(folder / "hum.wav")) != bytesOf(folder / "hum.wav"));
    }
}

TEST_CASE("An export replaces nothing before the user was asked, and a sound of the project never", "[document]")
{
    const TempFolder folder;
    const std::vector<std::shared_ptr<const Clip>> clips{std::make_shared<const Clip>(hum())};
    for (const ClipFormat& format : exportFormats())
    {
        CAPTURE(format.name);
        ExportChoice choice;
        choice.format = std::string(format.name);
        choice.folder = folder.path() / std::string(format.name);
        choice.file = "hum" + std::string(format.extension);
        std::filesystem::create_directory(choice.folder);
        const auto free = filesInTheWay(clips, choice);
        REQUIRE(free);
        CHECK(free->empty());
        const auto made = exportClips(clips, choice);
        REQUIRE(made);
        // Each of its files is in the way now, whichever it is, and what is in it stays without being asked for.
        for (const auto& file : made->front().files)
        {
            CAPTURE(file);
            for (const auto& other : made->front().files)
                std::filesystem::remove(other);
            put(file, "hers");
            const auto standing = filesInTheWay(clips, choice);
            REQUIRE(standing);
            REQUIRE(standing->size() == 1);
            CHECK(standing->front().path == file);
            CHECK(standing->front().kind == FileKind::other);
            CHECK_FALSE(exportClips(clips, choice));
            CHECK(bytesOf(file) == "hers");
            ExportChoice asked = choice;
            asked.replaceable = Replaceable::named;
            CHECK(exportClips(clips, asked));
            CHECK(bytesOf(file) != "hers");
        }
        // A sound of the project: in its place, by a link, or moved with its content.
        AudioReference sound;
        sound.path = made->front().files.front();
        put(sound.path, "the recording");
        choice.replaceable = Replaceable::any;
        choice.needed.sounds = {sound};
        const auto refused = exportClips(clips, choice);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().text().find("is a sound of this project") != std::string::npos);
        CHECK(bytesOf(sound.path) == "the recording");
        std::filesystem::create_symlink(sound.path, choice.folder / "link.wav");
        choice.needed.sounds[0].path = choice.folder / "link.wav";
        CHECK_FALSE(exportClips(clips, choice));
        choice.needed.sounds[0].path = "/moved/away.wav";
        choice.needed.sounds[0].bytes = 13;
        choice.needed.sounds[0].hash = "2a1873c84aa1d27f"; // FNV-1a of "the recording"
        CHECK_FALSE(filesInTheWay(clips, choice));
        CHECK_FALSE(exportClips(clips, choice));
        CHECK(bytesOf(sound.path) == "the recording");
        // Nor the project itself.
        choice.needed = {{}, sound.path};
        CHECK_FALSE(exportClips(clips, choice));
        choice.needed = {};
        CHECK(exportClips(clips, choice));
    }
}
