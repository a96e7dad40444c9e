// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Input level meter with peak hold and overload lamp, for setting a gain.

#include "editor/measure/MeasurementController.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <array>

namespace pacini::editor
{

/// A bar with the largest level of the last seconds and a lamp that stays lit after an overload; a click puts both
/// back. To be fed 30 times a second.
class InputMeter final : public juce::Component, public juce::SettableTooltipClient
{
public:
    InputMeter();

    void setName(const juce::String& wanted) override;
    /// The largest magnitude since the last call, full scale 1.
    void show(float peak);
    void reset();

    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent&) override { reset(); }

private:
    [[nodiscard]] juce::Rectangle<int> bar() const;
    [[nodiscard]] int pixelOf(float decibels) const;
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override;

    static constexpr float least = -72.0f; ///< dB
    float level = least, held = least;     ///< dB
    int holding = 0;                       ///< calls until the held level falls
    bool clipped = false;
    juce::String text;
};

using InputMeters = std::array<InputMeter, MeasurementController::maxInputs>;

/// Shows the meters of the wired inputs, with their names.
void nameMeters(InputMeters& meters, const MeasurementController& controller);
/// To be called 30 times a second.
void feedMeters(InputMeters& meters, MeasurementController& controller);

} // namespace pacini::editor
