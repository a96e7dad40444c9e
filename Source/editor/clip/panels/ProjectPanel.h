// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Project panel: list of clips, notes, and whether sounds are embedded.

#include "editor/clip/panels/ClipList.h"
#include "editor/clip/session/ProjectSounds.h"

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

class EditorView;

/// Typed notes become a step after a pause, or when the keyboard focus moves away.
class ProjectPanel final : public juce::Component, private juce::Timer
{
public:
    explicit ProjectPanel(EditorView& shown);

    [[nodiscard]] ClipList& clips() noexcept { return list; }
    /// Takes over at once what has been typed.
    void keepNotes();

    void paint(juce::Graphics& g) override;
    void resized() override;
    void lookAndFeelChanged() override;

private:
    void timerCallback() override { keepNotes(); }
    void show();

    EditorModel& model;
    ProjectSounds& sounds;
    juce::Rectangle<int> clipsCard, soundCard, notesCard;
    ClipList list;
    juce::TextButton duplicateButton, removeButton, groupButton;
    juce::ToggleButton keepCopy;
    juce::Label copyNote, clipNotesLabel, tagsLabel, projectNotesLabel;
    juce::TextEditor clipNotes, tags, projectNotes;
    int notesOf = 0;         ///< the clip whose notes are shown
    std::vector<int> tagsOf; ///< the clips whose tags are shown
    bool typed = false;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
