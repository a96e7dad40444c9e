// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Page of the actuators: panning over the haptic channels, and the actuator of each.

#include "editor/Meters.h"
#include "editor/ParameterControls.h"
#include "plugin/engine/PluginProcessor.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace pacini::plugin
{

class ActuatorsPage final : public juce::Component, public editor::Refreshed
{
public:
    explicit ActuatorsPage(PluginProcessor& shown);

    std::function<void(std::size_t channel)> onLoad; ///< an actuator from a file is wanted

    void refresh() override;
    void resized() override;
    void paint(juce::Graphics& g) override;

private:
    using Columns = std::array<juce::Rectangle<int>, 7>;
    static constexpr int numberColumn = 0, actuatorColumn = 1, loadColumn = 2, placeColumn = 3, gainColumn = 4,
                         delayColumn = 5, meterColumn = 6;

    struct Row
    {
        std::unique_ptr<editor::ParameterChoice> actuator;
        juce::TextButton load;
        std::unique_ptr<editor::ParameterSlider> place, gain, delay;
        std::unique_ptr<editor::LevelMeter> meter;
    };

    std::unique_ptr<editor::ParameterSlider> slider(ParameterId parameter, const juce::String& label);
    std::unique_ptr<editor::ParameterChoice> choice(ParameterId parameter);
    void adopt(juce::Component& component, editor::Refreshed* wanted);
    [[nodiscard]] juce::Rectangle<int> panCard() const;
    [[nodiscard]] juce::Rectangle<int> channelCard() const;
    static Columns columnsOf(juce::Rectangle<int> line);
    [[nodiscard]] juce::Rectangle<int> lineOf(std::size_t row) const; ///< 0 is the heads

    PluginProcessor& processor;
    std::vector<editor::Refreshed*> refreshed;
    int focusOrder = 0;
    std::unique_ptr<editor::ParameterChoice> pan, law, places;
    std::unique_ptr<editor::ParameterSlider> position, outputCount;
    std::array<Row, maxHapticChannels> rows;
    juce::Label hint;
};

/// The values that a menu of actuators offers: all but free slots.
[[nodiscard]] std::vector<int> offeredValues(const ParameterRow& row);

} // namespace pacini::plugin
