// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/SelectionBar.h"

#include "document/SelectionScale.h"
#include "editor/Theme.h"
#include "editor/clip/session/ClipSteps.h"
#include "editor/clip/session/Snapping.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr float handleReach = 5.0f; // pixels
}

SelectionBar::SelectionBar(EditorModel& project, ClipSelection& selected, const ViewState& sight,
                           const Transport& playing)
    : model(project), clipSelection(selected), viewState(sight), transport(playing)
{
    setTitle("Selection in time");
    setTooltip("Drag an end to stretch the selection in time, in all lanes (Alt: no snapping)");
    setMouseCursor(juce::MouseCursor::LeftRightResizeCursor);
    subscriptions.on({&clipSelection.changed, &model.contentChanged}, [this] { follow(); });
    subscriptions.on({&viewState.axisChanged},
                     [this]
                     {
                         if (range)
                             repaint();
                     });
}

void SelectionBar::follow()
{
    const auto clip = model.clip();
    auto wanted = clip ? timeOf(clipSelection.selected(), *clip) : std::nullopt;
    if (wanted && !(wanted->to > wanted->from))
        wanted.reset();
    if (wanted != std::exchange(range, wanted))
        repaint();
}

float SelectionBar::xOf(double time) const
{
    return static_cast<float>(std::clamp(viewState.axis().xOf(time), -100.0, getWidth() + 100.0));
}

void SelectionBar::paint(juce::Graphics& g)
{
    if (!range)
        return;
    g.setColour(paletteFor(*this).text);
    const float from = xOf(range->from);
    const float to = xOf(range->to);
    g.fillRect(from, 0.0f, to - from, 2.0f);
    for (const float x : {from, to})
        g.fillRoundedRectangle(x - 2.0f, 0.0f, 4.0f, static_cast<float>(height), 1.0f);
}

bool SelectionBar::hitTest(int x, int)
{
    return range && std::min(std::abs(static_cast<float>(x) - xOf(range->from)),
                             std::abs(static_cast<float>(x) - xOf(range->to))) <= handleReach;
}

void SelectionBar::mouseDown(const juce::MouseEvent& event)
{
    if (!range)
        return;
    before = *range;
    grabbed = clipSelection.selected();
    gesture = model.beginGesture();
    dragsEnd = std::abs(event.position.x - xOf(range->to)) <= std::abs(event.position.x - xOf(range->from));
}

void SelectionBar::mouseDrag(const juce::MouseEvent& event)
{
    const auto start = gestureStart(model, gesture);
    if (!start || gesture == 0 || !event.mouseWasDraggedSinceMouseDown())
        return;
    const double perPixel = viewState.axis().secondsPerPixel;
    double time = (dragsEnd ? before.to : before.from) + event.getDistanceFromDragStartX() * perPixel;
    if (!event.mods.isAltDown())
    {
        Snapping snapping;
        snapping.clip = start.get();
        snapping.moving = &grabbed;
        time = snapTime(model, viewState, transport, time, snapping);
    }
    SelectionScale wanted;
    wanted.pivot = dragsEnd ? before.from : before.to;
    wanted.timeFactor =
        std::max(perPixel, dragsEnd ? time - before.from : before.to - time) / (before.to - before.from);
    clipSelection.setEdited("Stretch selection", scaleSelected(*start, grabbed, wanted), gesture);
}

} // namespace pacini::editor
