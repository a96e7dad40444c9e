// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/MarkerStrip.h"

#include "document/MarkerEdits.h"
#include "document/view/MarkerLabels.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/lanes/PlotLane.h"
#include "editor/clip/session/ClipSteps.h"
#include "editor/clip/session/Snapping.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{
constexpr double maxWidth = 160.0; // pixels of a name
constexpr double flagWidth = 7.0;
constexpr double pickBefore = 4.0; // pixels left of a flag
constexpr int leastText = 14;
const char* const help =
    "Click to move the playhead. Drag to move a marker (Alt: no snapping). Double-click to rename. M adds one";
} // namespace

MarkerStrip::MarkerStrip(EditorModel& project, const ViewState& sight, Transport& playing)
    : model(project), viewState(sight), transport(playing)
{
    setOpaque(true);
    setTitle("Markers");
    setTooltip(help);
    subscriptions.on({&viewState.axisChanged, &model.contentChanged}, [this] { repaint(); });
}

void MarkerStrip::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.card);
    auto plot = getLocalBounds();
    auto head = plot.removeFromLeft(laneHeadWidth);
    g.setColour(p.dim);
    g.setFont(smallFont());
    g.drawText(tr("Markers"), head.withTrimmedLeft(grid + 3), juce::Justification::centredLeft, true);
    g.setColour(p.line);
    g.fillRect(getLocalBounds().removeFromBottom(1));
    const auto clip = model.clip();
    if (!clip)
        return;
    g.reduceClipRegion(plot);
    for (const MarkerLabel& label : markerLabels(clip->markers, viewState.axis(), plot.getWidth(), maxWidth))
    {
        const auto x = static_cast<float>(plot.getX() + label.x);
        juce::Path flag;
        flag.addTriangle(x, 3.0f, x + static_cast<float>(flagWidth), 7.5f, x, 12.0f);
        g.setColour(p.accent);
        g.fillPath(flag);
        g.fillRect(x, 3.0f, 1.0f, static_cast<float>(getHeight()) - 3.0f);
        const juce::Rectangle<int> room(juce::roundToInt(x + static_cast<float>(flagWidth)) + 3, 0,
                                        static_cast<int>(label.width - flagWidth) - 5, getHeight() - 2);
        if (room.getWidth() < leastText)
            continue;
        g.setColour(p.text);
        g.drawText(toText(clip->markers[label.marker].name), room, juce::Justification::centredLeft, true);
    }
}

/// The flag or the name under a place.
std::optional<std::size_t> MarkerStrip::markerAt(juce::Point<float> place) const
{
    std::optional<std::size_t> found;
    const auto clip = model.clip();
    const double x = static_cast<double>(place.x) - laneHeadWidth;
    if (!clip || x < -pickBefore)
        return found;
    for (const MarkerLabel& label : markerLabels(clip->markers, viewState.axis(), getWidth() - laneHeadWidth, maxWidth))
        if (x >= label.x - pickBefore && x <= label.x + std::max(label.width - pickBefore, flagWidth))
            found = label.marker;
    return found;
}

void MarkerStrip::mouseMove(const juce::MouseEvent& event)
{
    const auto marker = markerAt(event.position);
    setMouseCursor(marker ? juce::MouseCursor::PointingHandCursor : juce::MouseCursor::NormalCursor);
    if (const auto clip = model.clip(); clip && marker)
        setTooltip(toText(clip->markers[*marker].name) + ", " + numberText(clip->markers[*marker].time, 3) + " s");
    else
        setTooltip(tr(help));
}

void MarkerStrip::ask(Command command)
{
    if (onCommand)
        onCommand(command);
}

void MarkerStrip::mouseDown(const juce::MouseEvent& event)
{
    const auto clip = model.clip();
    dragged = markerAt(event.position);
    if (!clip || !dragged)
        return;
    grabbed = clip->markers[*dragged].time;
    transport.setPlayhead(grabbed);
    if (!event.mods.isPopupMenu())
    {
        gesture = model.beginGesture();
        return;
    }
    dragged.reset();
    juce::PopupMenu menu;
    menu.setLookAndFeel(&getLookAndFeel());
    const auto add = [&](const juce::String& name, Command command)
    {
        menu.addItem(tr(name),
                     [self = juce::Component::SafePointer<MarkerStrip>(this), command]
                     {
                         if (self)
                             self->ask(command);
                     });
    };
    add(toText("Rename…"), renameMarker);
    add("Delete", deleteMarker);
    menu.showMenuAsync(juce::PopupMenu::Options().withTargetComponent(this).withMousePosition());
}

void MarkerStrip::mouseDrag(const juce::MouseEvent& event)
{
    const auto start = gestureStart(model, gesture);
    if (!dragged || !start || *dragged >= start->markers.size() || !event.mouseWasDraggedSinceMouseDown())
        return;
    double time = grabbed + event.getDistanceFromDragStartX() * viewState.axis().secondsPerPixel;
    if (!event.mods.isAltDown())
    {
        Snapping snapping;
        snapping.clip = start.get();
        snapping.marker = dragged;
        snapping.playhead = transport.isPlaying(); // else it moves along
        time = snapTime(model, viewState, transport, time, snapping);
    }
    editClip(model, "Move marker", MarkersEdit{movedMarker(start->markers, *dragged, time, start->duration)}, gesture);
    if (!transport.isPlaying())
        transport.setPlayhead(time);
}

void MarkerStrip::mouseUp(const juce::MouseEvent&)
{
    dragged.reset();
}

void MarkerStrip::mouseDoubleClick(const juce::MouseEvent& event)
{
    if (markerAt(event.position))
        ask(renameMarker);
}

} // namespace pacini::editor
