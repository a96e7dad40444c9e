// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog for the sound device, the channels of sound and drive signal, and the game controller.

#include "app/editor/ControllerOutput.h"
#include "app/editor/PreviewDevices.h"
#include "editor/clip/sheets/Sheet.h"

#include <juce_audio_utils/juce_audio_utils.h>

namespace pacini::app
{

class DevicesSheet final : public editor::Sheet, private juce::ChangeListener, private juce::Timer
{
public:
    DevicesSheet(PreviewDevices& wanted, ControllerOutput& controllers);
    ~DevicesSheet() override;

private:
    void layOut(juce::Rectangle<int> area) override;
    void changeListenerCallback(juce::ChangeBroadcaster*) override { fill(); }
    void timerCallback() override { fillControllers(); }
    void fill();
    void fillControllers();
    void chooseController();
    void say(const juce::String& text);

    PreviewDevices& rig;
    ControllerOutput& controllerOutput;
    /// One output: where it goes, how loud and how late.
    struct Output
    {
        juce::Label label;
        juce::ComboBox channel;
        juce::Slider level, delay;
    };
    void prepare(Output& output, const juce::String& name, const juce::String& help, editor::OutputTrim& trim,
                 double maxLevel);

    Output sound, haptic;
    juce::Label controllerLabel, controllerNote;
    juce::ComboBox controllerChoice;
    std::vector<devices::Controller> controllers; ///< of the choice, from its second item on
    juce::AudioDeviceSelectorComponent selector;
};

} // namespace pacini::app
