// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/ParameterControls.h"

#include "editor/Controls.h"
#include "editor/ParameterMenu.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr int barNumber = 7 * grid; // width of the number of a slider
constexpr int mostKnobHeight = space::mostKnob + 4 + 2 * (2 * grid + 2);

/// Draws the value from 0 where that is its rest in the middle of the way, as of a gain or a transposition.
void setOriginOf(juce::Slider& slider, const juce::AudioProcessorParameter& parameter)
{
    const auto* ranged = dynamic_cast<const juce::RangedAudioParameter*>(&parameter);
    if (ranged == nullptr)
        return;
    const auto& range = ranged->getNormalisableRange();
    const bool rests = std::abs(range.convertFrom0to1(ranged->getDefaultValue())) < 1e-4f;
    if (rests && range.start < 0.0f && range.end > 0.0f)
        setOrigin(slider, static_cast<double>(range.convertTo0to1(0.0f)));
}

juce::String withRange(const juce::AudioProcessorParameter& parameter, const juce::String& help)
{
    const auto text = [&](float normal)
    {
        return withDecimalMark(parameter.getText(normal, 0));
    };
    return tr(help) + "\n" + tr("{0} to {1}, default {2}", {text(0.0f), text(1.0f), text(parameter.getDefaultValue())});
}
} // namespace

void setAsGesture(juce::AudioProcessorParameter& parameter, float normal)
{
    parameter.beginChangeGesture();
    parameter.setValueNotifyingHost(normal);
    parameter.endChangeGesture();
}

ParameterSlider::ParameterSlider(juce::AudioProcessorParameter& shown, Shape wanted, const juce::String& label,
                                 const juce::String& name, const juce::String& help)
    : parameter(shown), shape(wanted)
{
    const bool knob = shape == Shape::knob;
    title.setText(label, juce::dontSendNotification);
    title.setFont(smallFont());
    title.setJustificationType(knob ? juce::Justification::centred : juce::Justification::centredLeft);
    title.setBorderSize(knob ? juce::BorderSize<int>() : title.getBorderSize());
    title.setInterceptsMouseClicks(false, false);
    title.setAccessible(false);
    addAndMakeVisible(title);

    slider.setSliderStyle(knob ? juce::Slider::RotaryHorizontalVerticalDrag : juce::Slider::LinearHorizontal);
    slider.setRange(0.0, 1.0, parameter.isDiscrete() ? 1.0 / (parameter.getNumSteps() - 1) : 0.0);
    slider.textFromValueFunction = [this](double value)
    {
        return parameter.getText(static_cast<float>(value), 0);
    };
    slider.valueFromTextFunction = [this](const juce::String& text)
    {
        return static_cast<double>(parameter.getValueForText(text));
    };
    slider.setTextBoxStyle(knob ? juce::Slider::TextBoxBelow : juce::Slider::TextBoxRight, false, barNumber,
                           2 * grid + 2);
    slider.setDoubleClickReturnValue(true, static_cast<double>(parameter.getDefaultValue()));
    setOriginOf(slider, parameter);
    slider.setWantsKeyboardFocus(true);
    slider.setTitle(name);
    slider.setDescription(help);
    slider.setTooltip(withRange(parameter, help));
    slider.onDragStart = [this]
    {
        dragged = true;
        parameter.beginChangeGesture();
    };
    slider.onDragEnd = [this]
    {
        dragged = false;
        parameter.endChangeGesture();
    };
    slider.onValueChange = [this]
    {
        const auto value = static_cast<float>(slider.getValue());
        if (dragged)
            parameter.setValueNotifyingHost(value);
        else
            setAsGesture(parameter, value);
    };
    slider.onMenu = [this]
    {
        showMenu(true);
    };
    slider.addMouseListener(this, true); // for the text of the value
    slider.setValue(static_cast<double>(parameter.getValue()), juce::dontSendNotification);
    slider.updateText();
    addAndMakeVisible(slider);
}

void ParameterSlider::showMenu(bool atPointer)
{
    std::function<void()> type;
    if (isEnabled())
        type = [safe = juce::Component::SafePointer<ParameterSlider>(this)]
        {
            if (safe)
                safe->slider.showTextBox();
        };
    showParameterMenu(*this, parameter, std::move(type), atPointer);
}

void ParameterSlider::mouseDown(const juce::MouseEvent& event)
{
    if (event.mods.isPopupMenu() && event.eventComponent != &slider) // which tells by itself
        showMenu(true);
}

bool ParameterSlider::keyPressed(const juce::KeyPress& key)
{
    if (!isContextMenuKey(key))
        return false;
    showMenu(false);
    return true;
}

void ParameterSlider::refresh()
{
    const auto value = static_cast<double>(parameter.getValue());
    if (!dragged && std::abs(value - slider.getValue()) > 1e-6)
        slider.setValue(value, juce::dontSendNotification);
}

void ParameterSlider::resized()
{
    auto area = getLocalBounds();
    // In a tall window a knob would drift away from its name above and its value below.
    if (shape == Shape::knob)
        area = area.withSizeKeepingCentre(area.getWidth(), std::min(area.getHeight(), mostKnobHeight));
    if (shape == Shape::knob)
    {
        title.setBounds(area.removeFromTop(2 * grid + 2));
        slider.setBounds(area);
    }
    else
    {
        const int names =
            title.getText().isEmpty() ? 0 : std::min(std::max(11 * grid - 2, nameWidth()), area.getWidth() / 2);
        const NamedSlider named{title, slider, barNumber};
        const bool above = !hasTracks({named}, names, area.getWidth());
        title.setInterceptsMouseClicks(above, false); // the slider is below it then
        title.setBorderSize(above ? juce::BorderSize<int>() : juce::Label().getBorderSize());
        placeSlider(named, names, area, above);
    }
    // Names that have no room in a language are a size smaller before they are cut.
    title.setFont(nameWidth() - grid / 2 <= title.getWidth() ? smallFont() : captionFont());
}

int ParameterSlider::nameWidth() const
{
    return smallFont().getStringWidth(title.getText()) + title.getBorderSize().getLeftAndRight() + grid / 2;
}

void ParameterSlider::enablementChanged()
{
    title.setEnabled(isEnabled());
    slider.setEnabled(isEnabled());
}

ParameterToggle::ParameterToggle(juce::AudioProcessorParameter& shown, const juce::String& caption,
                                 const juce::String& name, const juce::String& help)
    : juce::ToggleButton(caption), parameter(shown)
{
    setTitle(name);
    setDescription(help);
    setTooltip(help);
    refresh();
    onClick = [this]
    {
        setAsGesture(parameter, getToggleState() ? 1.0f : 0.0f);
    };
}

void ParameterToggle::mouseDown(const juce::MouseEvent& event)
{
    if (event.mods.isPopupMenu())
        showParameterMenu(*this, parameter, {}, true);
    else
        juce::ToggleButton::mouseDown(event);
}

void ParameterToggle::mouseUp(const juce::MouseEvent& event)
{
    if (!event.mods.isPopupMenu())
        juce::ToggleButton::mouseUp(event);
}

bool ParameterToggle::keyPressed(const juce::KeyPress& key)
{
    if (!isContextMenuKey(key))
        return juce::ToggleButton::keyPressed(key);
    showParameterMenu(*this, parameter, {}, false);
    return true;
}

void ParameterToggle::refresh()
{
    const bool on = parameter.getValue() >= 0.5f;
    if (on != getToggleState())
        setToggleState(on, juce::dontSendNotification);
}

ParameterChoice::ParameterChoice(juce::AudioProcessorParameter& shownParameter, const std::vector<int>& values,
                                 const juce::String& name, const juce::String& help)
    : parameter(shownParameter)
{
    const float steps = static_cast<float>(parameter.getNumSteps() - 1);
    for (const int value : values)
        addItem(withDecimalMark(parameter.getText(static_cast<float>(value) / steps, 0)), value + 1);
    setTitle(name);
    setDescription(help);
    setTooltip(help);
    setWantsKeyboardFocus(true);
    refresh();
    onChange = [this]
    {
        if (getSelectedId() == 0)
            return;
        shown = getSelectedId() - 1;
        setAsGesture(parameter, static_cast<float>(shown) / static_cast<float>(parameter.getNumSteps() - 1));
    };
}

void ParameterChoice::mouseDown(const juce::MouseEvent& event)
{
    if (event.mods.isPopupMenu())
        showParameterMenu(*this, parameter, {}, true);
    else
        juce::ComboBox::mouseDown(event);
}

bool ParameterChoice::keyPressed(const juce::KeyPress& key)
{
    if (!isContextMenuKey(key))
        return juce::ComboBox::keyPressed(key);
    showParameterMenu(*this, parameter, {}, false);
    return true;
}

int ParameterChoice::valueNow() const
{
    return static_cast<int>(std::lround(parameter.getValue() * static_cast<float>(parameter.getNumSteps() - 1)));
}

void ParameterChoice::refresh()
{
    const int value = valueNow();
    if (value == shown)
        return;
    shown = value;
    setSelectedId(value + 1, juce::dontSendNotification);
    if (getSelectedId() != value + 1)
        setText(withDecimalMark(parameter.getCurrentValueAsText()), juce::dontSendNotification);
}

} // namespace pacini::editor
