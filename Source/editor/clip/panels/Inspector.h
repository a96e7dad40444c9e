// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Inspector panel: the selection in numbers, and edits of stretches: level, fades, simplifying.

#include "editor/ClipChip.h"
#include "editor/Controls.h"
#include "editor/clip/session/ClipSelection.h"

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

class EditorView;

class Inspector final : public juce::Component
{
public:
    explicit Inspector(EditorView& shown);

    void paint(juce::Graphics& g) override;
    void resized() override;
    void lookAndFeelChanged() override;

private:
    void prepareFields();
    void prepareSliders();
    void showSelection();
    void showFacts();
    void gainMoved();
    void simplifyMoved();
    [[nodiscard]] std::vector<Lane> scopeLanes() const;

    EditorView& view;
    EditorModel& model;
    ClipSelection& clipSelection;
    juce::Rectangle<int> selectionCard, levelCard, simplifyCard, factsCard;
    juce::Label scopeText, timeLabel, timeField, valueLabel, valueField, sharpLabel, sharpField;
    juce::Label gainLabel, keepLabel, cost, facts;
    Slider gain, keep;
    juce::TextButton fadeInButton, fadeOutButton, reverseButton;
    ClipChip chip;
    Gesture gesture = 0;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
