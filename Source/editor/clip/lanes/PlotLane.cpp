// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/PlotLane.h"

#include "document/SelectionScale.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/session/Snapping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr int edgeOfThings = 9;                                  // pixels to either side of what has changed
constexpr double floorAmplitude = 0.001;                         // -60 dB
constexpr std::array<double, 3> lines{0.001, 0.0316227766, 1.0}; // of the decibel scale
} // namespace

PlotLane::PlotLane(EditorModel& project, ClipSelection& selected, const ViewState& sight, Transport& playing)
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
    if (axis.scale == ValueScale::decibels)
    {
        g.setColour(p.line.withAlpha(0.6f));
        g.fillRect(plot.getX(), plot.getY() + juce::roundToInt(axis.yOf(lines[1])), plot.getWidth(), 1);
    }
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
    auto text = head.withTrimmedLeft(grid).withTrimmedRight(grid / 2);
    g.setColour(p.text);
    g.setFont(usualFont());
    const bool two = look.note.isNotEmpty() && text.getHeight() >= 38;
    if (two)
        text = text.withSizeKeepingCentre(text.getWidth(), 36);
    g.drawFittedText(tr(look.name), two ? text.removeFromTop(19) : text, juce::Justification::centredLeft, 1, 0.8f);
    if (!two)
        return;
    g.setColour(p.dim);
    g.setFont(smallFont());
    g.drawFittedText(look.note, text, juce::Justification::centredLeft, 1, 0.7f);
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

} // namespace pacini::editor
