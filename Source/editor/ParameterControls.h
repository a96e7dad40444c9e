// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Controls that show and set one parameter of a processor. Each has the context menu of ParameterMenu.h.

#include "editor/Controls.h"
#include "editor/Refreshed.h"

#include <juce_audio_processors/juce_audio_processors.h>

#include <vector>

namespace pacini::editor
{

/// A knob or a horizontal slider with its name and an editable value with unit.
class ParameterSlider final : public juce::Component, public Refreshed
{
public:
    enum class Shape
    {
        knob, ///< name above, value below
        bar   ///< name, if there is one, at the left, value at the right
    };

    /// `label` is what is shown, `name` what a screen reader says.
    ParameterSlider(juce::AudioProcessorParameter& shown, Shape wanted, const juce::String& label,
                    const juce::String& name, const juce::String& help);

    /// What the name needs in the usual type, with a little room.
    [[nodiscard]] int nameWidth() const;

    void refresh() override;
    void resized() override;
    void enablementChanged() override;
    void mouseDown(const juce::MouseEvent& event) override;
    bool keyPressed(const juce::KeyPress& key) override;

private:
    void showMenu(bool atPointer);

    juce::AudioProcessorParameter& parameter;
    Shape shape;
    juce::Label title;
    Slider slider;
    bool dragged = false;
};

class ParameterToggle final : public juce::ToggleButton, public Refreshed
{
public:
    ParameterToggle(juce::AudioProcessorParameter& shown, const juce::String& text, const juce::String& name,
                    const juce::String& help);
    void refresh() override;
    void mouseDown(const juce::MouseEvent& event) override;
    void mouseUp(const juce::MouseEvent& event) override;
    bool keyPressed(const juce::KeyPress& key) override;

private:
    juce::AudioProcessorParameter& parameter;
};

/// A menu of some or all values of a parameter that knows whole values only.
class ParameterChoice final : public juce::ComboBox, public Refreshed
{
public:
    /// `values` are the numbers of the choices that the menu has.
    ParameterChoice(juce::AudioProcessorParameter& shown, const std::vector<int>& values, const juce::String& name,
                    const juce::String& help);
    void refresh() override;
    void mouseDown(const juce::MouseEvent& event) override;
    bool keyPressed(const juce::KeyPress& key) override;

private:
    [[nodiscard]] int valueNow() const;

    juce::AudioProcessorParameter& parameter;
    int shown = -1;
};

/// Sets a parameter as one gesture that the host records.
void setAsGesture(juce::AudioProcessorParameter& parameter, float normal);

} // namespace pacini::editor
