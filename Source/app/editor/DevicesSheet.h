// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The sound device, and which of its channels carry what.

#include "app/editor/PreviewRig.h"
#include "editor/clip/sheets/Sheet.h"

#include <juce_audio_utils/juce_audio_utils.h>

namespace pacini::app
{

class DevicesSheet final : public editor::Sheet, private juce::ChangeListener
{
public:
    explicit DevicesSheet(PreviewRig& wanted);
    ~DevicesSheet() override;

private:
    void layOut(juce::Rectangle<int> area) override;
    void changeListenerCallback(juce::ChangeBroadcaster*) override { fill(); }
    void fill();

    PreviewRig& rig;
    juce::Label soundLabel, hapticLabel;
    juce::ComboBox sound, haptic;
    juce::AudioDeviceSelectorComponent selector;
};

} // namespace pacini::app
