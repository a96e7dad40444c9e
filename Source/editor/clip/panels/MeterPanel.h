// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Meter panel: levels and gain reduction at the actuator during playback.

#include "editor/Meters.h"
#include "editor/clip/session/Transport.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <memory>
#include <vector>

namespace pacini::editor
{

/// Level of each output, gain reduction and level above the threshold of touch, which is known of a chosen actuator
/// only.
class MeterPanel final : public juce::Component, private juce::Timer
{
public:
    MeterPanel(const Actuators& profiles, const HapticOutputs& hapticOutputs, const Transport& playing,
               ClipPlayer& played);

    [[nodiscard]] int wantedHeight() const noexcept;

    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void follow();
    void makeLevels();
    void timerCallback() override;

    const Actuators& actuators;
    const HapticOutputs& outputs;
    const Transport& transport;
    ClipPlayer& player;
    std::vector<std::unique_ptr<LevelMeter>> levels; ///< of each output
    LevelMeter reduction, felt;
    int quiet = 0; ///< calls of the timer since something played
    Subscriptions subscriptions;
};

} // namespace pacini::editor
