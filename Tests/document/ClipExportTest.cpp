#include "document/ClipExport.h"

#include "support/Catch.h"
#include "support/TempFolder.h"

#include <filesystem>
#include <memory>

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
