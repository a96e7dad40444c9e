// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/EventLane.h"

#include "document/view/EventKind.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/lanes/LaneText.h"
#include "editor/clip/session/Tapping.h"

#include <algorithm>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr float eventPickRadius = 8.0f; // pixels

/// Round for thuds, square for knocks, pointed for clicks.
juce::Path headOf(juce::Point<float> centre, float size, EventKind kind)
{
    juce::Path path;
    if (kind == EventKind::thud)
        path.addEllipse(juce::Rectangle<float>(size, size).withCentre(centre));
    else if (kind == EventKind::knock)
        path.addRectangle(juce::Rectangle<float>(0.85f * size, 0.85f * size).withCentre(centre));
    else
        path.addTriangle(centre.x, centre.y - 0.6f * size, centre.x + 0.55f * size, centre.y + 0.45f * size,
                         centre.x - 0.55f * size, centre.y + 0.45f * size);
    return path;
}
} // namespace

EventLane::EventLane(EditorModel& project, ClipSelection& selected, ViewState& sight, Transport& playing, Shows wanted)
    : PlotLane(project, selected, sight, playing), shows(wanted)
{
    setTitle(shows == Shows::amplitude ? "Transients" : "Sharpness of events");
    setDescription(shows == Shows::amplitude
                       ? "Short events and their levels: round heads are thuds, squares knocks, pointed heads clicks. "
                         "Double-click to add one"
                       : "Sharpness of events: 0 % dull, 100 % crisp");
}

PlotLane::Style EventLane::style() const
{
    const auto colour = paletteFor(*this).event;
    if (shows == Shows::sharpness)
        return {tr("Sharpness"), toText("0–100 %"), colour};
    return {tr("Transients"), counted(count(), "{0} event", "{0} events"), colour};
}

ValueAxis EventLane::valueAxis(double height) const
{
    if (shows == Shows::sharpness)
        // A margin, so that heads at the ends can be seen.
        return {ValueScale::linear, -0.1, 1.1, height};
    double highest = 1.0;
    if (const auto clip = model.clip())
        for (const Transient& event : clip->transients)
            highest = std::max(highest, event.amplitude);
    // Room for the heads of the strongest: a tenth of the height on either scale.
    const bool decibels = viewState.amplitudesInDecibels();
    return amplitudeAxis(decibels, (decibels ? 2.0 : 1.12) * highest, height);
}

std::optional<TimeRange> EventLane::changedTime(const Clip& before, const Clip& now) const
{
    return PlotLane::changedTime(before.transients, now.transients);
}

void EventLane::paintPlot(juce::Graphics& g, juce::Rectangle<int> plot, int firstColumn, int lastColumn)
{
    const auto clip = model.clip();
    const Palette& p = paletteFor(*this);
    const auto& events = clip->transients;
    const TimeAxis axis = viewState.axis();
    const auto less = [](const Transient& event, double time)
    {
        return event.time < time;
    };
    const auto first = std::lower_bound(events.begin(), events.end(), axis.timeAt(firstColumn - 12.0), less);
    const auto last = std::lower_bound(first, events.end(), axis.timeAt(lastColumn + 12.0), less);
    const bool crowded = last - first > std::max(1, lastColumn - firstColumn);
    const Indices chosen = picked();
    const float bottom = static_cast<float>(plot.getBottom());
    for (auto event = first; event != last; ++event)
    {
        const auto i = static_cast<std::size_t>(event - events.begin());
        const auto at = pointOf(place(i));
        const bool isChosen = std::binary_search(chosen.begin(), chosen.end(), i);
        g.setColour(isChosen ? p.text : p.event);
        const int width = isChosen ? 3 : 1;
        g.fillRect(juce::roundToInt(at.x) - width / 2, juce::roundToInt(at.y), width, juce::roundToInt(bottom - at.y));
        if (crowded)
            continue;
        g.fillPath(headOf(at, isChosen ? 12.0f : 9.0f, kindOf(*event)));
    }
}

std::optional<std::size_t> EventLane::thingAt(juce::Point<float> position) const
{
    std::optional<std::size_t> best;
    float nearest = eventPickRadius;
    const auto plot = plotArea();
    if (!plot.toFloat().contains(position))
        return best;
    for (std::size_t i = 0; i < count(); ++i)
    {
        const auto at = pointOf(place(i));
        // The stem can be picked as well as the head.
        const float down = std::clamp(position.y, at.y, static_cast<float>(plot.getBottom()));
        const float distance = std::hypot(at.x - position.x, (down - position.y));
        if (distance > nearest)
            continue;
        nearest = distance;
        best = i;
    }
    return best;
}

std::size_t EventLane::count() const
{
    const auto clip = model.clip();
    return clip ? clip->transients.size() : 0;
}

Breakpoint EventLane::place(std::size_t thing) const
{
    const Transient event = model.clip()->transients[thing];
    return {event.time, shows == Shows::amplitude ? event.amplitude : event.sharpness};
}

Selection EventLane::pick(Selection selection, Indices things) const
{
    selection.transients = std::move(things);
    return selection;
}

void EventLane::addInside(Selection& selection, juce::Rectangle<float> area) const
{
    if (!area.intersects(plotArea().toFloat()))
        return;
    Indices inside;
    for (std::size_t i = 0; i < count(); ++i)
    {
        const auto at = pointOf(place(i));
        if (at.x >= area.getX() && at.x <= area.getRight() && area.getBottom() >= at.y)
            inside.push_back(i);
    }
    selection.transients = unionOf(selection.transients, inside);
}

EditedClip EventLane::added(const Clip& clip, Breakpoint where) const
{
    const Transient event = shows == Shows::amplitude ? Transient{where.time, where.value, usualEvent.sharpness}
                                                      : Transient{where.time, usualEvent.amplitude, where.value};
    EditedClip result{addTransient(clip, event), {}};
    const auto& events = result.clip.transients;
    for (std::size_t i = 0; i < events.size(); ++i)
        if (i >= clip.transients.size() || !(events[i] == clip.transients[i]))
        {
            result.selection.transients = {i};
            break;
        }
    return result;
}

SelectionMove EventLane::move(Breakpoint from, Breakpoint to) const
{
    if (shows == Shows::amplitude)
        return amplitudeMove(from.value, to.value);
    SelectionMove result;
    result.sharpness = to.value - from.value;
    return result;
}

juce::String EventLane::tickText(double value) const
{
    return shows == Shows::sharpness ? juce::String(juce::roundToInt(100.0 * value)) : PlotLane::tickText(value);
}

juce::String EventLane::valueText(double value) const
{
    return shows == Shows::amplitude
               ? amplitudeText(value)
               : tr("{0} % sharp", {juce::String(juce::roundToInt(100.0 * std::clamp(value, 0.0, 1.0)))});
}

} // namespace pacini::editor
