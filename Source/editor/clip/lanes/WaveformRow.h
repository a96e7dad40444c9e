// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Row of the source sound in the clip view.

#include "editor/clip/commands/ContextMenu.h"
#include "editor/clip/lanes/SpectrogramPicture.h"
#include "editor/clip/session/ProjectSounds.h"
#include "editor/clip/session/ViewState.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <memory>
#include <vector>

namespace pacini::editor
{

/// The sound that the clip was made from, as its waveform, its spectrogram or both over each other.
class WaveformRow final : public juce::Component, public juce::SettableTooltipClient, public ContextMenu
{
public:
    WaveformRow(const EditorModel& project, const ProjectSounds& projectSounds, ViewState& sight);

    /// Whether all of the spectrogram that is visible has been computed.
    [[nodiscard]] bool isComplete() const { return spectrum.isComplete(); }

    void paint(juce::Graphics& g) override;
    void resized() override;
    [[nodiscard]] std::vector<Command> contextCommands() const override;
    void mouseMove(const juce::MouseEvent& event) override;

private:
    void showOptions();
    [[nodiscard]] juce::Rectangle<int> plotArea() const;
    void paintHead(juce::Graphics& g, const Sound* sound);
    void paintSpectrum(juce::Graphics& g, juce::Rectangle<int> plot);
    void paintWaveform(juce::Graphics& g, juce::Rectangle<int> plot, const Sound& sound, bool overSpectrum);

    const EditorModel& model;
    const ProjectSounds& sounds;
    ViewState& viewState;
    SpectrogramPicture spectrum;
    std::shared_ptr<const Sound> drawn;
    juce::TextButton viewButton, rangeButton;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
