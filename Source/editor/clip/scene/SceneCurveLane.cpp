// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/scene/SceneCurveLane.h"

#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr float pointReach = 9.0f; // pixels
constexpr double timeStep = 0.01;  // s, by keys
constexpr int sceneMargin = 10;
} // namespace

SceneRange sceneRangeOf(SceneParameter parameter) noexcept
{
    switch (parameter)
    {
    case SceneParameter::pan:
        return {0.0, 1.0, 0.5, ""};
    case SceneParameter::delay:
        return {0.0, 1.0, 0.0, " s"};
    case SceneParameter::transposition:
        return {-24.0, 24.0, 0.0, " st"};
    case SceneParameter::stretch:
        return {0.25, 4.0, 1.0, ""};
    case SceneParameter::speed:
        return {0.0, 1.0, 0.5, ""};
    case SceneParameter::force:
        return {0.0, 1.0, 1.0, ""};
    case SceneParameter::gain:
    case SceneParameter::tones:
    case SceneParameter::events:
    case SceneParameter::noise:
        break;
    }
    return {-60.0, 12.0, 0.0, " dB"};
}

SceneCurveLane::SceneCurveLane(EditorModel& project, SceneSelection& selected) : model(project), selection(selected)
{
    setTitle("Curve");
    setWantsKeyboardFocus(true);
    setTooltip("Double-click: adds a point; drag or arrow keys: move it; Delete: removes it");
    subscriptions.on({&selection.changed},
                     [this]
                     {
                         chosen.reset();
                         repaint();
                     });
    subscriptions.on({&model.projectChanged}, [this] { repaint(); });
}

void SceneCurveLane::show(SceneParameter wanted)
{
    shown = wanted;
    chosen.reset();
    repaint();
}

const Curve* SceneCurveLane::curve() const
{
    const ScenePart* part = selection.part();
    if (part == nullptr)
        return nullptr;
    for (const SceneCurve& one : part->curves)
        if (one.parameter == shown)
            return &one.points;
    return nullptr;
}

double SceneCurveLane::length() const
{
    const ScenePart* part = selection.part();
    const double s = part != nullptr ? lengthOf(model.document().project(), *part) : 0.0;
    return s > 0.0 ? s : 1.0;
}

juce::Point<float> SceneCurveLane::placeOf(Breakpoint point) const
{
    const SceneRange range = sceneRangeOf(shown);
    const auto area = getLocalBounds().reduced(sceneMargin).toFloat();
    const double y = 1.0 - (std::clamp(point.value, range.low, range.high) - range.low) / (range.high - range.low);
    return {area.getX() + static_cast<float>(point.time / length()) * area.getWidth(),
            area.getY() + static_cast<float>(y) * area.getHeight()};
}

Breakpoint SceneCurveLane::pointAt(juce::Point<float> place) const
{
    const SceneRange range = sceneRangeOf(shown);
    const auto area = getLocalBounds().reduced(sceneMargin).toFloat();
    const auto x = static_cast<double>((place.x - area.getX()) / area.getWidth());
    const auto y = static_cast<double>((place.y - area.getY()) / area.getHeight());
    return {std::clamp(x, 0.0, 1.0) * length(), range.low + (1.0 - std::clamp(y, 0.0, 1.0)) * (range.high - range.low)};
}

std::optional<std::size_t> SceneCurveLane::thingAt(juce::Point<float> place) const
{
    if (const Curve* points = curve())
        for (std::size_t i = 0; i < points->size(); ++i)
            if (placeOf((*points)[i]).getDistanceFrom(place) <= pointReach)
                return i;
    return {};
}

bool SceneCurveLane::setPoints(const char* step, Curve points, Gesture of)
{
    return selection.editPart(
        step,
        [&](ScenePart& part)
        {
            std::erase_if(part.curves, [this](const SceneCurve& one) { return one.parameter == shown; });
            if (!points.empty())
                part.curves.push_back({shown, std::move(points)});
        },
        of);
}

void SceneCurveLane::removeCurve()
{
    if (curve() != nullptr)
        setPoints("Remove curve", {});
}

void SceneCurveLane::movePoint(std::size_t index, Breakpoint to, const Curve& from, Gesture of)
{
    Curve points = from;
    const double after = index > 0 ? points[index - 1].time : 0.0;
    const double before = index + 1 < points.size() ? points[index + 1].time : length();
    const double time = std::clamp(to.time, after, std::max(after, before));
    points[index] = {time, to.value};
    setPoints("Move point of curve", std::move(points), of);
    const juce::String text = numberText(time, 2) + " s, " + numberText(to.value, 2) + sceneRangeOf(shown).unit;
    setDescription(text);
    setTooltip(text);
}

void SceneCurveLane::mouseDown(const juce::MouseEvent& event)
{
    grabKeyboardFocus();
    chosen = thingAt(event.position);
    gesture = 0;
    if (chosen)
    {
        grabbed = *curve();
        gesture = selection.beginGesture();
    }
    repaint();
}

void SceneCurveLane::mouseDrag(const juce::MouseEvent& event)
{
    if (chosen && gesture != 0 && *chosen < grabbed.size())
        movePoint(*chosen, pointAt(event.position), grabbed, gesture);
}

void SceneCurveLane::mouseDoubleClick(const juce::MouseEvent& event)
{
    if (selection.part() == nullptr || thingAt(event.position))
        return;
    Curve points = curve() != nullptr ? *curve() : Curve();
    const Breakpoint added = pointAt(event.position);
    const auto place = std::upper_bound(points.begin(), points.end(), added.time,
                                        [](double time, const Breakpoint& p) { return time < p.time; });
    chosen = static_cast<std::size_t>(place - points.begin());
    points.insert(place, added);
    setPoints("Add point to curve", std::move(points));
}

bool SceneCurveLane::keyPressed(const juce::KeyPress& key)
{
    using Key = juce::KeyPress;
    const Curve* points = curve();
    if (key == Key::returnKey && selection.part() != nullptr)
    {
        // Between the last point and the end, so that a curve can be made by keys alone.
        Curve more = points != nullptr ? *points : Curve();
        const double value = more.empty() ? valueOf(selection.part()->play, shown) : more.back().value;
        more.push_back({more.empty() ? 0.0 : 0.5 * (more.back().time + length()), value});
        chosen = more.size() - 1;
        return setPoints("Add point to curve", std::move(more));
    }
    if (points == nullptr || points->empty())
        return false;
    if (key.getTextCharacter() == ',' || key.getTextCharacter() == '.')
    {
        const std::size_t by = key.getTextCharacter() == '.' ? 1 : points->size() - 1;
        chosen = chosen ? (*chosen + by) % points->size() : 0;
        repaint();
        return true;
    }
    if (!chosen || *chosen >= points->size())
        return false;
    if (key == Key::deleteKey || key == Key::backspaceKey)
    {
        Curve fewer = *points;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(*std::exchange(chosen, std::nullopt)));
        return setPoints("Remove point of curve", std::move(fewer));
    }
    const SceneRange range = sceneRangeOf(shown);
    const double times = key.getModifiers().isShiftDown() ? 10.0 : 1.0;
    const double time = key.isKeyCode(Key::leftKey) ? -timeStep : key.isKeyCode(Key::rightKey) ? timeStep : 0.0;
    const double value = (key.isKeyCode(Key::upKey)     ? 1.0
                          : key.isKeyCode(Key::downKey) ? -1.0
                                                        : 0.0) *
                         (range.high - range.low) / 100.0;
    if (time == 0.0 && value == 0.0)
        return false;
    const Breakpoint now = (*points)[*chosen];
    movePoint(*chosen, {now.time + times * time, std::clamp(now.value + times * value, range.low, range.high)},
              Curve(*points), 0);
    return true;
}

void SceneCurveLane::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.well);
    const ScenePart* part = selection.part();
    if (part == nullptr)
    {
        g.setColour(p.dim);
        g.setFont(smallFont());
        g.drawFittedText(tr("Select a clip of the scene to change it over time"), getLocalBounds(),
                         juce::Justification::centred, 2);
        drawFocusRing(g, *this, getLocalBounds().toFloat().reduced(1.0f));
        return;
    }
    const SceneRange range = sceneRangeOf(shown);
    g.setFont(smallFont());
    for (const double value : {range.low, 0.5 * (range.low + range.high), range.high})
    {
        const float y = placeOf({0.0, value}).y;
        g.setColour(p.line.withAlpha(0.6f));
        g.fillRect(0.0f, y, static_cast<float>(getWidth()), 1.0f);
        g.setColour(p.dim);
        g.drawText(juce::String(value, std::abs(value) >= 10.0 || value == 0.0 ? 0 : 1) + range.unit, 4,
                   juce::jlimit(0, getHeight() - 14, juce::roundToInt(y) - 14), 80, 14,
                   juce::Justification::centredLeft, false);
    }
    const Curve* points = curve();
    const Curve flat{{0.0, valueOf(part->play, shown)}};
    const Curve& drawn = points != nullptr && !points->empty() ? *points : flat;
    juce::Path line;
    constexpr int fineness = 2; // pixels
    for (int x = 0; x <= getWidth() - 2 * sceneMargin; x += fineness)
    {
        const double time = length() * x / std::max(1, getWidth() - 2 * sceneMargin);
        const auto place = placeOf({time, valueAt(shown, drawn, time)});
        x == 0 ? line.startNewSubPath(place) : line.lineTo(place);
    }
    g.setColour(points != nullptr ? p.accent : p.dim);
    g.strokePath(line, juce::PathStrokeType(2.0f));
    for (std::size_t i = 0; points != nullptr && i < points->size(); ++i)
    {
        const bool now = chosen == i;
        g.setColour(now ? p.text : p.accent);
        g.fillEllipse(juce::Rectangle<float>(now ? 11.0f : 8.0f, now ? 11.0f : 8.0f).withCentre(placeOf((*points)[i])));
    }
    drawFocusRing(g, *this, getLocalBounds().toFloat().reduced(1.0f));
}

} // namespace pacini::editor
