// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/TimeRuler.h"

#include "document/view/TimeTicks.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/lanes/LaneText.h"
#include "editor/clip/lanes/PlotLane.h"
#include "editor/clip/session/Snapping.h"

#include <algorithm>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr float edgeReach = 6.0f; // pixels
} // namespace

TimeRuler::TimeRuler(const EditorModel& project, ClipSelection& selected, const ViewState& sight, Transport& playing)
    : model(project), clipSelection(selected), viewState(sight), transport(playing)
{
    setOpaque(true);
    setTitle("Time ruler");
    setTooltip("Click to move the playhead. Ctrl-drag to scrub. Drag to set the time range for loops and edits, or one "
               "of its ends (Alt: "
               "no snapping). Double-click to clear it");
    subscriptions.on({&viewState.axisChanged, &clipSelection.rangeChanged, &transport.loopChanged},
                     [this] { repaint(); });
}

double TimeRuler::timeAt(float x) const
{
    return viewState.axis().timeAt(static_cast<double>(x) - laneHeadWidth);
}

void TimeRuler::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.card);
    const auto plot = getLocalBounds().withTrimmedLeft(laneHeadWidth);
    const TimeAxis& axis = viewState.axis();
    const juce::Graphics::ScopedSaveState saved(g);
    g.reduceClipRegion(plot);
    const auto xOf = [&](double time)
    {
        return static_cast<float>(plot.getX() + axis.xOf(time));
    };
    if (const auto& range = clipSelection.timeRange())
    {
        g.setColour(transport.isLooping() ? p.accent : p.accent.withAlpha(0.45f));
        g.fillRect(juce::Rectangle<float>(xOf(range->from), static_cast<float>(plot.getBottom() - 6),
                                          std::max(1.0f, xOf(range->to) - xOf(range->from)), 6.0f));
    }
    const double step = tickStep(axis.secondsPerPixel);
    const auto first = static_cast<long long>(std::floor(axis.start / step));
    const auto last = static_cast<long long>(std::ceil(axis.timeAt(plot.getWidth()) / step));
    g.setFont(smallFont());
    int taken = plot.getX(); // by the text before
    for (long long i = std::max(0LL, first); i <= last; ++i)
    {
        const double time = static_cast<double>(i) * step;
        const float x = xOf(time);
        g.setColour(p.line);
        g.fillRect(x, 4.0f, 1.0f, static_cast<float>(plot.getHeight() - 4));
        for (int k = 1; k < partsOfTick; ++k)
            g.fillRect(xOf(time + k * step / partsOfTick), static_cast<float>(plot.getBottom() - 5), 1.0f, 5.0f);
        g.setColour(p.dim);
        taken =
            drawTickText(g, timeText(time, step), juce::roundToInt(x), plot.withHeight(plot.getHeight() - 5), taken);
    }
}

/// The end of the time range that stays when the one at x is dragged.
std::optional<double> TimeRuler::otherEdge(float x) const
{
    const auto& range = clipSelection.timeRange();
    if (!range)
        return std::nullopt;
    const auto distance = [&](double time)
    {
        return std::abs(x - static_cast<float>(laneHeadWidth + viewState.axis().xOf(time)));
    };
    const float toFrom = distance(range->from);
    const float toEnd = distance(range->to);
    if (std::min(toFrom, toEnd) > edgeReach)
        return std::nullopt;
    return toFrom < toEnd ? range->to : range->from;
}

void TimeRuler::mouseMove(const juce::MouseEvent& event)
{
    setMouseCursor(otherEdge(event.position.x) ? juce::MouseCursor::LeftRightResizeCursor
                                               : juce::MouseCursor::NormalCursor);
}

void TimeRuler::mouseDown(const juce::MouseEvent& event)
{
    if (event.mods.isCommandDown())
        return transport.scrub(timeAt(event.position.x));
    const auto fixed = otherEdge(event.position.x);
    anchorIsEdge = fixed.has_value();
    anchor = fixed.value_or(timeAt(event.position.x));
    if (event.getNumberOfClicks() == 1 && !anchorIsEdge)
        transport.setPlayhead(anchor);
}

void TimeRuler::mouseDrag(const juce::MouseEvent& event)
{
    if (event.mods.isCommandDown())
        return transport.scrub(timeAt(event.position.x));
    if (!event.mouseWasDraggedSinceMouseDown())
        return;
    Snapping snapping;
    // A press has put the playhead where the range begins: it must not hold the other end there.
    snapping.playhead = anchorIsEdge;
    const bool freely = event.mods.isAltDown();
    const auto placed = [&](double time)
    {
        return freely ? time : snapTime(model, viewState, transport, time, snapping);
    };
    const double from = anchorIsEdge ? anchor : placed(anchor);
    const double now = placed(timeAt(event.position.x));
    clipSelection.setTimeRange(TimeRange{std::min(from, now), std::max(from, now)});
}

void TimeRuler::mouseDoubleClick(const juce::MouseEvent&)
{
    clipSelection.setTimeRange(std::nullopt);
}

std::vector<Command> TimeRuler::contextCommands() const
{
    return {rangeFromHere, rangeToHere,   editor::loop, trim,        menuLine,
            addMarker,     splitClipHere, menuLine,     zoomToRange, editor::fit};
}

} // namespace pacini::editor
