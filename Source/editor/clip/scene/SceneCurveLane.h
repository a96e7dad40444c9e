// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Curve of one parameter of the selected part of a scene: points that are added, moved and removed.

#include "document/view/ValueAxis.h"
#include "editor/clip/scene/SceneSelection.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <cstddef>
#include <optional>

namespace pacini::editor
{

/// The displayed and editable range of a parameter.
struct SceneRange
{
    double low = 0.0, high = 1.0, usual = 0.0;
    const char* unit = "";
};
[[nodiscard]] SceneRange sceneRangeOf(SceneParameter parameter) noexcept;

class SceneCurveLane final : public juce::Component, public juce::SettableTooltipClient
{
public:
    SceneCurveLane(EditorModel& project, SceneSelection& selected);

    [[nodiscard]] SceneParameter parameter() const noexcept { return shown; }
    void show(SceneParameter wanted);
    void removeCurve();

    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& event) override;
    void mouseDrag(const juce::MouseEvent& event) override;
    void mouseDoubleClick(const juce::MouseEvent& event) override;
    bool keyPressed(const juce::KeyPress& key) override;
    void focusGained(FocusChangeType) override { repaint(); }
    void focusLost(FocusChangeType) override { repaint(); }

private:
    [[nodiscard]] const Curve* curve() const;
    [[nodiscard]] double length() const;
    [[nodiscard]] juce::Point<float> placeOf(Breakpoint point) const;
    [[nodiscard]] Breakpoint pointAt(juce::Point<float> place) const;
    [[nodiscard]] std::optional<std::size_t> thingAt(juce::Point<float> place) const;
    bool setPoints(const char* step, Curve points, Gesture of = 0);
    void movePoint(std::size_t index, Breakpoint to, const Curve& from, Gesture of);

    EditorModel& model;
    SceneSelection& selection;
    SceneParameter shown = SceneParameter::pan;
    std::optional<std::size_t> chosen;
    Gesture gesture = 0;
    Curve grabbed;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
