// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Lane of a curve of the clip.

#include "document/DrawnCurve.h"
#include "editor/clip/lanes/PlotLane.h"

#include <cstddef>
#include <utility>

namespace pacini::editor
{

/// Few points are drawn with their handles and can be picked; many as one bar for each column of pixels.
class CurveLane final : public PlotLane
{
public:
    CurveLane(EditorModel& project, ClipSelection& selected, ViewState& sight, Transport& playing, Lane first);

    [[nodiscard]] Lane lane() const noexcept { return shown; }

    /// A curve in Hz that is drawn behind the clip's own, which cannot be edited; see brightnessOf(). Null: none. It
    /// outlives the lane; repaint() after its change.
    void setBehind(const Curve* wanted) { behind = wanted; }

    void addInside(Selection& selection, juce::Rectangle<float> area) const override;
    void resized() override;

private:
    [[nodiscard]] const Curve* curve() const;
    [[nodiscard]] bool showsHandles() const;
    void showHearing();

    Style style() const override;
    ValueAxis valueAxis(double height) const override;
    void paintPlot(juce::Graphics& g, juce::Rectangle<int> plot, int firstColumn, int lastColumn) override;
    void paintBehind(juce::Graphics& g, juce::Rectangle<int> plot, int firstColumn, int lastColumn);
    void paintColumns(juce::Graphics& g, juce::Rectangle<int> plot, int firstColumn, int lastColumn,
                      juce::Colour colour, bool bars);
    void paintLine(juce::Graphics& g, juce::Rectangle<int> plot, int firstColumn, int lastColumn,
                   std::pair<std::size_t, std::size_t> range);
    void paintHandles(juce::Graphics& g, std::pair<std::size_t, std::size_t> range, juce::Colour colour);
    std::optional<std::size_t> thingAt(juce::Point<float> place) const override;
    std::size_t count() const override;
    Breakpoint place(std::size_t thing) const override;
    Indices picked() const override { return selectedIn(clipSelection.selected(), shown); }
    Selection pick(Selection selection, Indices things) const override;
    EditedClip added(const Clip& clip, Breakpoint where) const override;
    SelectionMove move(Breakpoint from, Breakpoint to) const override;
    juce::String valueText(double value) const override;
    std::optional<TimeRange> changedTime(const Clip& before, const Clip& now) const override;
    bool beginTool(const juce::MouseEvent& event) override;
    void dragTool(const juce::MouseEvent& event) override;
    void endTool() override { bent.reset(); }
    juce::MouseCursor cursorAt(const juce::MouseEvent& event) const override;
    [[nodiscard]] std::optional<std::size_t> lineAt(juce::Point<float> place) const;
    void draw(juce::Point<float> to);
    template <typename Edit>
    void change(const char* name, Edit edit);

    /// The line behind point `first` was grabbed.
    struct Bend
    {
        std::size_t first = 0;
        double time = 0.0; ///< s
    };

    Lane shown;
    const Curve* behind = nullptr;
    Stroke stroke;
    std::optional<Bend> bent;
    Gesture toolGesture = 0;
    bool muted = false;
    bool drewHandles = false; ///< the last time
    juce::ToggleButton pitchButton, soloButton, muteButton;
};

} // namespace pacini::editor
