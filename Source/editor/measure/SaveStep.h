// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Save step of the measure page: the profile made of the measurement.

#include "editor/measure/MeasurementController.h"
#include "editor/measure/StepParts.h"

namespace pacini::editor
{

class SaveStep final : public StepPanel
{
public:
    SaveStep(MeasurementController& wanted, StepServices& around);
    void refresh() override;
    juce::Button* action() override { return &saveButton; }
    void paint(juce::Graphics& g) override;
    void resized() override;

    Named<juce::TextEditor> name, file;
    juce::TextButton saveButton;
    [[nodiscard]] const NoteBox& noteBox() const noexcept { return notes; }

private:
    void follow();
    void save();

    MeasurementController& controller;
    StepServices& services;
    juce::TextButton browse;
    juce::ToggleButton use;
    FactTable facts{"Contents"};
    NoteBox notes{"Result"};
    bool ownFile = false; ///< the file has been chosen and no longer follows the name
    std::string problem;
};

} // namespace pacini::editor
