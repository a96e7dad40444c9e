// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/DevicesSheet.h"

#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>

namespace pacini::app
{

namespace
{
using editor::grid;
constexpr int controllerPoll = 1000; // ms
constexpr auto noController = "No supported controller connected";
constexpr int none = 1; // menus know no item 0; channels follow
} // namespace

DevicesSheet::DevicesSheet(PreviewDevices& wanted, ControllerOutput& wantedControllers)
    : Sheet("Audio devices", 760, 560),
      rig(wanted),
      controllerOutput(wantedControllers),
      selector(wanted.devices(), 0, 256, 0, 256, false, false, false, false)
{
    prepare(sound, "Sound output", "Output channels for the sound", rig.soundTrim(), 6.0);
    prepare(haptic, "Haptic output", "Output channel connected to the actuator's amplifier", rig.hapticTrim(), 0.0);
    controllerLabel.setText("Controller", juce::dontSendNotification);
    controllerLabel.setFont(editor::usualFont());
    controllerLabel.setAccessible(false);
    controllerNote.setFont(editor::smallFont());
    controllerChoice.setTitle("Game controller");
    controllerChoice.setTooltip("Controller or haptic device that plays along");
    controllerChoice.onChange = [this]
    {
        chooseController();
    };
    for (juce::Component* part :
         std::initializer_list<juce::Component*>{&controllerLabel, &controllerChoice, &controllerNote})
        addAndMakeVisible(part);
    addAndMakeVisible(selector);
    rig.devices().addChangeListener(this);
    setAnswers({{"Close", {}}});
    fill();
}

void DevicesSheet::prepare(Output& output, const juce::String& name, const juce::String& help, editor::OutputTrim& trim,
                           double maxLevel)
{
    output.label.setText(name, juce::dontSendNotification);
    output.label.setFont(editor::usualFont());
    output.label.setAccessible(false);
    output.channel.setTitle(name);
    output.channel.setTooltip(help);
    output.channel.onChange = [this]
    {
        rig.setOutputs({sound.channel.getSelectedId() - none - 1, haptic.channel.getSelectedId() - none - 1});
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
    slider(output.level, editor::tr("{0}: level", {editor::tr(name)}), "Level in dB", " dB", {-60.0, maxLevel}, 0.5);
    slider(output.delay, editor::tr("{0}: delay", {editor::tr(name)}), "Delay in ms, to align sound and haptics", " ms",
           {0.0, 1000.0 * editor::OutputTrim::longestDelay}, 1.0);
    output.level.setValue(juce::Decibels::gainToDecibels(trim.levelNow(), -60.0), juce::dontSendNotification);
    output.delay.setValue(1000.0 * trim.delayNow(), juce::dontSendNotification);
    output.level.onValueChange = [&output, &trim]
    {
        trim.setLevel(juce::Decibels::decibelsToGain(output.level.getValue(), -60.0));
    };
    output.delay.onValueChange = [&output, &trim]
    {
        trim.setDelay(0.001 * output.delay.getValue());
    };
    for (juce::Component* part :
         std::initializer_list<juce::Component*>{&output.label, &output.channel, &output.level, &output.delay})
        addAndMakeVisible(part);
}

DevicesSheet::~DevicesSheet()
{
    rig.devices().removeChangeListener(this);
}

void DevicesSheet::fill()
{
    const auto names = rig.outputNames();
    const PreviewOutputs now = rig.outputs();
    sound.channel.clear(juce::dontSendNotification);
    haptic.channel.clear(juce::dontSendNotification);
    sound.channel.addItem(editor::tr("None"), none);
    haptic.channel.addItem(editor::tr("None"), none);
    for (int c = 0; c < names.size(); ++c)
    {
        if (c % 2 == 0)
            sound.channel.addItem(editor::tr("Outputs {0}+{1}", {juce::String(c + 1), juce::String(c + 2)}),
                                  none + 1 + c);
        haptic.channel.addItem(juce::String(c + 1) + "  " + names[c], none + 1 + c);
    }
    sound.channel.setSelectedId(none + 1 + now.sound, juce::dontSendNotification);
    haptic.channel.setSelectedId(none + 1 + std::min(now.haptic, std::max(-1, names.size() - 1)),
                                 juce::dontSendNotification);
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
    for (Output* output : {&sound, &haptic})
    {
        auto row = area.removeFromTop(4 * grid);
        output->label.setBounds(row.removeFromLeft(11 * grid));
        const int third = row.getWidth() / 3;
        output->channel.setBounds(row.removeFromLeft(third).reduced(0, 2));
        output->level.setBounds(row.removeFromLeft(third).withTrimmedLeft(grid));
        output->delay.setBounds(row.withTrimmedLeft(grid));
        area.removeFromTop(grid);
    }
    auto row = area.removeFromTop(4 * grid);
    controllerLabel.setBounds(row.removeFromLeft(11 * grid));
    controllerChoice.setBounds(row.removeFromLeft(row.getWidth() / 3).reduced(0, 2));
    controllerNote.setBounds(row.withTrimmedLeft(grid));
    area.removeFromTop(grid);
    selector.setBounds(area);
}

} // namespace pacini::app
