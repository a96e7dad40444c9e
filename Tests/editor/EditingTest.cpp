// What a designer does with mouse and keys, without a screen.

#include "document/ClipExport.h"
#include "document/KeepShare.h"
#include "document/ProjectEdits.h"
#include "editor/Bench.h"
#include "editor/clip/session/ClipSteps.h"
#include "io/ClipFile.h"
#include "support/TempFolder.h"

#include <algorithm>
#include <cmath>
#include <variant>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// A point away from both ends and from its neighbours, and not near silence.
std::size_t freePoint(const Curve& curve, double distance)
{
    for (std::size_t i = 1; i + 1 < curve.size(); ++i)
        if (curve[i].value > 0.05 && curve[i].value < 0.5 && curve[i].time - curve[i - 1].time > distance &&
            curve[i + 1].time - curve[i].time > distance)
            return i;
    FAIL("no such point");
    return 0;
}
} // namespace

TEST_CASE("A demo sound becomes a clip, a dragged breakpoint goes where the pointer went, undo brings it back, and the "
          "exported JSON holds just that")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    const Clip before = bench.clip();
    bench.session.viewState.showRange({0.0, 0.5 * before.duration});
    auto& row = bench.row(envelope);
    const double perPixel = bench.session.viewState.axis().secondsPerPixel;
    const std::size_t i = freePoint(before.envelope, 12.0 * perPixel);
    const auto from = placeOf(row, bench.session, before.envelope[i]);
    const juce::Point<float> offset(8.0f, -10.0f);
    Mouse(row, juce::ModifierKeys::altModifier).dragFromTo(from, from + offset);

    Clip expected = before;
    expected.envelope[i].time += 8.0 * perPixel;
    expected.envelope[i].value *= std::pow(10.0, 60.0 * 10.0 / row.plotArea().getHeight() / 20.0);
    const Clip after = bench.clip();
    REQUIRE(after.envelope.size() == before.envelope.size());
    CHECK(after.envelope[i].time == Approx(expected.envelope[i].time).epsilon(1e-5));
    CHECK(after.envelope[i].value == Approx(expected.envelope[i].value).epsilon(1e-5));
    expected.envelope[i] = after.envelope[i];
    CHECK(after == expected);
    CHECK(bench.session.model.document().steps().undoName() == "Move point");

    TempFolder folder;
    ExportChoice choice;
    choice.folder = folder.path();
    choice.file = "edited.json";
    REQUIRE(exportClips({bench.session.model.clip()}, choice).ok());
    const auto exported = readClip(folder.path() / "edited.json");
    REQUIRE(exported.ok());
    CHECK(exported->clip == expected);

    // The whole drag is one step.
    bench.session.model.undo();
    CHECK(bench.clip() == before);
    CHECK(bench.session.model.document().steps().undoName() != "Move point");
    bench.session.model.redo();
    CHECK(bench.clip() == expected);
}

TEST_CASE("A double-click adds a point there, Delete removes it, and both can be undone")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    const Clip before = bench.clip();
    auto& row = bench.row(envelope);
    const juce::Point<float> where(static_cast<float>(row.plotArea().getX()) + 501.0f, 20.0f);
    Mouse(row).doubleClick(where);
    const Clip with = bench.clip();
    REQUIRE(with.envelope.size() == before.envelope.size() + 1);
    REQUIRE(selectedCount(bench.session.clipSelection.selected()) == 1);
    const Breakpoint added = with.envelope[bench.session.clipSelection.selected().lanes.front().points.front()];
    CHECK(added.time == Approx(501.0 * bench.session.viewState.axis().secondsPerPixel));
    CHECK(20.0 * std::log10(added.value) == Approx(-60.0 * 20.0 / row.plotArea().getHeight()));
    CHECK(bench.view.doCommand(editor::deleteSelection));
    CHECK(bench.clip() == before);
    bench.session.model.undo();
    CHECK(bench.clip() == with);
    bench.session.model.undo();
    CHECK(bench.clip() == before);
}

TEST_CASE("Transients are added, moved with their level, made sharper and deleted")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    const Clip before = bench.clip();
    auto& row = *bench.view.clipView().eventRow();
    const juce::Point<float> where(static_cast<float>(row.plotArea().getX()) + 333.0f, 30.0f);
    Mouse(row).doubleClick(where);
    REQUIRE(bench.clip().transients.size() == before.transients.size() + 1);
    const std::size_t i = bench.session.clipSelection.selected().transients.front();
    const Transient added = bench.clip().transients[i];
    Mouse(row, juce::ModifierKeys::altModifier).dragFromTo(where, where + juce::Point<float>(0.0f, 12.0f));
    const Transient lower = bench.clip().transients[bench.session.clipSelection.selected().transients.front()];
    CHECK(lower.time == added.time);
    CHECK(lower.amplitude < 0.9 * added.amplitude);
    SelectionMove sharper;
    sharper.sharpness = 0.25;
    bench.session.clipSelection.setEdited("Sharper",
                                          moveSelected(bench.clip(), bench.session.clipSelection.selected(), sharper));
    CHECK(bench.clip().transients[bench.session.clipSelection.selected().transients.front()].sharpness ==
          Approx(added.sharpness + 0.25));
    bench.view.doCommand(editor::deleteSelection);
    CHECK(bench.clip() == before);
}

TEST_CASE("A marquee over several lanes selects what is inside, and moves it together")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    const Clip before = bench.clip();
    bench.session.viewState.showRange({0.0, 1.0});
    auto& row = bench.row(envelope);
    auto& next = bench.row({LaneKind::centroid, 0});
    const auto plot = row.plotArea();
    const int below = next.getY() - row.getY() + next.getHeight() - 2;
    const double perPixel = bench.session.viewState.axis().secondsPerPixel;
    // Begins where no point is near.
    juce::Point<float> from(static_cast<float>(plot.getX()) + 100.0f, 1.0f);
    Mouse(row).dragFromTo(from, {from.x + 400.0f, static_cast<float>(below)});
    const Selection selected = bench.session.clipSelection.selected();
    std::size_t inside = 0;
    for (const Curve* curve : {&before.envelope, &before.centroid})
        for (const Breakpoint& p : *curve)
            inside += p.time >= 100.0 * perPixel && p.time <= 500.0 * perPixel ? 1 : 0;
    CHECK(inside > 4);
    CHECK(selectedCount(selected) == inside);
    CHECK(selected.lanes.size() == 2);
    CHECK(row.keyPressed(juce::KeyPress(juce::KeyPress::rightKey)));
    CHECK(row.keyPressed(juce::KeyPress(juce::KeyPress::rightKey)));
    const Clip after = bench.clip();
    CHECK(timeOf(bench.session.clipSelection.selected(), after)->from ==
          Approx(timeOf(selected, before)->from + 2.0 * perPixel));
    bench.session.model.undo(); // both presses are one step
    CHECK(bench.clip() == before);
}

TEST_CASE("Gain, fades, reverse, cut and paste go through the document with their names")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    const Clip before = bench.clip();
    REQUIRE(bench.view.doCommand(editor::fadeIn));
    CHECK(bench.session.model.document().steps().undoName() == "Fade in");
    CHECK(valueAt(bench.clip().envelope, 0.0) == 0.0);
    bench.view.doCommand(editor::undo);
    REQUIRE(bench.view.doCommand(editor::reverse));
    CHECK(bench.clip().transients.size() == before.transients.size());
    CHECK(bench.clip().transients.front().time == Approx(before.duration - before.transients.back().time));
    bench.view.doCommand(editor::undo);
    CHECK(bench.clip() == before);

    bench.session.clipSelection.setTimeRange(TimeRange{0.5, 1.0});
    REQUIRE(bench.view.doCommand(editor::copy));
    bench.session.transport.setPlayhead(1.5);
    REQUIRE(bench.view.doCommand(editor::paste));
    CHECK(valueAt(bench.clip().envelope, 1.7) == Approx(valueAt(before.envelope, 0.7)));
    CHECK(bench.clip().duration == before.duration);
    bench.view.doCommand(editor::undo);
    REQUIRE(bench.view.doCommand(editor::cut));
    CHECK(bench.clip().duration == Approx(before.duration - 0.5));
}

TEST_CASE("What is pasted beyond the end extends the clip, in one step, and says so")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    const Clip before = bench.clip();
    juce::String said;
    bench.session.model.onNotice = [&](const juce::String& text)
    {
        said = text;
    };
    bench.session.clipSelection.setTimeRange(TimeRange{0.5, 1.0});
    REQUIRE(bench.view.doCommand(editor::copy));
    bench.session.transport.setPlayhead(before.duration - 0.1);
    REQUIRE(bench.view.doCommand(editor::paste));
    const Clip longer = bench.clip();
    CHECK(longer.duration == Approx(before.duration + 0.4));
    CHECK(said == "Pasted beyond the end: the clip is 0.40 s longer");
    CHECK(valueAt(longer.envelope, before.duration + 0.3) == Approx(valueAt(before.envelope, 0.9)));
    const auto hits = [](const Clip& clip, double from, double to)
    {
        return std::count_if(clip.transients.begin(), clip.transients.end(),
                             [&](const Transient& event) { return event.time >= from && event.time <= to; });
    };
    CHECK(hits(longer, before.duration - 0.1, longer.duration) == hits(before, 0.5, 1.0));
    CHECK(bench.session.model.document().steps().undoName() == "Paste");
    bench.view.doCommand(editor::undo);
    CHECK(bench.clip() == before);
    bench.view.doCommand(editor::redo);
    CHECK(bench.clip() == longer);
    // Both are edits over the analysis, and not another clip in its place.
    const auto item = bench.session.model.item();
    bench.session.model.change(
        [&](Document& document)
        {
            return document.commit("Again", withAnalysis(document.project(), item->encoder, {item->id, *item->analysis},
                                                         document.steps().newIds().source));
        });
    CHECK(bench.clip() == longer);
    CHECK(bench.session.model.item()->unfitting.empty());
    for (const auto& edit : bench.session.model.item()->edits.whole())
        CHECK_FALSE(std::holds_alternative<ReplaceEdit>(edit->operation));
}

TEST_CASE("A single lane that is pasted beyond the end leaves silence in the others")
{
    EditorBench bench;
    editor::Imported imported;
    imported.clip.duration = 1.0;
    imported.clip.envelope = {{0.0, 0.5}, {1.0, 0.5}};
    imported.clip.bands = {{40.0, 50.0, 60.0, 0, {{0.0, 0.4}, {1.0, 0.4}}, {}}};
    bench.session.sounds.add(std::move(imported));
    bench.session.clipSelection.select(withPoints({}, envelope, {0, 1}));
    REQUIRE(bench.view.doCommand(editor::copy));
    bench.session.clipSelection.select({});
    bench.session.clipSelection.paste(0.5, envelope);
    const Clip longer = bench.clip();
    CHECK(longer.duration == Approx(1.5));
    CHECK(valueAt(longer.envelope, 1.4) == Approx(0.5));
    CHECK(valueAt(longer.bands[0].amplitude, 0.9) == Approx(0.4));
    CHECK(valueAt(longer.bands[0].amplitude, 1.1) == 0.0);
}

TEST_CASE("Smaller and larger interface work with the characters that Shift makes of - and + on US and German keys")
{
    EditorBench bench;
    const auto press = [&](juce::juce_wchar key)
    {
        return bench.view.menus().keys()->keyPressed(
            juce::KeyPress(static_cast<int>(key),
                           juce::ModifierKeys::commandModifier | juce::ModifierKeys::shiftModifier, key),
            &bench.view);
    };
    CHECK(press('_'));
    CHECK(bench.view.scale() == 0.75);
    CHECK(press('*'));
    CHECK(bench.view.scale() == 1.0);
    CHECK(press('+'));
    CHECK(bench.view.scale() == 1.25);
    CHECK(press('-'));
    CHECK(bench.view.scale() == 1.0);
}

TEST_CASE("Simplifying keeps the wanted share of points and tells the error that it made")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    const Clip before = bench.clip();
    const std::vector<Lane> lanes{envelope};
    const auto simplified = keepShare(before, lanes, 0.3);
    REQUIRE(simplified.ok());
    CHECK(simplified->clip.envelope.size() <= before.envelope.size() * 3 / 10 + 1);
    double worst = 0.0; // at a point of either curve, since both are straight between them
    for (const Curve* curve : {&before.envelope, &simplified->clip.envelope})
        for (const Breakpoint& p : *curve)
            worst = std::max(worst,
                             std::abs(valueAt(before.envelope, p.time) - valueAt(simplified->clip.envelope, p.time)));
    CHECK(simplified->cost.amplitudeError == Approx(worst));
}

TEST_CASE("A project that is saved and opened again shows the same, and only changes make it dirty")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    bench.view.doCommand(editor::fadeOut);
    const Clip before = bench.clip();
    TempFolder folder;
    REQUIRE(bench.session.model.saveAs(folder.path() / "one.pacini").ok());
    CHECK_FALSE(bench.session.model.document().isDirty());
    bench.view.doCommand(editor::fadeOut);
    CHECK(bench.session.model.document().isDirty());
    bench.view.doCommand(editor::undo);
    CHECK_FALSE(bench.session.model.document().isDirty());
    bench.session.model.newProject();
    CHECK(bench.session.model.isEmpty());
    REQUIRE(bench.session.model.openProject(folder.path() / "one.pacini").ok());
    CHECK(bench.clip() == before);
}

TEST_CASE("What an autosave wrote is offered and restored with all edits")
{
    TempFolder folder;
    Clip edited;
    {
        const juce::ScopedJuceInitialiser_GUI gui;
        editor::Session session({folder.path() / "recovery", {}}, {});
        auto imported = editor::importFile(demoSound("knock_wood_bridge"), EncoderParams{});
        REQUIRE(imported.ok());
        session.sounds.add(std::move(imported).value());
        editor::editClip(session.model, "Gain", GainEdit{{}, -6.0});
        edited = *session.model.clip();
    }
    // Nobody holds it any more, though the process that wrote it still runs.
    const juce::ScopedJuceInitialiser_GUI gui;
    editor::Session session({folder.path() / "recovery", {}}, {});
    const auto offered = session.model.recoverable();
    REQUIRE(offered.size() == 1);
    REQUIRE(session.model.recover(offered.front()).ok());
    CHECK(session.model.recoverable().empty()); // it is this session's now
    CHECK(*session.model.clip() == edited);
    CHECK(session.model.document().isDirty());
}
