// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sweep step of the measure page: playing sweeps, and the list of placements.

#include "editor/measure/InputMeter.h"
#include "editor/measure/MeasurementController.h"
#include "editor/measure/StepParts.h"

#include <memory>
#include <vector>

namespace pacini::editor
{

/// A button that begins and stops a sweep, with its progress.
class SweepControl final : public juce::Component
{
public:
    SweepControl(MeasurementController& wanted, bool throughEqualizer);
    void refresh();
    void tick();
    void resized() override;
    juce::TextButton button;

private:
    [[nodiscard]] bool isMine() const;
    MeasurementController& controller;
    const bool verifying;
    double progress = 0.0;
    juce::ProgressBar bar{progress};
};

class SweepStep final : public StepPanel
{
public:
    explicit SweepStep(MeasurementController& wanted);
    void refresh() override;
    juce::Button* action() override { return &control.button; }
    void tick() override;
    void paint(juce::Graphics& g) override;
    void resized() override;

    SweepControl control;
    [[nodiscard]] const NoteBox& noteBox() const noexcept { return notes; }

private:
    struct Row
    {
        juce::Label name;
        juce::TextButton drop;
    };
    [[nodiscard]] juce::Rectangle<int> playCard() const;
    [[nodiscard]] juce::Rectangle<int> listCard() const;

    MeasurementController& controller;
    Named<juce::TextEditor> name;
    InputMeters meters;
    NoteBox notes{"Result of the last sweep"};
    juce::Viewport scroll;
    juce::Component list;
    std::vector<std::unique_ptr<Row>> rows;
};

} // namespace pacini::editor
