// The strength with which the chosen actuator is played, and the sheet that exports.

#include "editor/Bench.h"
#include "editor/Pump.h"
#include "editor/clip/session/ClipSteps.h"
#include "editor/clip/sheets/ExportSheet.h"
#include "io/AudioReader.h"
#include "support/TempFolder.h"

#include <pacini/actuator/Strength.h>
#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// A narrow actuator, a wide one whose profile has nothing to trade, and a clip.
struct StrengthBench : EditorBench
{
    juce::Slider& slider = get<juce::Slider>(view, "Strength");

    StrengthBench() : EditorBench({shipped("lra-175"), shipped("erm-coin"), shipped("lra-235-narrow")})
    {
        auto opened = editor::importFile(demoSound("drums_tabla_pattern"), {});
        REQUIRE(opened.ok());
        editor::Imported alone; // without its sound, which is resampled meanwhile: the preview then fades to itself
        alone.clip = std::move(opened)->clip;
        session.sounds.add(std::move(alone));
        session.actuators.setProfile("lra-175");
    }

    void turn(double percent) { slider.setValue(percent, juce::sendNotificationSync); }

    /// What `pacini render --profile --strength` makes of the clip.
    [[nodiscard]] std::vector<float> rendered(double strength, double fs) const
    {
        Scene scene;
        scene.clips = {clip()};
        scene.plays.emplace_back();
        CompileParams params;
        params.sampleRate = fs;
        params.adaptation.strength = strength;
        ScenePlayer playing(compilePlan(scene, session.actuators.profile().get(), params).value(), {.sampleRate = fs});
        std::vector<float> all(static_cast<std::size_t>(playing.totalFrames()));
        std::span<float> out(all);
        playing.process(std::span(&out, 1));
        return all;
    }

    /// The drive from the start of the clip, at 48 kHz.
    [[nodiscard]] std::vector<float> played(std::size_t frames)
    {
        session.transport.setPlayhead(0.0);
        session.transport.play();
        std::vector<float> all(frames);
        const auto next = [&](std::span<float> piece)
        {
            session.player.process(std::span(&piece, 1), {});
            return std::any_of(piece.begin(), piece.end(), [](float v) { return v != 0.0f; });
        };
        REQUIRE(pumpUntil([&] { return next(std::span(all).first(512)); }));
        for (std::size_t i = 512; i < frames; i += 512)
            (void)next(std::span(all).subspan(i, std::min<std::size_t>(512, frames - i)));
        session.transport.stop();
        for (int i = 0; i < 10; ++i) // it fades
        {
            std::vector<float> rest(512);
            const std::span<float> haptic(rest);
            session.player.process(std::span(&haptic, 1), {});
        }
        return all;
    }
};

/// The export dialog, written to a folder.
struct OpenSheet
{
    editor::ExportSheet& sheet;
    juce::ComboBox& format = get<juce::ComboBox>(sheet, "Format");
    juce::ComboBox& events = get<juce::ComboBox>(sheet, "Events");

    explicit OpenSheet(EditorBench& bench) : sheet(shown(bench)) {}

    static editor::ExportSheet& shown(EditorBench& bench)
    {
        bench.view.showSheet(nullptr);
        REQUIRE(bench.view.doCommand(editor::exportClips));
        auto* sheet = dynamic_cast<editor::ExportSheet*>(bench.view.sheet());
        REQUIRE(sheet != nullptr);
        return *sheet;
    }

    void choose(std::string_view name)
    {
        const auto& all = exportFormats();
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const ClipFormat& one) { return one.name == name; });
        format.setSelectedId(1 + static_cast<int>(found - all.begin()), juce::sendNotificationSync);
    }

    /// The bytes that Export writes.
    std::string written(EditorBench& bench, const std::filesystem::path& path)
    {
        get<juce::TextEditor>(sheet, "Destination file or folder").setText(juce::String(path.string()), true);
        const bool there = std::filesystem::exists(path);
        answer(sheet, "Export");
        if (there)
        {
            REQUIRE(pumpUntil([&] { return questionOver(sheet) != nullptr; }));
            answer(*questionOver(sheet), "Replace");
        }
        REQUIRE(pumpUntil([&] { return bench.view.sheet() == nullptr; }));
        return bytesOf(path);
    }
};
} // namespace

TEST_CASE("Strength in the toolbar drives the actuator as the command does, and goes into exports of the drive")
{
    StrengthBench bench;
    TempFolder folder;
    CHECK(bench.slider.isEnabled());
    CHECK(bench.slider.getValue() == 100.0 * standardStrength);
    std::vector<float> before;
    for (const double percent : {0.0, 40.0, 100.0})
    {
        CAPTURE(percent);
        bench.turn(percent);
        CHECK(bench.session.actuators.strength() == Approx(0.01 * percent));
        const auto heard = bench.played(24000);
        const auto wanted = bench.rendered(0.01 * percent, 48000.0);
        CHECK(std::equal(heard.begin() + 512, heard.end(), wanted.begin() + 512));
        CHECK(heard != before);
        before = heard;

        OpenSheet sheet(bench);
        sheet.choose("wav");
        const auto path = folder / ("drive" + std::to_string(static_cast<int>(percent)) + ".wav");
        (void)sheet.written(bench, path);
        const auto audio = readAudio(path);
        REQUIRE(audio);
        CHECK(audio->samples == bench.rendered(0.01 * percent, audio->sampleRate));
    }
}

TEST_CASE("The export starts from the format, rate and folder of the last one")
{
    StrengthBench bench;
    const TempFolder folder;
    {
        OpenSheet sheet(bench);
        sheet.choose("wav");
        get<juce::ComboBox>(sheet.sheet, "Sample rate").setSelectedId(8000, juce::sendNotificationSync);
        (void)sheet.written(bench, folder / "drive.wav");
    }
    OpenSheet again(bench);
    CHECK(exportFormats()[static_cast<std::size_t>(again.format.getSelectedId() - 1)].name == "wav");
    CHECK(get<juce::ComboBox>(again.sheet, "Sample rate").getSelectedId() == 8000);
    CHECK(get<juce::TextEditor>(again.sheet, "Destination file or folder")
              .getText()
              .startsWith(juce::String(folder.path().string())));
    again.choose("ahap");
    bench.view.showSheet(nullptr); // nothing was written
    OpenSheet third(bench);
    CHECK(exportFormats()[static_cast<std::size_t>(third.format.getSelectedId() - 1)].name == "wav");
}

TEST_CASE("What the actuator plays is shown with the strength, the old until the new is there")
{
    StrengthBench bench;
    auto& row = bench.view.clipView().actuatorRow();
    REQUIRE(pumpUntil([&] { return row.trace() != nullptr; }));
    const auto usual = row.trace();
    bench.turn(100.0);
    CHECK(row.trace() == usual);
    REQUIRE(pumpUntil([&] { return row.trace() != usual; }));
    REQUIRE(row.trace() != nullptr);
    CHECK(row.trace()->peaks != usual->peaks);
}

TEST_CASE("Actuator and strength are choices of listening: kept with the project and through undo, and no steps of it")
{
    StrengthBench bench;
    auto& document = bench.session.model.document();
    REQUIRE(editor::editClip(bench.session.model, "Reverse", ReverseEdit{}));
    for (const double percent : {50.0, 60.0, 80.0})
        bench.turn(percent);
    bench.session.actuators.setProfile("lra-235-narrow");
    CHECK(document.steps().undoName() == "Reverse");
    bench.session.model.undo();
    CHECK(bench.slider.getValue() == 80.0);
    CHECK(bench.session.actuators.profileName() == "lra-235-narrow");
    CHECK_FALSE(document.steps().canUndo());
    CHECK(document.project().profile.strength == Approx(0.8));
    const TempFolder folder;
    REQUIRE(bench.session.model.saveAs(folder / "strong.pacini"));
    bench.session.model.newProject();
    CHECK(bench.slider.getValue() == 100.0 * standardStrength);
    REQUIRE(bench.session.model.openProject(folder / "strong.pacini"));
    CHECK(bench.slider.getValue() == 80.0);
}

TEST_CASE("What has nothing to trade has no strength to turn")
{
    StrengthBench bench;
    bench.session.actuators.setProfile("erm-coin");
    CHECK_FALSE(bench.slider.isEnabled());
    bench.session.actuators.setProfile({});
    CHECK_FALSE(bench.slider.isEnabled());
    CHECK(bench.slider.getTooltip().isNotEmpty());
}

TEST_CASE("No control of the toolbar is cut off or lies on another, from the narrowest window to a wide one")
{
    StrengthBench bench;
    auto& toolbar = *bench.slider.getParentComponent();
    for (const int width : {880, 936, 1024, 1100, 1280, 2000})
    {
        bench.view.setSize(width, 800);
        std::vector<juce::Component*> placed;
        for (juce::Component* child : toolbar.getChildren())
            if (child->isVisible())
                placed.push_back(child);
        CHECK(placed.size() >= 11);
        for (std::size_t i = 0; i < placed.size(); ++i)
        {
            CAPTURE(width, placed[i]->getTitle(), placed[i]->getBounds().toString());
            CHECK(toolbar.getLocalBounds().contains(placed[i]->getBounds()));
            CHECK(placed[i]->getWidth() >= 28);
            for (std::size_t k = 0; k < i; ++k)
                CHECK_FALSE(placed[k]->getBounds().intersects(placed[i]->getBounds()));
        }
    }
}

TEST_CASE("Export asks how events are written where the format has a choice, first as the command does, and does so")
{
    EditorBench bench;
    TempFolder folder;
    bench.openDemo("drums_tabla_pattern");
    {
        OpenSheet sheet(bench);
        CHECK_FALSE(sheet.events.isEnabled());
        for (const ClipFormat& format : exportFormats())
        {
            CAPTURE(format.name);
            sheet.choose(format.name);
            CHECK(sheet.events.isEnabled() == format.events.has_value());
            CHECK(sheet.events.getSelectedId() == (format.events ? 1 + static_cast<int>(*format.events) : 0));
        }
    }
    for (const std::string name : {"haptic", "ahap"})
        for (const std::optional<EventExport> how :
             {std::optional<EventExport>{}, std::optional(EventExport::merged), std::optional(EventExport::transients)})
        {
            CAPTURE(name);
            OpenSheet sheet(bench);
            sheet.choose(name);
            if (how)
                sheet.events.setSelectedId(1 + static_cast<int>(*how), juce::sendNotificationSync);
            const std::string bytes = sheet.written(bench, folder / ("drums." + name));
            ExportParams params;
            params.events = how;
            const auto wanted = clipFormatNamed(name)->write(bench.clip(), params);
            REQUIRE(wanted);
            CHECK(bytes == wanted->files[0].bytes);
        }
}
