// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/DevicesSheet.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>

namespace pacini::app
{

namespace
{
using editor::grid;
constexpr auto noController = "No supported controller connected";
constexpr int none = 1; // menus know no item 0; channels follow
} // namespace

DevicesSheet::DevicesSheet(PreviewDevices& wanted, ControllerOutput& wantedControllers)
    : Sheet("Audio devices", 760, 640), rig(wanted), controllerOutput(wantedControllers), settings(wanted.devices())
{
    prepareSound();
    hapticLabel.setText("Haptic output", juce::dontSendNotification);
    hapticLabel.setFont(editor::usualFont());
    hapticLabel.setAccessible(false);
    hapticButton.setButtonText(editor::toText("Haptic outputs…"));
    editor::prepareButton(hapticButton, "Outputs that clips play on: actuator, gain, delay and position of each",
                          [this]
                          {
                              if (onHapticOutputs)
                                  onHapticOutputs();
                          });
    controllerLabel.setText("Controller", juce::dontSendNotification);
    controllerLabel.setFont(editor::usualFont());
    controllerLabel.setAccessible(false);
    controllerNote.setFont(editor::smallFont());
    controllerChoice.setTitle("Game controller");
    controllerChoice.setTooltip("Controller or haptic device that plays along");
    controllerChoice.setTextWhenNothingSelected(editor::tr("None"));
    controllerChoice.onChange = [this]
    {
        chooseController();
    };
    for (juce::Component* part : std::initializer_list<juce::Component*>{&hapticLabel, &hapticButton, &controllerLabel,
                                                                         &controllerChoice, &controllerNote})
        addAndMakeVisible(part);
    addAndMakeVisible(settings);
    rig.devices().addChangeListener(this);
    setAnswers({{"Close", {}}});
    fill();
}

void DevicesSheet::prepareSound()
{
    const juce::String name = "Sound output";
    soundLabel.setText(name, juce::dontSendNotification);
    soundLabel.setFont(editor::usualFont());
    soundLabel.setAccessible(false);
    soundChannel.setTitle(name);
    soundChannel.setTooltip("Output channels for the sound");
    soundChannel.onChange = [this]
    {
        rig.setSoundOutput(soundChannel.getSelectedId() - none - 1);
    };
    const auto slider = [](juce::Slider& one, const juce::String& title, const juce::String& tip,
                           const juce::String& unit, juce::Range<double> range, double step)
    {
        one.setSliderStyle(juce::Slider::LinearHorizontal);
        one.setTextBoxStyle(juce::Slider::TextBoxRight, false, 8 * grid, 3 * grid);
        one.setTitle(title);
        one.setTooltip(tip);
        one.setRange(range, step);
        one.setTextValueSuffix(unit);
        one.setDoubleClickReturnValue(true, 0.0);
        one.setWantsKeyboardFocus(true);
    };
    slider(soundLevel, editor::tr("{0}: level", {editor::tr(name)}), "Level in dB", " dB", {-60.0, 6.0}, 0.5);
    slider(soundDelay, editor::tr("{0}: delay", {editor::tr(name)}), "Delay in ms, to align sound and haptics", " ms",
           {0.0, 1000.0 * editor::OutputTrim::longestDelay}, 1.0);
    soundLevel.setValue(juce::Decibels::gainToDecibels(rig.soundTrim().levelNow(), -60.0), juce::dontSendNotification);
    soundDelay.setValue(1000.0 * rig.soundTrim().delayNow(), juce::dontSendNotification);
    soundLevel.onValueChange = [this]
    {
        rig.soundTrim().setLevel(juce::Decibels::decibelsToGain(soundLevel.getValue(), -60.0));
    };
    soundDelay.onValueChange = [this]
    {
        rig.soundTrim().setDelay(0.001 * soundDelay.getValue());
    };
    for (juce::Component* part :
         std::initializer_list<juce::Component*>{&soundLabel, &soundChannel, &soundLevel, &soundDelay})
        addAndMakeVisible(part);
}

DevicesSheet::~DevicesSheet()
{
    rig.devices().removeChangeListener(this);
}

void DevicesSheet::fill()
{
    const auto names = rig.outputNames();
    soundChannel.clear(juce::dontSendNotification);
    soundChannel.addItem(editor::tr("None"), none);
    for (int c = 0; c < names.size(); c += 2)
        soundChannel.addItem(editor::tr("Outputs {0}+{1}", {juce::String(c + 1), juce::String(c + 2)}), none + 1 + c);
    soundChannel.setSelectedId(none + 1 + rig.soundOutput(), juce::dontSendNotification);
}

/// Controllers come and go while the sheet is open.
void DevicesSheet::fillControllers()
{
    const auto connected = ControllerOutput::connected();
    const auto found = connected ? *connected : std::vector<devices::Controller>();
    const auto same = [](const devices::Controller& a, const devices::Controller& b)
    {
        return a.path == b.path && a.name == b.name;
    };
    if (!std::equal(found.begin(), found.end(), controllers.begin(), controllers.end(), same))
    {
        controllers = found;
        controllerChoice.clear(juce::dontSendNotification);
        controllerChoice.addItem(editor::tr("None"), none);
        for (std::size_t i = 0; i < controllers.size(); ++i)
            controllerChoice.addItem(editor::toText(controllers[i].name), none + 1 + static_cast<int>(i));
    }
    int chosen = none;
    for (std::size_t i = 0; i < controllers.size(); ++i)
        if (controllerOutput.chosen() && controllerOutput.chosen()->path == controllers[i].path)
            chosen = none + 1 + static_cast<int>(i);
    controllerChoice.setSelectedId(chosen, juce::dontSendNotification);
    controllerChoice.setEnabled(!controllers.empty());
    if (!connected)
        say(editor::toText(connected.error().text()));
    else if (controllers.empty())
        say(noController);
    else if (controllerNote.getText() == editor::tr(noController))
        say({});
}

void DevicesSheet::chooseController()
{
    const int index = controllerChoice.getSelectedId() - none - 1;
    const auto opened =
        controllerOutput.choose(index < 0 ? std::nullopt : std::optional(controllers[static_cast<std::size_t>(index)]));
    if (!opened)
        say(editor::toText(opened.error().text()));
    else
        say(controllerOutput.playsOnlyEvents() ? "Plays events only" : "");
    fillControllers();
}

void DevicesSheet::say(const juce::String& text)
{
    const auto shown = editor::translateMessage(text);
    controllerNote.setText(shown, juce::dontSendNotification);
    controllerNote.setTooltip(shown);
}

void DevicesSheet::layOut(juce::Rectangle<int> area)
{
    constexpr int labelWidth = 15 * grid; // as in the settings of the device
    const auto line = [&](juce::Label& label)
    {
        auto row = area.removeFromTop(4 * grid);
        label.setBounds(row.removeFromLeft(labelWidth));
        area.removeFromTop(grid / 2);
        return row;
    };
    const auto box = [](juce::Rectangle<int>& row)
    {
        auto place = row.removeFromLeft(std::min(editor::space::widestBox, row.getWidth() / 2)).reduced(0, 2);
        row.removeFromLeft(grid);
        return place;
    };
    auto row = line(soundLabel);
    soundChannel.setBounds(box(row));
    soundLevel.setBounds(row.removeFromLeft(row.getWidth() / 2));
    soundDelay.setBounds(row.withTrimmedLeft(grid));
    row = line(hapticLabel);
    hapticButton.setBounds(box(row));
    row = line(controllerLabel);
    controllerChoice.setBounds(box(row));
    controllerNote.setBounds(row);
    area.removeFromTop(grid);
    settings.setBounds(area);
}

} // namespace pacini::app
