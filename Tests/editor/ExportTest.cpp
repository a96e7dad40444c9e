// Export in several formats at once, and the table of what each loses.

#include "editor/Bench.h"
#include "editor/Pump.h"
#include "editor/clip/sheets/ExportSheet.h"
#include "editor/clip/sheets/LossTable.h"
#include "support/TempFolder.h"

#include <filesystem>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
FormatLoss loss(double time, double error, const std::string& message, LossKind kind = LossKind::points)
{
    return {kind, time, 0.1, error, message};
}

editor::ExportSheet& exportOf(EditorBench& bench)
{
    bench.view.showSheet(nullptr);
    REQUIRE(bench.view.doCommand(editor::exportClips));
    auto* sheet = dynamic_cast<editor::ExportSheet*>(bench.view.sheet());
    REQUIRE(sheet != nullptr);
    return *sheet;
}

void type(editor::ExportSheet& sheet, const std::filesystem::path& path)
{
    auto& target = get<juce::TextEditor>(sheet, "Destination file or folder");
    target.setText(juce::String(path.string()), false);
    target.onTextChange();
}
} // namespace

TEST_CASE("Losses that say the same are one row with their number, and the worst of them")
{
    const auto groups =
        editor::groupedLosses({loss(0.1, 0.2, "3 points were left out"), loss(0.5, 0.0, "is quiet"),
                               loss(0.7, 0.4, "12 points were left out"), loss(0.9, 0.1, "2 points were left out"),
                               loss(1.2, 0.9, "2 points were left out", LossKind::event)});
    REQUIRE(groups.size() == 3);
    CHECK(groups[0].count == 3);
    CHECK(groups[0].worst.time == 0.7);
    CHECK(groups[0].worst.message == "12 points were left out");
    CHECK(groups[1].count == 1);
    CHECK(groups[2].worst.kind == LossKind::event);
}

TEST_CASE("Several formats are written at once, each beside the other, and none under the name of another")
{
    const TempFolder folder;
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    {
        auto& sheet = exportOf(bench);
        type(sheet, folder / "door.json");
        sheet.setAlso("ahap", true);
        sheet.setAlso("haptic", true);
        sheet.setAlso("android", true); // .json as well
        sheet.setAlso("haptic", false);
        CHECK(get<juce::TextButton>(sheet, "Further formats").getButtonText() ==
              juce::String::fromUTF8("+ 2 formats…"));
        answer(sheet, "Export");
        REQUIRE(pumpUntil([&] { return bench.view.sheet() == nullptr; }));
    }
    CHECK(std::filesystem::exists(folder / "door.json"));
    CHECK(std::filesystem::exists(folder / "door.ahap"));
    CHECK(std::filesystem::exists(folder / "door-android.json"));
    CHECK_FALSE(std::filesystem::exists(folder / "door.haptic"));
    CHECK(bench.view.lastExport.also == std::vector<std::string>{"ahap", "android"});
    // The next export begins with them, and asks for each file that is there.
    auto& again = exportOf(bench);
    type(again, folder / "door.json");
    std::filesystem::remove(folder / "door.json");
    std::filesystem::remove(folder / "door-android.json");
    std::filesystem::resize_file(folder / "door.ahap", 3);
    answer(again, "Export");
    REQUIRE(pumpUntil([&] { return questionOver(again) != nullptr; }));
    CHECK(questionOver(again)->getTitle() == "Replace door.ahap?");
    CHECK_FALSE(std::filesystem::exists(folder / "door.json"));
}

TEST_CASE("A loss of the table is shown in the clip, and the choices of the export are kept")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    auto& sheet = exportOf(bench);
    auto& format = get<juce::ComboBox>(sheet, "Format");
    const auto& formats = exportFormats();
    for (std::size_t i = 0; i < formats.size(); ++i)
        if (formats[i].name == "ahap")
            format.setSelectedId(1 + static_cast<int>(i), juce::sendNotificationSync);
    auto& table = get<editor::LossTable>(sheet, "Losses");
    REQUIRE(pumpUntil([&] { return !table.isEmpty(); }));
    CHECK(table.isVisible());
    CHECK(table.getNumRows() < 12);
    CHECK(table.getNameForRow(0).isNotEmpty());
    bench.session.transport.setPlayhead(0.0);
    table.onPlace(bench.session.model.activeId(), 0.5, 0.1);
    REQUIRE(pumpUntil([&] { return bench.view.sheet() == nullptr; }));
    CHECK(bench.session.transport.playhead() == Approx(0.5));
    const auto shown = bench.session.viewState.axis().visible(bench.session.viewState.viewWidth());
    CHECK(shown.from > 0.1);
    CHECK(shown.to < bench.clip().duration);
    CHECK(bench.view.lastExport.format == "ahap");
    CHECK_FALSE(bench.view.statusBar().steps().exported); // nothing was
}

TEST_CASE("What is kept has the height of its words, and the fields stay where they are when a table comes")
{
    const TempFolder folder;
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    auto& sheet = exportOf(bench);
    auto& words = get<juce::TextEditor>(sheet, "What is kept and what is lost");
    auto& table = get<editor::LossTable>(sheet, "Losses");
    auto& target = get<juce::TextEditor>(sheet, "Destination file or folder");
    REQUIRE(pumpUntil([&] { return words.getText().contains("No losses."); }));
    CHECK(words.getHeight() <= words.getTextHeight() + 2 * editor::grid);
    CHECK_FALSE(table.isVisible());
    const auto place = target.getBounds();
    type(sheet, folder / "drums.ahap");
    REQUIRE(pumpUntil([&] { return table.isVisible(); }));
    CHECK(target.getBounds() == place);
    CHECK(table.getHeight() > 15 * editor::grid);
    CHECK(table.getY() >= words.getBottom());
}

TEST_CASE("What is kept and lost is said of each format and each clip that would be written")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    bench.openDemo("knock_wood_bridge");
    auto& sheet = exportOf(bench);
    auto& words = get<juce::TextEditor>(sheet, "What is kept and what is lost");
    auto& table = get<editor::LossTable>(sheet, "Losses");
    REQUIRE(pumpUntil([&] { return words.getText().contains("No losses."); }));
    sheet.setAlso("ahap", true);
    REQUIRE(pumpUntil([&] { return !table.isEmpty(); }));
    CHECK(words.getText().contains("One voice: intensity curve")); // and not "Keeps everything" alone
    const int ofOne = table.getNumRows();
    auto& all = get<juce::ToggleButton>(sheet, "Export all clips");
    all.setToggleState(true, juce::sendNotificationSync);
    all.onClick();
    REQUIRE(pumpUntil([&] { return table.getNumRows() > ofOne; }));
    juce::String titles;
    for (int row = 0; row < table.getNumRows(); ++row)
        titles << table.getNameForRow(row) << "\n";
    CHECK(titles.contains("drums_tabla_pattern"));
    CHECK(titles.contains("knock_wood_bridge"));
}
