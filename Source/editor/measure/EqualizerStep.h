// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Equaliser step of the measure page: the fit that flattens the response.

#include "editor/Controls.h"
#include "editor/ResponsePlot.h"
#include "editor/measure/MeasurementController.h"
#include "editor/measure/StepParts.h"

namespace pacini::editor
{

class EqualizerStep final : public StepPanel
{
public:
    explicit EqualizerStep(MeasurementController& wanted);
    void refresh() override;
    void paint(juce::Graphics& g) override;
    void resized() override;
    Named<juce::ComboBox> sections;
    Named<Slider> boost, low, high;
    [[nodiscard]] const ResponsePlot& responsePlot() const noexcept { return plot; }

private:
    void takeWish();
    MeasurementController& controller;
    FactTable table{"Sections"};
    FactTable facts{"What the equaliser does"};
    NoteBox notes{"Notes on the equaliser"};
    juce::Viewport scroll;
    ResponsePlot plot{"Response before and after", "Level over frequency, measured and equalised"};
};

} // namespace pacini::editor
