// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Play panel: what is changed live while a clip plays.

#include "editor/Controls.h"
#include "editor/clip/session/Transport.h"

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

/// Gain, intensity, pitch, speed and, over several outputs, position: heard at once, kept out of the clip.
class PlayPanel final : public juce::Component
{
public:
    PlayPanel(Transport& playing, HapticOutputs& hapticOutputs);

    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    struct Row
    {
        juce::Label label;
        Slider slider;
    };

    void prepare(Row& row, const juce::String& name, const juce::String& help, juce::Range<double> range, double step,
                 double rest, const juce::String& unit);
    void set();
    void show();

    Transport& transport;
    HapticOutputs& outputs;
    juce::Rectangle<int> liveCard, rowCard;
    Row gain, intensity, pitch, speed, position;
    juce::Label panLabel, note;
    juce::ComboBox pan;
    juce::TextButton resetButton;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
