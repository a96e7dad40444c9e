// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Meter panel: levels and gain reduction at the actuator during playback.

#include "editor/Meters.h"
#include "editor/clip/session/Transport.h"

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

/// Output level, gain reduction and level above the threshold of touch, which is known of a chosen actuator only.
class MeterPanel final : public juce::Component, private juce::Timer
{
public:
    static constexpr int height = 3 * 30 + 12;

    MeterPanel(const Actuators& profiles, const Transport& playing, ClipPlayer& played);

    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void follow();
    void timerCallback() override;

    const Actuators& actuators;
    const Transport& transport;
    ClipPlayer& player;
    LevelMeter output, reduction, felt;
    int quiet = 0; ///< calls of the timer since something played
    Subscriptions subscriptions;
};

} // namespace pacini::editor
