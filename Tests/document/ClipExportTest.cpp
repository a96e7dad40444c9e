#include "document/ClipExport.h"

#include "io/AudioWriter.h"
#include "support/Catch.h"
#include "support/ShippedProfile.h"
#include "support/TempFolder.h"

#include <pacini/actuator/Strength.h>
#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using test::bytesOf;
using test::put;
using test::TempFolder;

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
    Clip clip;
    clip.name = "hum";
    clip.duration = 0.5;
    clip.bands = {{100.0, 150.0, 220.0, 0, {{0.0, 0.5}, {0.5, 0.5}}, {}}};
    const Profile profile = test::shippedProfile("lra-175");
    std::string before;
    for (const double strength : {0.0, standardStrength, 1.0})
    {
        CAPTURE(strength);
        ExportChoice choice;
        choice.format = "wav";
        choice.folder = folder.path();
        choice.file = "hum.wav";
        choice.params.sampleRate = 8000;
        choice.params.profile = profile;
        choice.params.strength = strength;
        REQUIRE(exportClips({std::make_shared<const Clip>(clip)}, choice));

        Scene scene;
        scene.clips = {clip};
        scene.plays.emplace_back();
        CompileParams params;
        params.sampleRate = 8000.0;
        params.adaptation.strength = strength; // as `pacini render --strength` has it
        ScenePlayer player(compilePlan(scene, &profile, params).value(), {.sampleRate = 8000.0});
        std::vector<float> rendered(static_cast<std::size_t>(player.totalFrames()));
        std::span<float> out(rendered);
        player.process(std::span(&out, 1));
        REQUIRE(writeAudio(folder / "rendered.wav", rendered, {.sampleRate = 8000}));
        CHECK(bytesOf(folder / "hum.wav") == bytesOf(folder / "rendered.wav"));
        CHECK(std::exchange(before, bytesOf(folder / "hum.wav")) != bytesOf(folder / "hum.wav"));
    }
}
