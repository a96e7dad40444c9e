// Edits with arguments: their commands, sheets and previews.

#include "editor/clip/commands/Operations.h"

#include "document/MarkerEdits.h"
#include "editor/Bench.h"
#include "editor/clip/commands/HeldSwitch.h"
#include "editor/clip/session/ClipSteps.h"
#include "editor/clip/sheets/NameSheet.h"

#include <pacini/clip/edits/TimeEdits.h>
#include <pacini/clip/edits/TransientEdits.h>

#include <set>

using namespace pacini;
using namespace pacini::test;

namespace
{
editor::OperationSheet& sheetOf(EditorBench& bench)
{
    auto* sheet = dynamic_cast<editor::OperationSheet*>(bench.view.sheet());
    REQUIRE(sheet != nullptr);
    return *sheet;
}

/// What the message loop would do after a sheet was answered.
void close(EditorBench& bench)
{
    bench.view.showSheet(nullptr);
}
} // namespace

TEST_CASE("No two commands have one key or one number, and each says what it does")
{
    EditorBench bench;
    std::set<juce::String> keys;
    std::set<int> ids;
    for (const auto& menu : bench.view.menus().all())
        for (const auto& action : menu.actions)
        {
            INFO(action.name);
            CHECK(ids.insert(action.id).second);
            CHECK(juce::String(action.help).isNotEmpty());
            for (const auto& key : action.keys)
                CHECK(keys.insert(key.getTextDescription()).second);
        }
}

TEST_CASE("While a sheet is open the clip shows what it would do, and Cancel leaves no trace")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    const Clip before = bench.clip();
    editor::editClip(bench.session.model, "Fade in", FadeEdit{});
    bench.session.model.undo();
    const auto state = bench.session.model.document().snapshot().state;
    REQUIRE(bench.view.doCommand(editor::changeGain));
    CHECK(bench.clip() == before);
    sheetOf(bench).setValue(0, -6.0);
    CHECK(bench.session.model.isPreviewing());
    CHECK(valueAt(bench.clip().envelope, 0.5) == Approx(valueAt(before.envelope, 0.5) * std::pow(10.0, -6.0 / 20.0)));
    CHECK(*bench.session.model.item()->clip == before);
    close(bench);
    CHECK(bench.clip() == before);
    CHECK(bench.session.model.document().snapshot().state == state);
    CHECK(bench.session.model.document().steps().canRedo()); // what could be redone still can
}

TEST_CASE("Applying makes the previewed clip one step with the operation's name")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    const Clip before = bench.clip();
    const auto run =
        [&](editor::Command command, std::vector<std::pair<std::size_t, double>> values, const Clip& wanted)
    {
        REQUIRE(bench.view.doCommand(command));
        for (const auto& [field, value] : values)
            sheetOf(bench).setValue(field, value);
        const Clip shown = bench.clip();
        sheetOf(bench).apply();
        close(bench);
        CHECK(bench.clip() == shown);
        CHECK(bench.clip() == wanted);
        CHECK_FALSE(wanted == before);
        bench.session.model.undo();
        CHECK(bench.clip() == before);
    };
    run(editor::changeGain, {{0, 3.5}}, amplify(before, bench.session.clipSelection.scope(), 3.5));
    run(editor::quantise, {{0, 0.0}, {1, 0.25}, {4, 0.05}, {5, 80.0}},
        quantiseTimes(before, bench.session.clipSelection.scope(), {0.25, 0.05, 0.8}));
    // 90 beats a minute, sixteenths.
    run(editor::quantise, {{0, 1.0}, {2, 90.0}, {3, 5.0}, {4, 0.0}, {5, 100.0}},
        quantiseTimes(before, bench.session.clipSelection.scope(), {60.0 / 90.0 / 4.0, 0.0, 1.0}));
    run(editor::humanise, {{0, 12.0}, {1, 3.0}, {2, 1.0}, {3, 7.0}},
        pacini::humanise(before, bench.session.clipSelection.scope(), {0.012, 3.0, 1.0, 7}));
    run(editor::thinOut, {{0, 100.0}, {1, -20.0}}, thinTransients(before, {0.0, before.duration}, 0.1, 0.1));
    run(editor::transposePitch, {{0, 7.0}}, transpose(before, 7.0));
    run(editor::stretch, {{0, 0.0}, {1, 150.0}}, *stretchClip(before, 1.5));
    run(editor::repeatClipTimes, {{0, 3.0}}, *repeatClip(before, 3));
    REQUIRE(bench.view.doCommand(editor::stretch));
    sheetOf(bench).setValue(0, 1.0);
    sheetOf(bench).setValue(2, 2.5);
    sheetOf(bench).apply();
    close(bench);
    CHECK(bench.clip().duration == Approx(2.5));
    CHECK(bench.session.model.document().steps().undoName() == "Stretch");
}

TEST_CASE("An operation is for the selection, else for the time range, as the inspector says")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    const Clip before = bench.clip();
    bench.session.clipSelection.setTimeRange(TimeRange{0.5, 1.0});
    bench.view.doCommand(editor::changeGain);
    sheetOf(bench).setValue(0, -12.0);
    sheetOf(bench).apply();
    close(bench);
    CHECK(valueAt(bench.clip().envelope, 0.25) == valueAt(before.envelope, 0.25));
    CHECK(valueAt(bench.clip().envelope, 0.75) == Approx(valueAt(before.envelope, 0.75) * std::pow(10.0, -0.6)));
    bench.session.model.undo();
    bench.session.clipSelection.select(withPoints({}, {LaneKind::centroid, 0}, {1, 2, 3}));
    bench.view.doCommand(editor::invertCurves);
    CHECK(bench.clip().envelope == before.envelope);
    CHECK(bench.clip().transients == before.transients);
    CHECK_FALSE(bench.clip().centroid == before.centroid);
}

TEST_CASE("A selection that a preview makes shorter is whole again after Cancel")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    Selection all;
    all.transients = allIndices(bench.clip().transients.size());
    REQUIRE(all.transients.size() > 3);
    bench.session.clipSelection.select(all);
    bench.view.doCommand(editor::thinOut);
    sheetOf(bench).setValue(0, 500.0);
    CHECK(bench.session.clipSelection.selected().transients.size() < all.transients.size());
    for (const std::size_t i : bench.session.clipSelection.selected().transients)
        CHECK(i < bench.clip().transients.size());
    close(bench);
    CHECK(bench.session.clipSelection.selected() == all);
}

TEST_CASE("What a field holds stays within its range, and a sheet remembers what was applied")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    bench.view.doCommand(editor::quantise);
    sheetOf(bench).setValue(5, 4000.0);
    CHECK(sheetOf(bench).values()[5] == 100.0);
    sheetOf(bench).setValue(5, 35.0);
    sheetOf(bench).apply();
    close(bench);
    bench.session.model.undo();
    bench.view.doCommand(editor::quantise);
    CHECK(sheetOf(bench).values()[5] == 35.0);
    close(bench);
}

TEST_CASE("Applying what changes nothing is no step")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    const auto state = bench.session.model.document().snapshot().state;
    bench.view.doCommand(editor::changeGain);
    sheetOf(bench).setValue(0, 0.0);
    sheetOf(bench).apply();
    close(bench);
    CHECK(bench.session.model.document().snapshot().state == state);
}

TEST_CASE("Fades have their shapes, and both ends")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    const Clip before = bench.clip();
    const double quarter = 0.25 * before.duration;
    const double was = valueAt(before.envelope, quarter);
    bench.view.doCommand(editor::fadeIn);
    CHECK(valueAt(bench.clip().envelope, quarter) == Approx(0.25 * was).margin(0.002));
    bench.session.model.undo();
    bench.view.doCommand(editor::fadeInSmoothly);
    CHECK(valueAt(bench.clip().envelope, quarter) == Approx(0.1464 * was).margin(0.002));
    bench.session.model.undo();
    bench.view.doCommand(editor::fadeOutSmoothly);
    CHECK(valueAt(bench.clip().envelope, quarter) == Approx(0.8536 * was).margin(0.002));
    CHECK(bench.session.model.document().steps().undoName() == "Smooth fade out");
}

TEST_CASE("A clip is split at the playhead and joined with the next again")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    const Clip before = bench.clip();
    CHECK_FALSE(bench.view.doCommand(editor::splitClipHere)); // at the start there is nothing to split
    CHECK_FALSE(bench.view.doCommand(editor::joinWithNext));
    bench.session.transport.setPlayhead(1.0);
    REQUIRE(bench.view.doCommand(editor::splitClipHere));
    CHECK(bench.session.model.document().project().clips.size() == 2);
    CHECK(bench.clip().duration == Approx(1.0));
    REQUIRE(bench.view.doCommand(editor::joinWithNext));
    CHECK(bench.session.model.document().project().clips.size() == 1);
    CHECK(bench.clip().duration == Approx(before.duration));
    CHECK(bench.clip().transients.size() == before.transients.size());
    bench.session.model.undo();
    bench.session.model.undo();
    CHECK(bench.clip() == before);
}

TEST_CASE("A held key switches for as long, a tapped one for good")
{
    editor::HeldSwitch key;
    CHECK(key.press(1000));
    CHECK_FALSE(key.press(1600)); // repeats
    CHECK(key.release(2000));
    CHECK(key.press(3000));
    CHECK_FALSE(key.release(3100));
    CHECK_FALSE(key.release(9000));
}

TEST_CASE("Markers are added at the playhead, found, renamed, dragged and removed, each a step of undo")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    const Clip before = bench.clip();
    auto& session = bench.session;
    session.transport.setPlayhead(0.8);
    REQUIRE(bench.view.doCommand(editor::addMarker));
    session.transport.setPlayhead(0.3);
    REQUIRE(bench.view.doCommand(editor::addMarker));
    CHECK(bench.clip().markers == std::vector<Marker>{{0.3, "Marker 2"}, {0.8, "Marker 1"}});
    session.transport.setPlayhead(0.0);
    CHECK_FALSE(bench.view.doCommand(editor::deleteMarker));
    bench.view.doCommand(editor::nextMarker);
    bench.view.doCommand(editor::nextMarker);
    CHECK(session.transport.playhead() == 0.8);
    bench.view.doCommand(editor::markerBack);
    CHECK(session.transport.playhead() == 0.3);
    REQUIRE(bench.view.doCommand(editor::renameMarker));
    CHECK(dynamic_cast<editor::NameSheet*>(bench.view.sheet()) != nullptr);
    bench.view.showSheet(nullptr);
    REQUIRE(bench.view.doCommand(editor::deleteMarker));
    CHECK(bench.clip().markers == std::vector<Marker>{{0.8, "Marker 1"}});
    CHECK(session.model.document().steps().undoName() == "Delete marker");

    // A drag in the strip below the ruler.
    juce::Component* strip = nullptr;
    for (auto* child : bench.view.clipView().getChildren())
        if (child->getTitle() == "Markers")
            strip = child;
    REQUIRE(strip != nullptr);
    CHECK(strip->isVisible());
    const double perPixel = session.viewState.axis().secondsPerPixel;
    const juce::Point<float> from(static_cast<float>(editor::laneHeadWidth + session.viewState.axis().xOf(0.8)) + 2.0f,
                                  8.0f);
    Mouse(*strip, juce::ModifierKeys::altModifier).dragFromTo(from, from + juce::Point<float>(50.0f, 0.0f));
    REQUIRE(bench.clip().markers.size() == 1);
    CHECK(bench.clip().markers[0].time == Approx(0.8 + 50.0 * perPixel));
    CHECK(session.model.document().steps().undoName() == "Move marker");
    for (int i = 0; i < 4; ++i)
        session.model.undo();
    CHECK(bench.clip() == before);
    CHECK_FALSE(strip->isVisible());
}
