// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/PlotLane.h"

#include "document/SelectionScale.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/lanes/LaneText.h"
#include "editor/clip/session/ClipSteps.h"
#include "editor/clip/session/Snapping.h"
#include "editor/clip/session/StepText.h"

#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr int leastForTicks = 60;        // pixels of a plot that has them inside
constexpr int edgeOfThings = 9;          // pixels to either side of what has changed
constexpr double floorAmplitude = 0.001; // -60 dB
constexpr double tickGap = 15.0;         // pixels between marks of the scale
constexpr int tickWidth = 26;

constexpr juce::uint32 nudgePause = 700; // ms: presses nearer than this are one step of undo
constexpr double spreadStep = 1.05;      // of differences of levels, a press
} // namespace

PlotLane::PlotLane(EditorModel& project, ClipSelection& selected, ViewState& sight, Transport& playing)
    : model(project), clipSelection(selected), viewState(sight), transport(playing), drawn(project.clip())
{
    setOpaque(true);
    setWantsKeyboardFocus(true);
    subscriptions.on({&model.contentChanged},
                     [this]
                     {
                         if (!repaintChanged())
                             repaintAll();
                     });
    subscriptions.on({&viewState.lookChanged}, [this] { repaintAll(); });
    subscriptions.on({&viewState.axisChanged, &clipSelection.rangeChanged}, [this] { repaint(plotArea()); });
    subscriptions.on({&clipSelection.changed},
                     [this]
                     {
                         if (auto now = picked(); now != std::exchange(drawnPicked, now))
                             repaint(plotArea());
                     });
}

bool PlotLane::repaintChanged()
{
    const auto before = std::exchange(drawn, model.clip());
    const auto pickedBefore = std::exchange(drawnPicked, picked());
    const auto scaleBefore = scaleNow;
    forgetScale();
    if (!before || !drawn || before->duration != drawn->duration || !scaleBefore || scale() != *scaleBefore ||
        pickedBefore != drawnPicked)
        return false;
    const auto range = changedTime(*before, *drawn);
    if (!range)
        return false;
    if (range->from > range->to)
        return true;
    const auto plot = plotArea();
    const auto xOf = [&](double time)
    {
        return juce::roundToInt(std::clamp(viewState.axis().xOf(time), -100.0, plot.getWidth() + 100.0));
    };
    const int from = xOf(range->from) - edgeOfThings;
    const int to = xOf(range->to) + edgeOfThings;
    repaint(plot.getIntersection(plot.withX(plot.getX() + from).withWidth(to - from)));
    if (style().note != drawnNote)
        repaint(getLocalBounds().withWidth(laneHeadWidth));
    return true;
}

void PlotLane::repaintAll()
{
    forgetScale();
    drawn = model.clip();
    drawnPicked = picked();
    repaint();
}

ValueAxis PlotLane::amplitudeAxis(bool decibels, double highest, double height)
{
    ValueAxis axis;
    axis.scale = decibels ? ValueScale::decibels : ValueScale::linear;
    axis.low = decibels ? floorAmplitude : 0.0;
    axis.high = std::max(1.0, highest);
    axis.height = std::max(1.0, height);
    return axis;
}

SelectionMove PlotLane::amplitudeMove(double from, double to)
{
    SelectionMove move;
    if (from > 0.0)
        move.amplitudeFactor = std::max(0.0, to) / from;
    else
        move.amplitudeOffset = std::max(0.0, to); // silence has no ratio
    return move;
}

const ValueAxis& PlotLane::scale() const
{
    const double height = std::max(1, plotArea().getHeight());
    if (!scaleNow || scaleNow->height != height)
        scaleNow = valueAxis(height);
    return *scaleNow;
}

juce::Point<float> PlotLane::pointOf(Breakpoint p) const
{
    const auto area = plotArea();
    return {static_cast<float>(area.getX() + viewState.axis().xOf(p.time)),
            static_cast<float>(area.getY() + scale().yOf(p.value))};
}

Breakpoint PlotLane::placeAt(juce::Point<float> position) const
{
    const auto area = plotArea();
    return {viewState.axis().timeAt(static_cast<double>(position.x) - area.getX()),
            scale().valueAtY(static_cast<double>(position.y) - area.getY())};
}

// Painting.

void PlotLane::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    const auto plot = plotArea();
    const auto clipped = g.getClipBounds();
    g.fillAll(p.card);
    if (clipped.getX() < plot.getX())
        paintHead(g);
    g.setColour(p.line);
    g.fillRect(getLocalBounds().removeFromBottom(1));
    const auto visible = clipped.getIntersection(plot);
    if (visible.isEmpty())
        return;
    const juce::Graphics::ScopedSaveState saved(g);
    g.reduceClipRegion(visible);
    g.setColour(p.well);
    g.fillRect(visible);
    if (const auto& range = clipSelection.timeRange())
    {
        const auto from = static_cast<float>(plot.getX() + viewState.axis().xOf(range->from));
        const auto to = static_cast<float>(plot.getX() + viewState.axis().xOf(range->to));
        g.setColour(p.accent.withAlpha(0.10f));
        g.fillRect(juce::Rectangle<float>(from, static_cast<float>(plot.getY()), to - from,
                                          static_cast<float>(plot.getHeight())));
    }
    const ValueAxis axis = scale();
    g.setColour(p.line.withAlpha(0.6f));
    for (const double value : valueTicks(axis, tickGap))
        g.fillRect(plot.getX(), plot.getY() + juce::roundToInt(axis.yOf(value)), plot.getWidth(), 1);
    if (const auto clip = model.clip())
    {
        paintPlot(g, plot, visible.getX() - plot.getX(), visible.getRight() - plot.getX());
        // Behind the clip's end there is nothing.
        const int end = plot.getX() + juce::roundToInt(std::min(1e6, viewState.axis().xOf(clip->duration)));
        if (end < plot.getRight())
        {
            g.setColour(p.background);
            g.fillRect(plot.withLeft(std::max(plot.getX(), end)));
        }
    }
    // Its head is full of buttons; in a low lane numbers would cover the curve, whose scale is that of the others.
    if (getNumChildComponents() > 0 && plot.getHeight() >= leastForTicks)
        paintTicks(g, plot.withTrimmedLeft(3).withWidth(tickWidth), juce::Justification::centredLeft);
    if (hovered && *hovered < count())
    {
        const auto centre = pointOf(place(*hovered));
        g.setColour(p.text);
        g.drawEllipse(juce::Rectangle<float>(11.0f, 11.0f).withCentre(centre), 1.5f);
    }
}

void PlotLane::paintHead(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    const Style look = style();
    auto head = getLocalBounds().removeFromLeft(laneHeadWidth).withTrimmedBottom(1);
    g.setColour(look.colour);
    g.fillRect(head.removeFromLeft(3));
    if (hasKeyboardFocus(false))
    {
        g.setColour(p.accent);
        g.drawRect(head, 2);
    }
    drawnNote = look.note;
    const bool besideButtons = getNumChildComponents() > 0;
    if (!besideButtons)
        paintTicks(g, head.withTrimmedRight(4).removeFromRight(tickWidth), juce::Justification::centredRight);
    auto text = head.withTrimmedLeft(grid).withTrimmedRight(besideButtons ? 0 : tickWidth);
    for (const auto* button : getChildren())
        text.setRight(std::min(text.getRight(), button->getX() - grid / 2));
    g.setColour(p.text);
    constexpr int nameHeight = 19, noteHeight = 17;
    const bool two = look.note.isNotEmpty() && text.getHeight() >= nameHeight + noteHeight + 2;
    const bool three = look.behind.isNotEmpty() && text.getHeight() >= nameHeight + 2 * noteHeight + 2;
    if (two)
        text = text.withSizeKeepingCentre(text.getWidth(), nameHeight + (three ? 2 : 1) * noteHeight);
    const bool technical = viewState.viewOptions().technicalTerms;
    const auto name = tr(technical ? look.name : designerWord(look.name));
    // "1.25 kHz" has the room of "864 Hz" beside buttons.
    g.setFont(fittingFont(name, text.getWidth(), {usualFont(), smallFont(), captionFont()}));
    g.drawFittedText(name, two ? text.removeFromTop(nameHeight) : text, juce::Justification::centredLeft, 1);
    if (!two)
        return;
    g.setColour(p.dim);
    g.setFont(smallFont());
    g.drawFittedText(look.note, text.removeFromTop(noteHeight), juce::Justification::centredLeft, 1);
    if (!three)
        return;
    g.fillRect(text.removeFromLeft(2 * grid).withSizeKeepingCentre(2 * grid, 1));
    g.drawText(look.behind, text.withTrimmedLeft(grid / 2), juce::Justification::centredLeft, true);
}

juce::String PlotLane::tickText(double value) const
{
    if (scale().scale == ValueScale::decibels)
        return juce::String(juce::roundToInt(Decibels::fromGain(value).value));
    return value >= 1000.0 ? numberText(value / 1000.0, 0) + "k"
           : value >= 10.0 ? juce::String(juce::roundToInt(value))
                           : numberText(value, value < 0.1 ? 2 : 1);
}

/// Numbers of the scale, at the edge of the plot.
void PlotLane::paintTicks(juce::Graphics& g, juce::Rectangle<int> column, juce::Justification side)
{
    const ValueAxis& axis = scale();
    const Palette& p = paletteFor(*this);
    const auto font = captionFont();
    const bool inPlot = plotArea().intersects(column);
    g.setFont(font);
    for (const double value : valueTicks(axis, tickGap))
    {
        const juce::String text = tickText(value);
        const auto place = column.withY(plotArea().getY() + juce::roundToInt(axis.yOf(value)) - 6).withHeight(12);
        if (inPlot) // over the curve
        {
            g.setColour(p.well.withAlpha(0.8f));
            g.fillRoundedRectangle(place.withWidth(font.getStringWidth(text) + 4).translated(-2, 0).toFloat(), 2.0f);
        }
        g.setColour(p.dim);
        g.drawText(text, place, side, false);
    }
}

// The mouse.

void PlotLane::say(const juce::String& text)
{
    setTooltip(text);
    if (auto* handler = getAccessibilityHandler(); handler != nullptr && hasKeyboardFocus(false))
        juce::AccessibilityHandler::postAnnouncement(getTitle() + " " + text,
                                                     juce::AccessibilityHandler::AnnouncementPriority::medium);
}

std::unique_ptr<juce::AccessibilityHandler> PlotLane::createAccessibilityHandler()
{
    return std::make_unique<juce::AccessibilityHandler>(*this, juce::AccessibilityRole::group);
}

void PlotLane::mouseMove(const juce::MouseEvent& event)
{
    const auto now = plotArea().contains(event.getPosition()) ? thingAt(event.position) : std::nullopt;
    setMouseCursor(!plotArea().contains(event.getPosition()) ? juce::MouseCursor(juce::MouseCursor::NormalCursor)
                   : now && !viewState.isDrawing()           ? juce::MouseCursor(juce::MouseCursor::PointingHandCursor)
                                                             : cursorAt(event));
    if (!plotArea().contains(event.getPosition()) || !model.clip())
    {
        // The other word is in the tooltip.
        const juce::String name = style().name;
        setTooltip(designerWord(name) == name ? getDescription() : tr(name) + ": " + getDescription());
    }
    else
    {
        const Breakpoint p = now ? place(*now) : placeAt(event.position);
        setTooltip(numberText(p.time, 3) + " s, " + valueText(p.value));
    }
    if (now == hovered)
        return;
    hovered = now;
    repaint(plotArea());
}

void PlotLane::mouseExit(const juce::MouseEvent&)
{
    if (!hovered)
        return;
    hovered.reset();
    repaint(plotArea());
}

void PlotLane::mouseDown(const juce::MouseEvent& event)
{
    drag = Drag::none;
    grabKeyboardFocus();
    if (!model.clip() || !plotArea().contains(event.getPosition()))
        return;
    if (!event.mods.isPopupMenu() && beginTool(event))
    {
        drag = Drag::tool;
        return;
    }
    const auto thing = thingAt(event.position);
    const bool more = event.mods.isShiftDown() || event.mods.isCommandDown();
    if (!thing && event.mods.isPopupMenu())
        return; // its menu is for what is selected
    if (!thing)
    {
        drag = Drag::marquee;
        if (onMarquee)
            onMarquee(*this, event, false);
        return;
    }
    const Indices now = picked();
    const bool already = std::binary_search(now.begin(), now.end(), *thing);
    if (more)
        clipSelection.select(pick(clipSelection.selected(), toggled(now, {*thing})));
    else if (!already)
        clipSelection.select(pick({}, {*thing}));
    if (event.mods.isPopupMenu())
        return;
    drag = Drag::things;
    gesture = model.beginGesture();
    dragged = clipSelection.selected();
    grabbed = place(*thing);
}

void PlotLane::mouseDrag(const juce::MouseEvent& event)
{
    if (drag == Drag::marquee && onMarquee)
        onMarquee(*this, event, false);
    if (drag == Drag::tool)
        dragTool(event);
    if (drag != Drag::things || !event.mouseWasDraggedSinceMouseDown() || pacini::isEmpty(dragged))
        return;
    const auto start = gestureStart(model, gesture);
    if (!start)
        return;
    // What was grabbed keeps its distance to the pointer.
    const auto begin = pointOf(grabbed);
    auto offset = event.getOffsetFromDragStart().toFloat();
    if (event.mods.isShiftDown())
        (std::abs(offset.x) >= std::abs(offset.y) ? offset.y : offset.x) = 0.0f;
    Breakpoint target = placeAt(begin + offset);
    Snapping snapping;
    snapping.clip = start.get();
    snapping.moving = &dragged;
    if (!event.mods.isAltDown())
        target.time = snapTime(model, viewState, transport, target.time, snapping);
    if (offset.y == 0.0f)
        target.value = grabbed.value;
    if (offset.x == 0.0f)
        target.time = grabbed.time;
    SelectionMove wanted = move(grabbed, target);
    wanted.time = target.time - grabbed.time;
    if (clipSelection.setEdited(stepName(SelectionStep::move, dragged), moveSelected(*start, dragged, wanted), gesture))
        say(numberText(target.time, 3) + " s, " + valueText(target.value));
}

void PlotLane::mouseUp(const juce::MouseEvent& event)
{
    if (drag == Drag::marquee && onMarquee)
        onMarquee(*this, event, true);
    if (drag == Drag::tool)
        endTool();
    drag = Drag::none;
}

void PlotLane::mouseDoubleClick(const juce::MouseEvent& event)
{
    const auto clip = model.clip();
    if (!clip || viewState.isDrawing() || !plotArea().contains(event.getPosition()) || thingAt(event.position))
        return;
    clipSelection.setEdited("Add point", added(*clip, placeAt(event.position)));
}

// Keys.

/// Presses that follow each other quickly are one gesture; false when nothing is picked.
bool PlotLane::beginNudge(bool scaling)
{
    const Indices things = picked();
    if (!model.clip() || things.empty())
        return false;
    const auto now = juce::Time::getMillisecondCounter();
    if (nudging == 0 || scaling != nudgeScales || now - lastNudge > nudgePause || nudged != clipSelection.selected())
    {
        nudging = model.beginGesture();
        dragged = clipSelection.selected();
        grabbed = place(things.front());
        nudgedPixels = nudgedSteps = 0.0;
    }
    nudgeScales = scaling;
    lastNudge = now;
    return true;
}

void PlotLane::scaleByKeys(double pixels, double steps)
{
    if (!beginNudge(true))
        return;
    nudgedPixels += pixels;
    nudgedSteps += steps;
    const auto start = gestureStart(model, nudging);
    const auto range = timeOf(dragged, *start);
    if (!range)
        return;
    const double length = range->to - range->from;
    SelectionScale wanted;
    wanted.pivot = range->from;
    if (length > 0.0)
        wanted.timeFactor = std::max(0.01, 1.0 + nudgedPixels * viewState.axis().secondsPerPixel / length);
    wanted.spread = std::pow(spreadStep, nudgedSteps);
    clipSelection.setEdited(stepName(SelectionStep::scale, dragged), scaleSelected(*start, dragged, wanted), nudging);
    nudged = clipSelection.selected();
    say(tr(steps != 0.0 ? "{0} % of the level differences" : "{0} % of the length",
           {numberText(100.0 * (steps != 0.0 ? wanted.spread : wanted.timeFactor), 0)}));
}

void PlotLane::nudge(double pixels, double steps)
{
    if (!beginNudge(false))
        return;
    nudgedPixels += pixels;
    nudgedSteps += steps;
    const auto start = gestureStart(model, nudging);
    const ValueAxis axis = scale();
    Breakpoint to = grabbed;
    // A step of decibels is 1 dB, of a frequency a semitone, of a linear scale a fiftieth.
    if (nudgedSteps != 0.0 && axis.scale == ValueScale::decibels)
        to.value = std::max(grabbed.value, axis.low) * Decibels(nudgedSteps).gain();
    else if (nudgedSteps != 0.0 && axis.scale == ValueScale::logarithmic)
        to.value = grabbed.value * std::exp2(nudgedSteps / 12.0);
    else
        to.value += nudgedSteps * (axis.high - axis.low) / 50.0;
    SelectionMove wanted = move(grabbed, to);
    wanted.time = nudgedPixels * viewState.axis().secondsPerPixel;
    clipSelection.setEdited(stepName(SelectionStep::move, dragged), moveSelected(*start, dragged, wanted), nudging);
    nudged = clipSelection.selected();
    say(valueText(to.value));
}

void PlotLane::step(int direction)
{
    if (count() == 0)
        return;
    const Indices now = picked();
    std::size_t next = 0;
    if (now.empty())
    {
        while (next + 1 < count() && place(next).time < transport.playhead())
            ++next;
    }
    else if (direction > 0)
        next = std::min(now.back() + 1, count() - 1);
    else
        next = now.front() > 0 ? now.front() - 1 : 0;
    clipSelection.select(pick({}, {next}));
    const Breakpoint p = place(next);
    if (const auto shown = viewState.axis().visible(viewState.viewWidth()); p.time < shown.from || p.time > shown.to)
    {
        TimeAxis moved = viewState.axis();
        moved.start = p.time - 0.5 * (shown.to - shown.from);
        viewState.setAxis(moved);
    }
    say(numberText(p.time, 3) + " s, " + valueText(p.value));
}

bool PlotLane::keyPressed(const juce::KeyPress& key)
{
    using K = juce::KeyPress;
    const auto modifiers = key.getModifiers();
    const double amount = modifiers.isShiftDown() ? 10.0 : 1.0;
    const int code = key.getKeyCode();
    const bool any = !picked().empty();
    if (modifiers.isCommandDown() || (modifiers.isAltDown() && !any))
        return false;
    if (modifiers.isAltDown())
    {
        if (code == K::leftKey || code == K::rightKey)
            scaleByKeys(code == K::leftKey ? -amount : amount, 0.0);
        else if (code == K::upKey || code == K::downKey)
            scaleByKeys(0.0, code == K::upKey ? amount : -amount);
        else
            return false;
        return true;
    }
    if (code == ',' || code == '.')
        step(code == '.' ? 1 : -1);
    else if (any && (code == K::leftKey || code == K::rightKey))
        nudge(code == K::leftKey ? -amount : amount, 0.0);
    else if (any && (code == K::upKey || code == K::downKey))
        nudge(0.0, code == K::upKey ? amount : -amount);
    else if (code == K::returnKey)
    {
        if (const auto clip = model.clip())
        {
            // Where the playhead is, on the curve as it is there or in the middle of the scale.
            const ValueAxis axis = scale();
            clipSelection.setEdited("Add point",
                                    added(*clip, {transport.playhead(), axis.valueAtY(0.5 * axis.height)}));
        }
    }
    else if (code == K::escapeKey && !pacini::isEmpty(clipSelection.selected()))
        clipSelection.select({});
    else
        return false;
    return true;
}

std::vector<Command> PlotLane::contextCommands() const
{
    return {cut,        copy,   paste,   deleteSelection, menuLine, selectAll, selectNone, menuLine,
            changeGain, fadeIn, fadeOut, thinOut,         menuLine, draw,      addMarker,  splitClipHere};
}

} // namespace pacini::editor
