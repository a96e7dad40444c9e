// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Time ruler of the clip view.

#include "editor/clip/commands/ContextMenu.h"
#include "editor/clip/session/Transport.h"
#include "editor/clip/session/ViewState.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <optional>
#include <vector>

namespace pacini::editor
{

/// Ruler with times. A click puts the playhead there, a drag selects a range or moves an end of it.
class TimeRuler final : public juce::Component, public juce::SettableTooltipClient, public ContextMenu
{
public:
    TimeRuler(const EditorModel& project, ClipSelection& selected, const ViewState& sight, Transport& playing);

    void paint(juce::Graphics& g) override;
    [[nodiscard]] std::vector<Command> contextCommands() const override;
    void mouseMove(const juce::MouseEvent& event) override;
    void mouseDown(const juce::MouseEvent& event) override;
    void mouseDrag(const juce::MouseEvent& event) override;
    void mouseDoubleClick(const juce::MouseEvent& event) override;

private:
    [[nodiscard]] double timeAt(float x) const;

    const EditorModel& model;
    ClipSelection& clipSelection;
    const ViewState& viewState;
    Transport& transport;
    [[nodiscard]] std::optional<double> otherEdge(float x) const;

    double anchor = 0.0; // s, where a drag began, or the end of the range that stays
    bool anchorIsEdge = false;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
