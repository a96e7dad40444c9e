// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Verify step of the measure page: a sweep through the equaliser proves it.

#include "editor/Controls.h"
#include "editor/ResponsePlot.h"
#include "editor/measure/MeasurementController.h"
#include "editor/measure/StepParts.h"
#include "editor/measure/SweepStep.h"

#include <cstddef>

namespace pacini::editor
{

class VerifyStep final : public StepPanel
{
public:
    VerifyStep(MeasurementController& wanted, StepServices& around);
    void refresh() override;
    juce::Button* action() override { return &control.button; }
    void tick() override;
    void paint(juce::Graphics& g) override;
    void resized() override;

    SweepControl control;
    [[nodiscard]] const InputMeter& meter(std::size_t index) const { return meters[index]; }
    [[nodiscard]] const NoteBox& noteBox() const noexcept { return notes; }
    [[nodiscard]] const ResponsePlot& responsePlot() const noexcept { return plot; }

private:
    [[nodiscard]] juce::Rectangle<int> verdictArea() const;

    MeasurementController& controller;
    StepServices& services;
    InputMeters meters; ///< of all axes
    Named<Slider> tolerance;
    juce::TextButton saveSweep, openRecording, again;
    FactTable facts{"How flat it is"};
    NoteBox notes{"Notes on the verification"};
    ResponsePlot plot{"Response with and without equaliser", "Level over frequency, both measured"};
};

} // namespace pacini::editor
