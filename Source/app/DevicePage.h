// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Page of the standalone program for the choice of the sound device, with advice if there is none.

#include "editor/DeviceSettings.h"

#include <juce_audio_utils/juce_audio_utils.h>

namespace pacini::app
{

class DevicePage final : public juce::Component, private juce::ChangeListener
{
public:
    explicit DevicePage(juce::AudioDeviceManager& wanted);
    ~DevicePage() override;

    void resized() override;

private:
    void changeListenerCallback(juce::ChangeBroadcaster*) override { showState(); }
    void lookAndFeelChanged() override;
    void showState();
    void searchAgain();

    juce::AudioDeviceManager& manager;
    juce::TextEditor advice;
    juce::TextButton searchButton{"Search again"};
    editor::DeviceSettings settings;
};

} // namespace pacini::app
