// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Progress bar of reading and analysing, with a button that stops the work.

#include "editor/clip/session/ProjectSounds.h"
#include "editor/clip/session/ViewState.h"

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

/// Appears when work takes longer than a moment, and hides when it is done.
class WorkBar final : public juce::Component, private juce::Timer
{
public:
    WorkBar(const EditorModel& project, ProjectSounds& projectSounds, const ViewState& sight);

    void paint(juce::Graphics& g) override;
    void resized() override;
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override;

private:
    void follow();
    void timerCallback() override;
    [[nodiscard]] juce::Rectangle<int> bar() const;

    const EditorModel& model;
    ProjectSounds& sounds;
    const ViewState& viewState;
    juce::TextButton stopButton;
    WorkState shown;
    int ticks = 0; ///< since the work began
    Subscriptions subscriptions;
};

} // namespace pacini::editor
