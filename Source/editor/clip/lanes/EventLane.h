// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Lane of the clip's transients: their levels or their sharpness.

#include "editor/clip/lanes/PlotLane.h"

namespace pacini::editor
{

class EventLane final : public PlotLane
{
public:
    enum class Shows
    {
        amplitude,
        sharpness
    };
    EventLane(EditorModel& project, ClipSelection& selected, ViewState& sight, Transport& playing, Shows wanted);

    void addInside(Selection& selection, juce::Rectangle<float> area) const override;

private:
    Style style() const override;
    ValueAxis valueAxis(double height) const override;
    void paintPlot(juce::Graphics& g, juce::Rectangle<int> plot, int firstColumn, int lastColumn) override;
    std::optional<std::size_t> thingAt(juce::Point<float> place) const override;
    std::size_t count() const override;
    Breakpoint place(std::size_t thing) const override;
    Indices picked() const override { return clipSelection.selected().transients; }
    Selection pick(Selection selection, Indices things) const override;
    EditedClip added(const Clip& clip, Breakpoint where) const override;
    SelectionMove move(Breakpoint from, Breakpoint to) const override;
    juce::String valueText(double value) const override;
    juce::String tickText(double value) const override;
    std::optional<TimeRange> changedTime(const Clip& before, const Clip& now) const override;

    Shows shows;
};

} // namespace pacini::editor
