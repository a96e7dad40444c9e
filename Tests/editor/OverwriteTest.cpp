// Files that exist are not written over without a question, and those of the project never.

#include "editor/Bench.h"
#include "editor/Pump.h"
#include "editor/clip/scene/SceneSheet.h"
#include "editor/clip/sheets/ExportSheet.h"
#include "editor/measure/MeasurePage.h"
#include "io/AudioWriter.h"
#include "io/ClipFile.h"
#include "support/TempFolder.h"

#include <filesystem>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
std::filesystem::path recording(const std::filesystem::path& path)
{
    REQUIRE(writeAudio(path, std::vector<float>(48000, 0.25f), {.sampleRate = 48000}));
    return path;
}

/// An export sheet with a path that was typed.
struct Typed
{
    EditorBench& bench;
    editor::ExportSheet* sheet = nullptr;

    explicit Typed(EditorBench& shown, const std::filesystem::path& path) : bench(shown)
    {
        bench.view.showSheet(nullptr);
        REQUIRE(bench.view.doCommand(editor::exportClips));
        sheet = dynamic_cast<editor::ExportSheet*>(bench.view.sheet());
        REQUIRE(sheet != nullptr);
        auto& target = get<juce::TextEditor>(*sheet, "Destination file or folder");
        target.setText(juce::String(path.string()), false);
        target.onTextChange();
        target.onReturnKey();
    }
    [[nodiscard]] juce::String text() const
    {
        return get<juce::TextEditor>(*sheet, "What is kept and what is lost").getText();
    }
};
} // namespace

TEST_CASE("Export asks before it replaces a file, says what it is, and what it has written", "[overwrite]")
{
    const TempFolder folder;
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    const auto file = recording(folder / "take 1.wav");
    const auto before = bytesOf(file);
    {
        Typed typed(bench, file);
        REQUIRE(pumpUntil([&] { return questionOver(*typed.sheet) != nullptr; }));
        CHECK(bytesOf(file) == before);
        auto& question = *questionOver(*typed.sheet);
        CHECK(question.getTitle() == "Replace take 1.wav?");
        CHECK(question.getDescription().contains("take 1.wav is a sound that Pacini did not make"));
        CHECK(question.getDescription().contains(juce::String(folder.path().string())));
        CHECK(question.keyPressed(juce::KeyPress(juce::KeyPress::returnKey))); // typed in a hurry: it keeps
        REQUIRE(pumpUntil([&] { return questionOver(*typed.sheet) == nullptr; }));
        CHECK(bytesOf(file) == before);
        CHECK(bench.view.sheet() == typed.sheet);
    }
    {
        Typed typed(bench, file);
        REQUIRE(pumpUntil([&] { return questionOver(*typed.sheet) != nullptr; }));
        answer(*questionOver(*typed.sheet), "Replace");
        REQUIRE(pumpUntil([&] { return bench.view.sheet() == nullptr; }));
    }
    const auto once = bytesOf(file);
    CHECK(once != before);
    auto& notice = get<editor::NoticeBar>(bench.view, "Notice");
    CHECK(notice.isVisible());
    CHECK(notice.text() == "Written: take 1.wav");
    CHECK(get<juce::TextButton>(notice, "Show in folder").isVisible());
    {
        Typed again(bench, file);
        REQUIRE(pumpUntil([&] { return questionOver(*again.sheet) != nullptr; }));
        CHECK(bytesOf(file) == once);
    }
    Typed fresh(bench, folder / "new.json");
    REQUIRE(pumpUntil([&] { return bench.view.sheet() == nullptr; }));
    CHECK(std::filesystem::exists(folder / "new.json"));
    bench.session.model.onNotice("another one");
    CHECK_FALSE(get<juce::TextButton>(notice, "Show in folder").isVisible());
}

TEST_CASE("Export never replaces a sound of the project, by whatever name", "[overwrite]")
{
    const TempFolder folder;
    EditorBench bench;
    const auto file = recording(folder / "door.wav");
    auto imported = editor::importFile(file, {});
    REQUIRE(imported);
    bench.session.sounds.add(std::move(*imported));
    std::filesystem::create_hard_link(file, folder / "hard.wav");
    std::filesystem::create_symlink(file, folder / "soft.wav");
    std::filesystem::copy_file(file, folder / "copy.wav"); // the same sound, found there when it has moved
    const auto before = bytesOf(file);
    for (const char* name : {"door.wav", "hard.wav", "soft.wav", "copy.wav"})
    {
        CAPTURE(name);
        Typed typed(bench, folder / name);
        REQUIRE(pumpUntil([&] { return typed.text().contains("is a sound of this project"); }));
        CHECK(typed.text().startsWith("Not exported: " + juce::String(name)));
        CHECK(questionOver(*typed.sheet) == nullptr);
        CHECK(bytesOf(folder / name) == before);
    }
}

TEST_CASE("Several clips are asked about once, by the names of their files", "[overwrite]")
{
    const TempFolder folder;
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    bench.openDemo("impact_boom");
    put(folder / "impact_boom.json", "hers");
    bench.view.showSheet(nullptr);
    REQUIRE(bench.view.doCommand(editor::exportClips));
    auto& sheet = *bench.view.sheet();
    auto& all = get<juce::ToggleButton>(sheet, "Export all clips");
    all.setToggleState(true, juce::dontSendNotification);
    all.onClick();
    get<juce::TextEditor>(sheet, "Destination file or folder").setText(juce::String(folder.path().string()), false);
    answer(sheet, "Export");
    REQUIRE(pumpUntil([&] { return questionOver(sheet) != nullptr; }));
    CHECK(questionOver(sheet)->getTitle() == "Replace impact_boom.json?");
    CHECK_FALSE(std::filesystem::exists(folder / "knock_wood_bridge.json"));
    answer(*questionOver(sheet), "Replace");
    REQUIRE(pumpUntil([&] { return bench.view.sheet() == nullptr; }));
    CHECK(std::filesystem::exists(folder / "knock_wood_bridge.json"));
    CHECK(bytesOf(folder / "impact_boom.json") != "hers");
}

TEST_CASE("Saving under the name of another project asks, under its own does not, and over a sound never",
          "[overwrite]")
{
    const TempFolder folder;
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    const auto file = folder / "song.pacini";
    put(file, "hers");
    bench.view.files().saveTo(file);
    REQUIRE(bench.view.question() != nullptr);
    CHECK(bench.view.question()->getTitle() == "Replace song.pacini?");
    CHECK(bytesOf(file) == "hers");
    answer(*bench.view.question(), "Replace");
    CHECK(bytesOf(file) != "hers");
    CHECK(bench.session.model.document().path() == file);
    REQUIRE(pumpUntil([&] { return bench.view.question() == nullptr; }));
    bench.view.doCommand(editor::fadeOut);
    bench.view.files().saveTo(file);
    CHECK(bench.view.question() == nullptr);
    CHECK_FALSE(bench.session.model.document().isDirty());

    const auto sound = folder / "own.pacini"; // whatever a sound is called
    std::filesystem::rename(recording(folder / "own.wav"), sound);
    auto imported = editor::importFile(sound, {});
    REQUIRE(imported);
    bench.session.sounds.add(std::move(*imported));
    const auto before = bytesOf(sound);
    bench.view.files().saveTo(sound);
    CHECK(bytesOf(sound) == before);
    CHECK(bench.session.model.document().path() == file);
}

TEST_CASE("The scene page asks before it replaces a file", "[overwrite]")
{
    const TempFolder folder;
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    REQUIRE(bench.view.doCommand(editor::editScene));
    auto* page = dynamic_cast<editor::SceneSheet*>(bench.view.sheet());
    REQUIRE(page != nullptr);
    page->parts().add(bench.session.model.activeId(), 0.0);
    const auto file = folder / "clip.json";
    REQUIRE(writeClip(file, bench.clip(), jsonFormat()));
    const auto before = bytesOf(file);
    page->write(file);
    REQUIRE(questionOver(*page) != nullptr);
    CHECK(questionOver(*page)->getDescription().contains("clip.json is a clip."));
    CHECK(bytesOf(file) == before);
    answer(*questionOver(*page), "Replace");
    CHECK(bytesOf(file) != before);
    CHECK(get<editor::NoticeBar>(bench.view, "Notice").text() == "Written: clip.json");
    page->write(folder / "fresh.json");
    CHECK(std::filesystem::exists(folder / "fresh.json"));
}
