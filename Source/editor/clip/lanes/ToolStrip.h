// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tool buttons of the clip view.

#include "editor/clip/session/ViewState.h"

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

/// Switches for the mouse in lanes, beside the ruler: drawing, snapping, and the version to show and play.
class ToolStrip final : public juce::Component
{
public:
    ToolStrip(EditorModel& project, ViewState& sight);

    void resized() override;

private:
    void showState();

    EditorModel& model;
    ViewState& viewState;
    juce::ToggleButton drawButton, snapButton, versionButton;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
