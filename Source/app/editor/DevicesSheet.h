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
    /// One output: where it goes, how loud and how late.
    struct Output
    {
        juce::Label label;
        juce::ComboBox channel;
        juce::Slider level, delay;
    };
    void prepare(Output& output, const juce::String& name, const juce::String& help, editor::OutputTrim& trim,
                 double mostLevel);

    Output sound, haptic;
    juce::AudioDeviceSelectorComponent selector;
};

} // namespace pacini::app
