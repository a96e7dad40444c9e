// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/scene/SceneTimeline.h"

#include "document/view/Columns.h"
#include "document/view/TimeTicks.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/lanes/LaneText.h"

#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr double snapReach = 8.0; // pixels
constexpr double keyStep = 0.01;  // s

/// s of the clip that is played `time` s after a part's start.
double placeInClip(const ScenePlay& play, double duration, double time)
{
    const double loop = std::min(play.loop, duration);
    return loop > 0.0 ? std::fmod(time / play.stretch, loop) : time / play.stretch;
}
} // namespace

SceneTimeline::SceneTimeline(EditorModel& project, SceneSelection& selected) : model(project), selection(selected)
{
    setTitle("Timeline");
    setWantsKeyboardFocus(true);
    subscriptions.on({&model.projectChanged, &selection.changed},
                     [this]
                     {
                         leftOut.clear();
                         repaint();
                     });
}

void SceneTimeline::showLeftOut(std::map<std::size_t, std::string> reasons)
{
    leftOut = std::move(reasons);
    repaint();
}

void SceneTimeline::showPlayhead(double time)
{
    const auto strip = [this](double at)
    {
        return juce::Rectangle<int>(juce::roundToInt(std::clamp(axis.xOf(at), -10.0, 1e5)) - 2, 0, 5, getHeight());
    };
    repaint(strip(playhead));
    playhead = time;
    repaint(strip(playhead));
}

double SceneTimeline::lengthOf(const ScenePart& part) const
{
    return std::max(0.1, pacini::lengthOf(model.document().project(), part));
}

void SceneTimeline::fit()
{
    const double end = std::max(4.0, sceneEnd(model.document().project()));
    axis = {0.0, 1.05 * end / std::max(1, getWidth())};
    firstTrack = 0;
    repaint();
}

void SceneTimeline::resized()
{
    if (!std::exchange(fitted, getWidth() > 0))
        fit();
}

juce::Rectangle<int> SceneTimeline::areaOf(std::size_t part) const
{
    const ScenePart& one = selection.scene().parts[part];
    const double from = std::clamp(axis.xOf(one.play.start + one.play.delay), -1e5, 1e5);
    const double to = std::clamp(axis.xOf(one.play.start + one.play.delay + lengthOf(one)), -1e5, 1e5);
    return {juce::roundToInt(from), rulerHeight + (one.track - firstTrack) * trackHeight + 2,
            std::max(6, juce::roundToInt(to - from)), trackHeight - 4};
}

std::optional<std::size_t> SceneTimeline::partAt(juce::Point<int> place) const
{
    for (std::size_t i = selection.scene().parts.size(); i-- > 0;)
        if (areaOf(i).contains(place))
            return i;
    return {};
}

void SceneTimeline::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.well);
    const auto visible = g.getClipBounds();
    g.setFont(smallFont());
    for (int y = rulerHeight; y < getHeight(); y += trackHeight)
    {
        g.setColour(p.line.withAlpha(0.6f));
        g.fillRect(0, y, getWidth(), 1);
    }
    g.setColour(p.card);
    g.fillRect(0, 0, getWidth(), rulerHeight);
    const double step = tickStep(axis.secondsPerPixel);
    int taken = 0; // by the text before
    for (double i = std::ceil(axis.start / step); axis.xOf(i * step) < getWidth(); i += 1.0)
    {
        const int x = juce::roundToInt(axis.xOf(i * step));
        g.setColour(p.line);
        g.fillRect(x, 0, 1, getHeight());
        g.setColour(p.dim);
        taken = drawTickText(g, timeText(i * step, step), x, {0, 2, getWidth(), rulerHeight - 6}, taken);
    }
    const auto& parts = selection.scene().parts;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (const auto area = areaOf(i); area.getY() >= rulerHeight && area.intersects(visible))
            paintPart(g, i, area);
    g.setColour(p.accent);
    g.fillRect(juce::roundToInt(axis.xOf(cursorTime)), 0, 1, getHeight());
    if (playhead >= 0.0)
    {
        g.setColour(p.text);
        g.fillRect(juce::roundToInt(axis.xOf(playhead)), 0, 1, getHeight());
    }
    if (parts.empty())
    {
        g.setColour(p.dim);
        g.setFont(usualFont());
        g.drawFittedText(tr("No clip is in the scene yet. Choose one above to add it at the cursor."), getLocalBounds(),
                         juce::Justification::centred, 2);
    }
    drawFocusRing(g, *this, getLocalBounds().toFloat().reduced(1.0f));
}

void SceneTimeline::paintPart(juce::Graphics& g, std::size_t index, juce::Rectangle<int> area) const
{
    const Palette& p = paletteFor(*this);
    const ScenePart& part = selection.scene().parts[index];
    const auto item = model.document().clip(part.clip);
    const bool out = leftOut.contains(index) || !item;
    const bool selected = selection.selected() == index;
    g.setColour(p.card);
    g.fillRoundedRectangle(area.toFloat(), 4.0f);
    const juce::Graphics::ScopedSaveState saved(g);
    g.reduceClipRegion(area.reduced(1));
    if (item && part.play.texture)
    {
        // Its speed, from the foot to the top.
        g.setColour((out ? p.dim : p.accent).withAlpha(out ? 0.25f : 0.5f));
        const auto course = std::find_if(part.curves.begin(), part.curves.end(),
                                         [](const SceneCurve& one)
                                         { return one.parameter == SceneParameter::speed && !one.points.empty(); });
        const Curve points = course != part.curves.end() ? course->points : Curve{{0.0, part.play.speed}};
        for (int x = std::max(0, -area.getX()), last = std::min(area.getWidth(), getWidth() - area.getX()); x < last;
             ++x)
        {
            const double speed = valueAt(SceneParameter::speed, points, x * axis.secondsPerPixel);
            const int height = juce::roundToInt(speed * (area.getHeight() - 2));
            g.fillRect(area.getX() + x, area.getBottom() - 1 - height, 1, height);
        }
    }
    else if (item)
    {
        // The envelope, as far as it is in sight.
        const int first = std::max(0, -area.getX()), last = std::min(area.getWidth(), getWidth() - area.getX());
        if (last > first)
        {
            std::vector<Column> columns(static_cast<std::size_t>(last - first));
            const Curve& level = levels.of(item->clip);
            if (part.play.loop == 0.0 && part.play.stretch == 1.0)
                curveColumns(level, TimeAxis{first * axis.secondsPerPixel, axis.secondsPerPixel}, columns);
            else
                for (std::size_t i = 0; i < columns.size(); ++i)
                    columns[i].high = static_cast<float>(
                        valueAt(level, placeInClip(part.play, item->clip->duration,
                                                   (first + static_cast<double>(i)) * axis.secondsPerPixel)));
            g.setColour((out ? p.dim : p.accent).withAlpha(out ? 0.25f : 0.5f));
            for (std::size_t i = 0; i < columns.size(); ++i)
            {
                const double dB = Decibels::fromGain(std::max(1e-3, static_cast<double>(columns[i].high))).value;
                const int height = juce::roundToInt((1.0 + dB / 60.0) * (area.getHeight() - 2));
                g.fillRect(area.getX() + first + static_cast<int>(i), area.getBottom() - 1 - height, 1, height);
            }
        }
    }
    g.setColour(out ? p.dim : p.text);
    g.setFont(smallFont());
    g.drawText((out ? toText("∅ ") : juce::String()) + nameOf(part), area.reduced(6, 3).removeFromTop(16),
               juce::Justification::centredLeft, true);
    g.setColour(selected ? p.text : p.line);
    g.drawRoundedRectangle(area.toFloat().reduced(0.5f), 4.0f, selected ? 2.0f : 1.0f);
}

juce::String SceneTimeline::nameOf(const ScenePart& part) const
{
    const auto item = model.document().clip(part.clip);
    if (!item)
        return tr("Clip is gone");
    if (!part.play.texture)
        return toText(item->clip->name);
    const std::string& name = selection.scene().textures[*part.play.texture].content->name;
    return tr("Texture: {0}", {name.empty() ? juce::String(*part.play.texture + 1) : toText(name)});
}

// Mouse and keys.

void SceneTimeline::mouseDown(const juce::MouseEvent& event)
{
    grabKeyboardFocus();
    gesture = 0;
    if (event.y < rulerHeight)
    {
        cursorTime = std::max(0.0, axis.timeAt(static_cast<double>(event.position.x)));
        return repaint();
    }
    const auto part = partAt(event.getPosition());
    selection.select(part);
    if (!part)
    {
        cursorTime = std::max(0.0, axis.timeAt(static_cast<double>(event.position.x)));
        return repaint();
    }
    grabbed = *selection.part();
    gesture = selection.beginGesture();
    say();
}

void SceneTimeline::mouseDrag(const juce::MouseEvent& event)
{
    if (gesture == 0)
        return mouseDown(event);
    const auto index = selection.selected();
    if (!index || !event.mouseWasDraggedSinceMouseDown())
        return;
    const double start = grabbed.play.start + event.getDistanceFromDragStartX() * axis.secondsPerPixel;
    const int track =
        grabbed.track + juce::roundToInt(static_cast<double>(event.getDistanceFromDragStartY()) / trackHeight);
    selection.editPart(
        "Move in scene",
        [&](ScenePart& part)
        {
            part.play.start = std::max(0.0, event.mods.isAltDown() ? start : snapped(*index, start));
            part.track = std::clamp(track, 0, 999);
        },
        gesture);
    say();
}

/// To starts and ends of other parts, and to the cursor.
double SceneTimeline::snapped(std::size_t part, double start) const
{
    const auto& parts = selection.scene().parts;
    const double length = lengthOf(parts[part]);
    double best = start, nearest = snapReach * axis.secondsPerPixel;
    const auto offer = [&](double target)
    {
        for (const double candidate : {target, target - length})
            if (std::abs(candidate - start) < nearest)
            {
                nearest = std::abs(candidate - start);
                best = candidate;
            }
    };
    offer(0.0);
    offer(cursorTime);
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (i != part)
        {
            offer(parts[i].play.start);
            offer(parts[i].play.start + lengthOf(parts[i]));
        }
    return best;
}

void SceneTimeline::mouseMove(const juce::MouseEvent& event)
{
    const auto part = partAt(event.getPosition());
    const auto reason = part ? leftOut.find(*part) : leftOut.end();
    setTooltip(reason != leftOut.end() ? translateMessage(toText(reason->second))
               : part                  ? tr("Drag: moves it; Delete: removes it")
                                       : tr("Click: places the cursor, where clips are added"));
}

void SceneTimeline::mouseWheelMove(const juce::MouseEvent& event, const juce::MouseWheelDetails& details)
{
    if (event.mods.isCommandDown())
    {
        const double at = axis.timeAt(static_cast<double>(event.position.x));
        axis.secondsPerPixel =
            std::clamp(axis.secondsPerPixel * std::exp2(-4.0 * static_cast<double>(details.deltaY)), 1e-4, 10.0);
        axis.start = std::max(0.0, at - static_cast<double>(event.position.x) * axis.secondsPerPixel);
    }
    else if (event.mods.isShiftDown() || std::abs(details.deltaX) > std::abs(details.deltaY))
        axis.start =
            std::max(0.0, axis.start - static_cast<double>(details.deltaX != 0.0f ? details.deltaX : details.deltaY) *
                                           getWidth() * axis.secondsPerPixel);
    else
        firstTrack = std::max(0, firstTrack + (details.deltaY < 0.0f ? 1 : -1));
    repaint();
}

bool SceneTimeline::keyPressed(const juce::KeyPress& key)
{
    using Key = juce::KeyPress;
    const auto& parts = selection.scene().parts;
    if (key == Key::deleteKey || key == Key::backspaceKey)
    {
        selection.removeSelected();
        return true;
    }
    if (key.getTextCharacter() == ',' || key.getTextCharacter() == '.')
    {
        if (parts.empty())
            return true;
        const auto now = selection.selected();
        const std::size_t by = key.getTextCharacter() == '.' ? 1 : parts.size() - 1;
        selection.select(now ? (*now + by) % parts.size() : 0);
        say();
        return true;
    }
    const double step = key.getModifiers().isShiftDown() ? 10.0 * keyStep : keyStep;
    const double time = key.isKeyCode(Key::leftKey) ? -step : key.isKeyCode(Key::rightKey) ? step : 0.0;
    const int track = key.isKeyCode(Key::upKey) ? -1 : key.isKeyCode(Key::downKey) ? 1 : 0;
    if (time == 0.0 && track == 0)
        return false;
    if (!selection.selected())
    {
        cursorTime = std::max(0.0, cursorTime + time);
        repaint();
        return true;
    }
    selection.editPart("Move in scene",
                       [&](ScenePart& part)
                       {
                           part.play.start = std::max(0.0, part.play.start + time);
                           part.track = std::clamp(part.track + track, 0, 999);
                       });
    say();
    return true;
}

/// Where the selected part is, for the tooltip and for screen readers.
void SceneTimeline::say()
{
    const ScenePart* part = selection.part();
    if (part == nullptr)
        return;
    const juce::String text = tr("{0} at {1} s on track {2}",
                                 {nameOf(*part), numberText(part->play.start, 2), juce::String(part->track + 1)});
    setDescription(text);
    if (hasKeyboardFocus(false))
        juce::AccessibilityHandler::postAnnouncement(text, juce::AccessibilityHandler::AnnouncementPriority::medium);
}

std::unique_ptr<juce::AccessibilityHandler> SceneTimeline::createAccessibilityHandler()
{
    return std::make_unique<juce::AccessibilityHandler>(*this, juce::AccessibilityRole::group);
}

} // namespace pacini::editor
