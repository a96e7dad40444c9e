// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Set-up step of the measure page: rig, connections and sweep.

#include "editor/Controls.h"
#include "editor/measure/InputMeter.h"
#include "editor/measure/MeasurementController.h"
#include "editor/measure/StepParts.h"

#include <array>

namespace pacini::editor
{

class SetUpStep final : public StepPanel
{
public:
    SetUpStep(MeasurementController& wanted, StepServices& around);
    void refresh() override;
    void tick() override;
    void paint(juce::Graphics& g) override;
    void resized() override;
    [[nodiscard]] int leastHeight() const override { return 440; }
    [[nodiscard]] const InputMeter& meter(std::size_t index) const { return meters[index]; }

private:
    static constexpr std::size_t inputs = MeasurementController::maxInputs;
    void takeWiring();
    void takeSettings();
    [[nodiscard]] juce::Rectangle<int> rigCard() const;
    [[nodiscard]] juce::Rectangle<int> sweepCard() const;

    MeasurementController& controller;
    StepServices& services;
    Named<juce::ComboBox> rig, output, base;
    std::array<Named<juce::ComboBox>, inputs> input;
    InputMeters meters;
    juce::ToggleButton calibrated;
    Slider fullScale;
    juce::ToggleButton tone;
    juce::TextButton devices;
    Named<Slider> level, low, high, duration, repeats;
    FactTable facts{"The sweep"};
    juce::TextButton saveSweep, openRecording;
    NoteBox notes{"Notes"};
};

} // namespace pacini::editor
