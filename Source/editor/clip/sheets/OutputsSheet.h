// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog for the haptic outputs: how many there are, and channel, actuator, gain, delay and place of each.

#include "editor/Controls.h"
#include "editor/clip/session/HapticOutputs.h"
#include "editor/clip/sheets/OwnPresets.h"
#include "editor/clip/sheets/Sheet.h"

#include <array>
#include <functional>
#include <memory>

namespace pacini::editor
{

/// Every change is felt at once.
class OutputsSheet final : public Sheet
{
public:
    /// `channels`: the names of the device's outputs.
    OutputsSheet(HapticOutputs& hapticOutputs, const Actuators& profiles, const juce::StringArray& channels);
    /// The same with presets of all rows in a folder, see OwnPresets.
    OutputsSheet(EditorView& view, const juce::StringArray& channels, const std::filesystem::path& presetFolder);

    [[nodiscard]] OwnPresets* presets() noexcept { return own.get(); }

private:
    struct Row
    {
        juce::Label number;
        juce::ComboBox channel, actuator;
        Slider gain, delay, place;
    };

    void layOut(juce::Rectangle<int> area) override;
    juce::Component* firstFocus() override { return &rows[0].channel; }
    void prepare(std::size_t index);
    void set(std::size_t index, const std::function<void(HapticOutput&)>& change);
    void show();
    void fillPresets();

    HapticOutputs& outputs;
    const Actuators& actuators;
    juce::StringArray channelNames;
    std::array<juce::Label, 5> heads;
    std::array<Row, HapticOutputs::most> rows;
    juce::TextButton addButton, removeButton;
    MenuBox presetBox;
    std::unique_ptr<OwnPresets> own; ///< null: there are none
    juce::Label note;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
