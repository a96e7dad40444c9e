// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Overview of the whole clip, which scrolls and zooms the clip view.

#include "document/view/LevelCurve.h"
#include "editor/clip/commands/ContextMenu.h"
#include "editor/clip/session/ViewState.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <memory>
#include <vector>

namespace pacini::editor
{

/// The envelope of the whole clip with a frame around what is visible, which can be dragged and resized.
class Overview final : public juce::Component, public juce::SettableTooltipClient, public ContextMenu
{
public:
    Overview(const EditorModel& project, ViewState& sight);

    void paint(juce::Graphics& g) override;
    [[nodiscard]] std::vector<Command> contextCommands() const override;
    void mouseDown(const juce::MouseEvent& event) override;
    void mouseDrag(const juce::MouseEvent& event) override;
    void mouseDoubleClick(const juce::MouseEvent& event) override;

private:
    [[nodiscard]] TimeAxis whole() const;
    [[nodiscard]] juce::Rectangle<float> frame() const;

    const EditorModel& model;
    ViewState& viewState;
    enum class Drag
    {
        frame,
        left,
        right
    };
    Drag drag = Drag::frame;
    std::shared_ptr<const Clip> drawn;
    LevelCurves levels;
    TimeRange before; // the visible range when a drag began
    Subscriptions subscriptions;
};

} // namespace pacini::editor
