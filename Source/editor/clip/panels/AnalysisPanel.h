// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Analysis panel: encoder parameters of the clip, and the hand edits that found no place over the analysis.

#include "editor/Controls.h"
#include "editor/clip/panels/UnfittingList.h"
#include "editor/clip/session/ProjectSounds.h"
#include "editor/clip/sheets/OwnPresets.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pacini::editor
{

class EditorView;

/// A change is carried out when the controls have been still for a moment.
class AnalysisPanel final : public juce::Component, private juce::Timer
{
public:
    explicit AnalysisPanel(EditorView& shown);

    /// What the controls say.
    [[nodiscard]] EncoderParams params() const;
    /// Does at once what waits for the end of the pause.
    void carryOut();

    /// The controls take what a settings file says; `name` is that of a preset of the user.
    void load(const std::filesystem::path& settings, const juce::String& name = {}) { ownPresets.open(settings, name); }
    /// Writes what the controls say as a preset of the user, after a question where there is one of this name.
    void saveAs(const juce::String& name) { ownPresets.saveAs(name); }

    void paint(juce::Graphics& g) override;
    void resized() override;
    void lookAndFeelChanged() override;

private:
    /// A slider for one number.
    struct Knob
    {
        juce::Label name;
        Slider slider;
    };
    enum Which : std::size_t
    {
        bands,
        low,
        high,
        detail,
        sensitivity,
        audible,
        speech,
        bits,
        knobCount
    };

    void timerCallback() override { carryOut(); }
    void connectPresets();
    void prepareSoundButtons();
    void prepareKnobs();
    void prepare(Which which, const juce::String& name, const juce::String& unit, const juce::String& help);
    void set(const EncoderParams& wanted);
    void fillPresets();
    void choosePreset();
    Result<void> take(const std::filesystem::path& settings, const juce::String& name);
    void showPreset(const EncoderParams& wanted);
    void show();
    void edited();
    [[nodiscard]] juce::Slider& knob(Which which) { return knobs[which].slider; }
    [[nodiscard]] const juce::Slider& knob(Which which) const { return knobs[which].slider; }

    EditorView& view;
    const EditorModel& model;
    ProjectSounds& sounds;
    juce::Rectangle<int> soundCard, settingsCard, editsCard;
    juce::Label state; ///< of the sound, or why nothing can be set
    juce::TextButton replaceButton, findButton, resetButton;
    juce::Label presetLabel, spacingLabel;
    MenuBox preset;
    juce::ComboBox spacing;
    OwnPresets ownPresets;
    struct OwnPreset
    {
        juce::String name;
        EncoderParams params;
    };
    std::optional<OwnPreset> lastOwn; ///< that was saved or chosen
    std::array<Knob, knobCount> knobs;
    juce::ToggleButton normalise;
    UnfittingList edits;
    std::optional<EncoderParams> waiting; ///< for the end of the pause, or of the analysis under way
    int shownClip = 0;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
