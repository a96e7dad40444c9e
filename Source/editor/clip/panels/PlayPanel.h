// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Play panel: what is changed live while a clip plays.

#include "document/SettingsPresets.h"
#include "editor/Controls.h"
#include "editor/clip/session/Transport.h"
#include "editor/clip/sheets/OwnPresets.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <optional>
#include <utility>

namespace pacini::editor
{

/// Gain, intensity, pitch, speed and, over several outputs, position: heard at once, kept out of the clip.
class PlayPanel final : public juce::Component
{
public:
    explicit PlayPanel(EditorView& view);

    /// See OwnPresets.
    void saveAs(const juce::String& name) { own.saveAs(name); }

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
    void fillPresets();
    void showPreset();
    [[nodiscard]] CharacterSettings character() const;
    void setCharacter(const CharacterSettings& wanted);

    Transport& transport;
    HapticOutputs& outputs;
    juce::Rectangle<int> liveCard, rowCard;
    Row gain, intensity, pitch, speed, position;
    OwnPresets own;
    std::optional<std::pair<juce::String, CharacterSettings>> lastOwn; ///< the preset that was chosen or saved last
    juce::Label presetLabel, panLabel, note;
    juce::ComboBox preset;
    juce::ComboBox pan;
    juce::TextButton resetButton;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
