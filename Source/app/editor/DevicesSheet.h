// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog for the sound device, the channels of the sound, and the game controller.

#include "app/editor/ControllerOutput.h"
#include "app/editor/PreviewDevices.h"
#include "editor/Controls.h"
#include "editor/DeviceSettings.h"
#include "editor/clip/sheets/Sheet.h"

#include <juce_audio_utils/juce_audio_utils.h>

namespace pacini::app
{

class DevicesSheet final : public editor::Sheet, private juce::ChangeListener, private juce::Timer
{
public:
    DevicesSheet(PreviewDevices& wanted, ControllerOutput& controllers);
    ~DevicesSheet() override;

    std::function<void()> onHapticOutputs; ///< their sheet is wanted

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
    void prepareSound();

    juce::Label soundLabel, hapticLabel;
    juce::ComboBox soundChannel;
    editor::Slider soundLevel, soundDelay;
    juce::TextButton hapticButton;
    juce::Label controllerLabel, controllerNote;
    juce::ComboBox controllerChoice;
    std::vector<devices::Controller> controllers; ///< of the choice, from its second item on
    editor::DeviceSettings settings;
};

} // namespace pacini::app
