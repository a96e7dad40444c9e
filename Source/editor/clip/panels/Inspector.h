// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is selected, in numbers, and edits of stretches: level, fades, simplifying.

#include "editor/ClipChip.h"
#include "editor/clip/session/Session.h"

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

class EditorView;

class Inspector final : public juce::Component, private Session::Listener
{
public:
    explicit Inspector(EditorView& shown);
    ~Inspector() override;

    void paint(juce::Graphics& g) override;
    void resized() override;
    void lookAndFeelChanged() override;

private:
    void sessionChanged(unsigned changes) override;
    void showSelection();
    void showFacts();
    void gainMoved();
    void simplifyMoved();
    [[nodiscard]] std::vector<Lane> scopeLanes() const;

    EditorView& view;
    Session& session;
    juce::Rectangle<int> selectionCard, levelCard, simplifyCard, factsCard;
    juce::Label scopeText, timeLabel, timeField, valueLabel, valueField, sharpLabel, sharpField;
    juce::Label gainLabel, keepLabel, cost, facts;
    juce::Slider gain, keep;
    juce::TextButton fadeInButton, fadeOutButton, reverseButton;
    ClipChip chip;
    Gesture gesture = 0;
};

} // namespace pacini::editor
