// Drawing, bending, scaling, snapping and pasting in lanes, and versions that are compared.

#include "editor/Bench.h"
#include "editor/clip/lanes/CurveLane.h"
#include "editor/clip/lanes/LaneText.h"
#include "editor/clip/lanes/SelectionBar.h"
#include "editor/clip/session/ClipSteps.h"
#include "editor/clip/session/Snapping.h"

#include <cmath>

using namespace pacini;
using namespace pacini::test;

namespace
{
template <typename T>
T& childOf(juce::Component& parent)
{
    for (auto* child : parent.getChildren())
        if (auto* found = dynamic_cast<T*>(child))
            return *found;
    FAIL("no such child");
    throw 0;
}
} // namespace

TEST_CASE("With the pencil a drag draws the curve under the pointer with few points, in one step")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    const Clip before = bench.clip();
    auto& row = bench.row(envelope);
    bench.view.doCommand(editor::draw);
    REQUIRE(bench.session.viewState.isDrawing());
    const auto plot = row.plotArea().toFloat();
    Mouse mouse(row);
    const auto place = [&](int k)
    {
        return juce::Point<float>(plot.getX() + 100.0f + 4.0f * static_cast<float>(k),
                                  plot.getY() + 30.0f + 15.0f * std::sin(0.1f * static_cast<float>(k)));
    };
    mouse.press(place(0));
    for (int k = 1; k <= 80; ++k)
        mouse.drag(place(k));
    mouse.release(place(80));
    const Clip after = bench.clip();
    for (int k = 0; k < 80; ++k)
    {
        const double time = bench.session.viewState.axis().timeAt(100.0 + 4.0 * k);
        const float y = placeOf(row, bench.session, {time, valueAt(after.envelope, time)}).y;
        CHECK(std::abs(y - place(k).y) < 1.6f);
    }
    std::size_t drawn = 0;
    const double from = bench.session.viewState.axis().timeAt(100.0);
    const double to = bench.session.viewState.axis().timeAt(420.0);
    for (const Breakpoint& p : after.envelope)
        drawn += p.time >= from && p.time <= to ? 1 : 0;
    CHECK(drawn < 40);
    CHECK(valueAt(after.envelope, from - 0.05) == Approx(valueAt(before.envelope, from - 0.05)));
    CHECK(bench.session.model.document().steps().undoName() == "Draw");
    bench.session.model.undo();
    CHECK(bench.clip() == before);
    bench.view.doCommand(editor::draw);
    CHECK_FALSE(bench.session.viewState.isDrawing());
}

TEST_CASE("A line dragged with Ctrl bends to the pointer, its ends and all else stay")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    Clip plain = bench.clip();
    plain.envelope = {{0.0, 0.2}, {0.5, 0.1}, {1.5, 0.3}, {plain.duration, 0.2}};
    editor::setClip(bench.session.model, "Plain", plain);
    auto& row = bench.row(envelope);
    const auto from = placeOf(row, bench.session, {1.0, valueAt(plain.envelope, 1.0)});
    const auto to = from + juce::Point<float>(0.0f, -15.0f);
    Mouse(row, juce::ModifierKeys::commandModifier).dragFromTo(from, to);
    const Clip bent = bench.clip();
    CHECK(bent.envelope.size() > plain.envelope.size());
    CHECK(placeOf(row, bench.session, {1.0, valueAt(bent.envelope, 1.0)}).y == Approx(to.y).margin(0.7));
    for (const Breakpoint& p : plain.envelope)
        CHECK(std::find(bent.envelope.begin(), bent.envelope.end(), p) != bent.envelope.end());
    CHECK(bench.session.model.document().steps().undoName() == "Bend line");
    bench.session.model.undo();
    CHECK(bench.clip() == plain);
    // Away from the line it is a marquee.
    Mouse(row, juce::ModifierKeys::commandModifier).dragFromTo(to, to + juce::Point<float>(30.0f, -5.0f));
    CHECK(bench.clip() == plain);
}

TEST_CASE("A dragged point sticks to a transient within 8 pixels, unless Alt is held or snapping is off")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    Clip clip = bench.clip();
    clip.envelope = {{0.0, 0.2}, {0.5, 0.1}, {clip.duration, 0.2}};
    clip.transients = {{1.0, 0.5, 0.5}};
    editor::setClip(bench.session.model, "Plain", clip);
    auto& row = bench.row(envelope);
    const double perPixel = bench.session.viewState.axis().secondsPerPixel;
    const auto from = placeOf(row, bench.session, clip.envelope[1]);
    const auto target = placeOf(row, bench.session, {1.0 - 6.0 * perPixel, 0.1});
    const auto drag = [&](int flags)
    {
        Mouse(row, flags).dragFromTo(from, {target.x, from.y});
        const double time = bench.clip().envelope[1].time;
        bench.session.model.undo();
        return time;
    };
    CHECK(drag(0) == 1.0);
    CHECK(drag(juce::ModifierKeys::altModifier) == Approx(1.0 - 6.0 * perPixel).margin(0.6 * perPixel));
    bench.view.doCommand(editor::snap);
    CHECK(drag(0) == Approx(1.0 - 6.0 * perPixel).margin(0.6 * perPixel));
    bench.view.doCommand(editor::snap);
    CHECK(drag(0) == 1.0);
}

TEST_CASE("Each target of snapping counts when it is switched on, and what moves does not stick to itself")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    Clip clip = bench.clip();
    clip.transients = {{0.43, 0.5, 0.5}, {1.5, 0.5, 0.5}};
    clip.markers = {{0.7, "a"}};
    auto& session = bench.session;
    editor::setClip(session.model, "Plain", clip);
    session.transport.setPlayhead(1.1);
    const double perPixel = session.viewState.axis().secondsPerPixel;
    const double near = 7.0 * perPixel;
    const auto snapped = [&](double time, const editor::Snapping& snapping = {})
    {
        return editor::snapTime(session.model, session.viewState, session.transport, time, snapping);
    };
    CHECK(snapped(0.43 + near) == 0.43);
    CHECK(snapped(0.43 + 9.0 * perPixel) == 0.43 + 9.0 * perPixel);
    CHECK(snapped(0.7 - near) == 0.7);
    CHECK(snapped(1.1 + near) == 1.1);
    Selection moving;
    moving.transients = {0};
    editor::Snapping without;
    without.moving = &moving;
    without.marker = 0;
    without.playhead = false;
    for (const double time : {0.43 + near, 0.7 - near, 1.1 + near})
        CHECK(snapped(time, without) == time);
    SnapTargets only{true, true, false, false, false};
    session.viewState.setSnapTargets(only);
    CHECK(snapped(0.43 + near) != 0.43);
    const double line = 1.0; // a second is a line of the ruler at this zoom
    CHECK(snapped(line + 0.5 * perPixel) == Approx(line));
}

TEST_CASE("An end of the time range can be dragged in the ruler and sticks to transients")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    Clip clip = bench.clip();
    clip.transients = {{1.2, 0.5, 0.5}};
    auto& session = bench.session;
    editor::setClip(session.model, "Plain", clip);
    session.clipSelection.setTimeRange(TimeRange{0.5, 1.0});
    auto& ruler = childOf<editor::TimeRuler>(bench.view.clipView());
    const auto at = [&](double time)
    {
        return juce::Point<float>(static_cast<float>(editor::laneHeadWidth + session.viewState.axis().xOf(time)),
                                  20.0f);
    };
    Mouse(ruler).dragFromTo(at(1.0) + juce::Point<float>(3.0f, 0.0f), at(1.2) + juce::Point<float>(5.0f, 0.0f));
    REQUIRE(session.clipSelection.timeRange().has_value());
    CHECK(session.clipSelection.timeRange()->from == 0.5);
    CHECK(session.clipSelection.timeRange()->to == 1.2);
    CHECK(session.transport.playhead() == 0.0);
}

TEST_CASE("The ends of the selection's bar stretch it in time, Alt and arrow keys as well")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    Clip clip = bench.clip();
    clip.envelope = {{0.0, 0.2}, {0.4, 0.1}, {0.6, 0.4}, {0.8, 0.2}, {clip.duration, 0.2}};
    clip.transients.clear();
    auto& session = bench.session;
    editor::setClip(session.model, "Plain", clip);
    session.clipSelection.select(withPoints({}, envelope, {1, 2, 3}));
    auto& bar = childOf<editor::SelectionBar>(bench.view.clipView());
    const auto x = static_cast<float>(session.viewState.axis().xOf(0.8));
    REQUIRE(bar.hitTest(juce::roundToInt(x), 3));
    CHECK_FALSE(bar.hitTest(juce::roundToInt(session.viewState.axis().xOf(0.6)), 3));
    Mouse(bar, juce::ModifierKeys::altModifier).dragFromTo({x, 3.0f}, {x + 80.0f, 3.0f});
    const double longer = 80.0 * session.viewState.axis().secondsPerPixel;
    CHECK(bench.clip().envelope[1].time == 0.4);
    CHECK(bench.clip().envelope[2].time == Approx(0.6 + 0.5 * longer));
    CHECK(bench.clip().envelope[3].time == Approx(0.8 + longer));
    CHECK(session.model.document().steps().undoName() == "Stretch selection");
    session.model.undo();
    CHECK(bench.clip() == clip);

    auto& row = bench.row(envelope);
    const auto alt = [&](int code)
    {
        CHECK(row.keyPressed(juce::KeyPress(code, juce::ModifierKeys::altModifier, 0)));
    };
    alt(juce::KeyPress::rightKey);
    alt(juce::KeyPress::rightKey);
    CHECK(bench.clip().envelope[3].time == Approx(0.8 + 2.0 * session.viewState.axis().secondsPerPixel));
    CHECK(bench.clip().envelope[1] == clip.envelope[1]);
    alt(juce::KeyPress::upKey);
    CHECK(bench.clip().envelope[2].value / bench.clip().envelope[1].value == Approx(std::pow(4.0, 1.05)));
    session.model.undo();
    CHECK(bench.clip() == clip);
}

TEST_CASE("Version A is shown and played in place of the clip, cannot be edited, and can be taken")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    const Clip first = bench.clip();
    auto& session = bench.session;
    CHECK_FALSE(bench.view.doCommand(editor::compareWithA));
    REQUIRE(bench.view.doCommand(editor::keepVersionA));
    editor::editClip(session.model, "Gain", GainEdit{{}, -6.0});
    const Clip second = bench.clip();
    const auto state = session.model.document().snapshot().state;
    REQUIRE(bench.view.doCommand(editor::compareWithA));
    CHECK(bench.clip() == first);
    CHECK_FALSE(editor::editClip(session.model, "Gain", GainEdit{{}, -6.0}));
    CHECK(bench.view.sheet() != nullptr); // it says why
    bench.view.showSheet(nullptr);
    CHECK_FALSE(editor::setClip(session.model, "Change", second, session.model.beginGesture()));
    CHECK(bench.view.sheet() == nullptr);
    CHECK(session.model.document().snapshot().state == state);
    REQUIRE(bench.view.doCommand(editor::compareWithA));
    CHECK(bench.clip() == second);
    REQUIRE(bench.view.doCommand(editor::takeVersionA));
    CHECK(bench.clip() == first);
    CHECK(session.model.document().steps().undoName() == "Revert to version A");
    session.model.undo();
    CHECK(bench.clip() == second);
}

TEST_CASE("Undo, another clip and another project end a comparison")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    auto& session = bench.session;
    session.model.keepVersion();
    editor::editClip(session.model, "Gain", GainEdit{{}, -6.0});
    session.model.setComparing(true);
    session.model.undo();
    CHECK_FALSE(session.model.isComparing());
    session.model.setComparing(true);
    editor::duplicateShown(session.model);
    CHECK_FALSE(session.model.isComparing());
    CHECK(session.model.keptVersion() == nullptr); // it was kept of the other clip
    session.model.newProject();
    CHECK(session.model.clip() == nullptr);
}

TEST_CASE("Switching between clip and version A while playing makes no gap")
{
    EditorBench bench;
    Clip steady;
    steady.duration = 5.0;
    steady.bands.push_back({80.0, 100.0, 120.0, 0, {{0.0, 0.5}, {5.0, 0.5}}, {}});
    editor::Imported imported;
    imported.clip = steady;
    bench.session.sounds.add(std::move(imported));
    auto& session = bench.session;
    session.model.keepVersion();
    editor::editClip(session.model, "Gain", GainEdit{{}, -6.0206});
    session.player.prepare(48000.0);
    session.transport.play();
    std::vector<float> block(480);
    const auto level = [&]
    {
        float most = 0.0f;
        for (int i = 0; i < 2; ++i) // two periods of 100 Hz
        {
            const std::span<float> haptic(block);
            session.player.process(std::span(&haptic, 1), {});
            for (const float sample : block)
                most = std::max(most, std::abs(sample));
        }
        return most;
    };
    const auto until = [&](float low, float high)
    {
        float least = 1.0f;
        for (int i = 0; i < 2000; ++i)
        {
            const float now = level();
            least = std::min(least, now);
            if (now > low && now < high)
                return least;
            juce::Thread::sleep(1);
        }
        FAIL("the level was never reached");
        return 0.0f;
    };
    until(0.2f, 0.3f);
    const double before = session.transport.playhead();
    session.model.setComparing(true);
    CHECK(until(0.45f, 0.55f) > 0.2f);
    session.model.setComparing(false);
    CHECK(until(0.2f, 0.3f) > 0.2f);
    CHECK(session.transport.isPlaying());
    CHECK(session.transport.playhead() > before);
}

TEST_CASE("One key switches from haptic to sound and back")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    bench.view.doCommand(editor::hapticOrSound);
    CHECK(bench.session.transport.heard() == editor::Heard::sound);
    bench.view.doCommand(editor::hapticOrSound);
    CHECK(bench.session.transport.heard() == editor::Heard::haptic);
}

TEST_CASE("What was copied from one clip is pasted into another, and a single lane into the lane that is asked for")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    auto& session = bench.session;
    const Clip from = bench.clip();
    session.clipSelection.select(withPoints({}, envelope, allIndices(from.envelope.size())));
    session.clipSelection.copy();
    bench.openDemo("knock_wood_bridge");
    const Clip before = bench.clip();
    session.transport.setPlayhead(0.1);
    session.clipSelection.paste(session.transport.playhead());
    const double start = from.envelope.front().time;
    for (const double time : {0.2, 0.3})
        CHECK(valueAt(bench.clip().envelope, time) == Approx(valueAt(from.envelope, start + time - 0.1)));
    session.model.undo();
    session.clipSelection.paste(session.transport.playhead(), Lane{LaneKind::amplitude, 1});
    // The clip became longer for it; other lanes end as they did.
    for (double time = 0.0; time <= before.duration; time += 0.01)
        CHECK(valueAt(bench.clip().envelope, time) == Approx(valueAt(before.envelope, time)));
    CHECK(valueAt(bench.clip().bands[1].amplitude, 0.2) == Approx(valueAt(from.envelope, start + 0.1)));
    CHECK_FALSE(selectedIn(session.clipSelection.selected(), {LaneKind::amplitude, 1}).empty());
}

TEST_CASE("The number of a tick is whole, at the left of its line where need be, or not there")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    const juce::Image image(juce::Image::RGB, 100, 20, true);
    juce::Graphics g(image);
    const juce::Rectangle<int> line(0, 0, 100, 20);
    CHECK(editor::drawTickText(g, "0.5 s", 10, line, 0) > 14);
    CHECK(editor::drawTickText(g, "0.5 s", 95, line, 0) == 91);
    CHECK(editor::drawTickText(g, "0.5 s", 95, line, 90) == 90);  // would run into the one before
    CHECK(editor::drawTickText(g, "0.5 s", 104, line, 12) == 12); // its tick is out of sight
}
