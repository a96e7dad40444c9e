// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is being read and analysed, how far it is, and a button that stops it.

#include "editor/clip/session/ProjectSounds.h"

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

/// Shows itself when work has gone on for a moment, and hides itself when it is done.
class WorkBar final : public juce::Component, private juce::Timer
{
public:
    WorkBar(const EditorModel& project, ProjectSounds& projectSounds);

    void paint(juce::Graphics& g) override;
    void resized() override;
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override;

private:
    void follow();
    void timerCallback() override;
    [[nodiscard]] juce::Rectangle<int> bar() const;

    const EditorModel& model;
    ProjectSounds& sounds;
    juce::TextButton stopButton;
    WorkState shown;
    int ticks = 0; ///< since the work began
    Subscriptions subscriptions;
};

} // namespace pacini::editor
