// SPDX-License-Identifier: GPL-3.0-or-later

// Drawing and bending in a lane.

#include "document/view/HitTest.h"
#include "editor/clip/lanes/CurveLane.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{
constexpr double lineReach = 7.0; // pixels
}

template <typename Edit>
void CurveLane::change(const char* name, Edit edit)
{
    const auto start = model.gestureStart(toolGesture);
    const Curve* before = start ? curveOf(*start, shown) : nullptr;
    if (before == nullptr)
        return;
    EditedCurve edited = edit(*before, limitsOf(*start, shown));
    EditedClip result{*start, withPoints({}, shown, std::move(edited.selection))};
    *curveOf(result.clip, shown) = std::move(edited.curve);
    clipSelection.setEdited(name, std::move(result), toolGesture);
}

std::optional<std::size_t> CurveLane::lineAt(juce::Point<float> place) const
{
    const auto clip = model.clip();
    const Curve* points = clip ? curveOf(*clip, shown) : nullptr;
    const auto plot = plotArea();
    if (points == nullptr || points->size() < 2 || !showsHandles() || !plot.toFloat().contains(place))
        return std::nullopt;
    const double x = static_cast<double>(place.x) - plot.getX();
    const double y = static_cast<double>(place.y) - plot.getY();
    const double time = viewState.axis().timeAt(x);
    if (time < points->front().time || time >= points->back().time ||
        !lineIsAt(*points, viewState.axis(), scale(), x, y, lineReach))
        return std::nullopt;
    const auto next = std::upper_bound(points->begin(), points->end(), time,
                                       [](double t, const Breakpoint& p) { return t < p.time; });
    return static_cast<std::size_t>(next - points->begin()) - 1;
}

juce::MouseCursor CurveLane::cursorAt(const juce::MouseEvent& event) const
{
    if (viewState.isDrawing())
        return juce::MouseCursor::CrosshairCursor;
    if (event.mods.isCommandDown() && lineAt(event.position))
        return juce::MouseCursor::UpDownResizeCursor;
    return juce::MouseCursor::NormalCursor;
}

bool CurveLane::beginTool(const juce::MouseEvent& event)
{
    bent.reset();
    if (viewState.isDrawing())
    {
        toolGesture = model.beginGesture();
        const auto place = event.position - plotArea().getPosition().toFloat();
        stroke.begin(static_cast<double>(place.x), static_cast<double>(place.y));
        draw(place);
        return true;
    }
    const auto line = event.mods.isCommandDown() && !thingAt(event.position) ? lineAt(event.position) : std::nullopt;
    if (!line)
        return false;
    toolGesture = model.beginGesture();
    bent = Bend{*line, placeAt(event.position).time};
    return true;
}

void CurveLane::dragTool(const juce::MouseEvent& event)
{
    if (!bent)
        return draw(event.position - plotArea().getPosition().toFloat());
    const auto offset = static_cast<double>(event.getOffsetFromDragStart().y);
    change("Bend line", [&](const Curve& curve, const CurveLimits& limits)
           { return bentLine(curve, bent->first, bent->time, offset, viewState.axis(), scale(), limits); });
    say(valueText(placeAt(event.position).value));
}

void CurveLane::draw(juce::Point<float> to)
{
    stroke.to(static_cast<double>(to.x), static_cast<double>(to.y));
    change("Draw", [&](const Curve& curve, const CurveLimits& limits)
           { return withDrawn(curve, pointsOf(stroke, viewState.axis(), scale(), limits), limits); });
}

} // namespace pacini::editor
