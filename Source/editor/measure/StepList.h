// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// List of the measurement's steps with the state of each.

#include "document/measure/ActuatorMeasurement.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <array>
#include <functional>

namespace pacini::editor
{

class StepList final : public juce::Component
{
public:
    StepList();

    std::function<void(MeasureStep)> onChoose;
    void show(MeasureStep current, const ActuatorMeasurement& work);
    void resized() override;
    [[nodiscard]] juce::Button& button(MeasureStep step) { return buttons[static_cast<std::size_t>(step)]; }

    [[nodiscard]] static juce::String nameOf(MeasureStep step);

private:
    class Row final : public juce::Button
    {
    public:
        Row() : juce::Button({}) {}
        void set(int wantedNumber, MeasureStepState wanted, bool isCurrent);

    private:
        void paintButton(juce::Graphics& g, bool over, bool down) override;
        int number = 1;
        MeasureStepState state = MeasureStepState::open;
        bool current = false;
    };

    std::array<Row, measureSteps> buttons;
};

} // namespace pacini::editor
