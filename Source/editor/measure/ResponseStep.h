// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Response step of the measure page: frequency response, distortion and findings of the placements.

#include "editor/ResponsePlot.h"
#include "editor/measure/MeasurementController.h"
#include "editor/measure/StepParts.h"

namespace pacini::editor
{

class ResponseStep final : public StepPanel
{
public:
    explicit ResponseStep(MeasurementController& wanted);
    void refresh() override;
    void paint(juce::Graphics& g) override;
    void resized() override;
    [[nodiscard]] const ResponsePlot& responsePlot() const noexcept { return plot; }
    [[nodiscard]] const NoteBox& noteBox() const noexcept { return notes; }

private:
    MeasurementController& controller;
    FactTable facts{"The actuator"};
    NoteBox notes{"Notes on the measurement"};
    ResponsePlot plot{"Response", "Level over frequency: each placement, their average and the noise"};
    ResponsePlot distortion{"Distortion", "Harmonic distortion in percent over frequency"};
};

/// "dB re 1 m/s²", or relative without a calibration.
[[nodiscard]] juce::String levelUnit(const ActuatorMeasurement& work);

} // namespace pacini::editor
