// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Strip of markers in the clip view.

#include "editor/clip/commands/Command.h"
#include "editor/clip/session/Transport.h"
#include "editor/clip/session/ViewState.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <cstddef>
#include <functional>
#include <optional>

namespace pacini::editor
{

/// The markers of the clip with their names, below the ruler. A click moves the playhead, a drag the marker.
class MarkerStrip final : public juce::Component, public juce::SettableTooltipClient
{
public:
    static constexpr int height = 20; ///< pixels

    MarkerStrip(EditorModel& project, const ViewState& sight, Transport& playing);

    /// For the marker at the playhead.
    std::function<void(Command)> onCommand;

    void paint(juce::Graphics& g) override;
    void mouseMove(const juce::MouseEvent& event) override;
    void mouseDown(const juce::MouseEvent& event) override;
    void mouseDrag(const juce::MouseEvent& event) override;
    void mouseUp(const juce::MouseEvent& event) override;
    void mouseDoubleClick(const juce::MouseEvent& event) override;

private:
    [[nodiscard]] std::optional<std::size_t> markerAt(juce::Point<float> place) const;
    void ask(Command command);

    EditorModel& model;
    const ViewState& viewState;
    Transport& transport;
    std::optional<std::size_t> dragged; ///< of the clip that the gesture began with
    Gesture gesture = 0;
    double grabbed = 0.0; ///< s, of the marker when it was
    Subscriptions subscriptions;
};

} // namespace pacini::editor
