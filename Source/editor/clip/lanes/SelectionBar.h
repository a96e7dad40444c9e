// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Time bar of the selection, by which it is stretched.

#include "editor/clip/session/Transport.h"
#include "editor/clip/session/ViewState.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <optional>

namespace pacini::editor
{

/// The time range of the selection as a bar in the ruler. Dragging an end stretches the selection in all lanes about
/// the other end. Ignores the mouse elsewhere.
class SelectionBar final : public juce::Component, public juce::SettableTooltipClient
{
public:
    static constexpr int height = 10; ///< pixels

    SelectionBar(EditorModel& project, ClipSelection& selected, const ViewState& sight, const Transport& playing);

    void paint(juce::Graphics& g) override;
    bool hitTest(int x, int y) override;
    void mouseDown(const juce::MouseEvent& event) override;
    void mouseDrag(const juce::MouseEvent& event) override;

private:
    void follow();
    [[nodiscard]] float xOf(double time) const;

    EditorModel& model;
    ClipSelection& clipSelection;
    const ViewState& viewState;
    const Transport& transport;
    std::optional<TimeRange> range; ///< of the selection, where it has a length
    Selection grabbed;
    TimeRange before; ///< when a drag began
    bool dragsEnd = false;
    Gesture gesture = 0;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
