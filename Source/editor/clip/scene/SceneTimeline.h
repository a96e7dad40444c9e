// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Timeline of the project's scene: clips and textures on tracks, and which of them are not felt.

#include "document/view/LevelCurve.h"
#include "document/view/TimeAxis.h"
#include "editor/clip/scene/SceneSelection.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pacini::editor
{

/// Parts are selected, moved and removed by mouse and keys. Draws only visible parts.
class SceneTimeline final : public juce::Component, public juce::SettableTooltipClient
{
public:
    SceneTimeline(EditorModel& project, SceneSelection& selected);

    /// Why parts are left out, by index; and the time that plays, negative for none.
    void showLeftOut(std::map<std::size_t, std::string> reasons);
    void showPlayhead(double time);
    /// s: where a part goes that is added.
    [[nodiscard]] double cursor() const noexcept { return cursorTime; }
    /// The whole scene in sight.
    void fit();
    [[nodiscard]] juce::Rectangle<int> areaOf(std::size_t part) const;

    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& event) override;
    void mouseDrag(const juce::MouseEvent& event) override;
    void mouseMove(const juce::MouseEvent& event) override;
    void mouseWheelMove(const juce::MouseEvent& event, const juce::MouseWheelDetails& details) override;
    bool keyPressed(const juce::KeyPress& key) override;
    void focusGained(FocusChangeType) override { repaint(); }
    void focusLost(FocusChangeType) override { repaint(); }
    void resized() override;
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override;

    static constexpr int trackHeight = 48, rulerHeight = 24;

private:
    [[nodiscard]] std::optional<std::size_t> partAt(juce::Point<int> place) const;
    [[nodiscard]] double lengthOf(const ScenePart& part) const;
    [[nodiscard]] double snapped(std::size_t part, double start) const;
    void paintPart(juce::Graphics& g, std::size_t index, juce::Rectangle<int> area) const;
    [[nodiscard]] juce::String nameOf(const ScenePart& part) const;
    void say();

    EditorModel& model;
    SceneSelection& selection;
    TimeAxis axis{0.0, 0.01};
    int firstTrack = 0;
    double cursorTime = 0.0, playhead = -1.0;
    std::map<std::size_t, std::string> leftOut;
    Gesture gesture = 0;
    ScenePart grabbed; ///< as it was
    mutable LevelCurves levels;
    bool fitted = false;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
