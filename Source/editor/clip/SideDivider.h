// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Divider between the lanes and the side panel.

#include "editor/Theme.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>

namespace pacini::editor
{

/// A strip that is dragged sideways; a double-click asks for the usual width.
class SideDivider final : public juce::Component, public juce::SettableTooltipClient
{
public:
    static constexpr int width = 6;

    SideDivider()
    {
        setTitle("Width of the side panel");
        setTooltip("Drag: width of the side panel; double-click: usual width");
        setMouseCursor(juce::MouseCursor::LeftRightResizeCursor);
        setRepaintsOnMouseActivity(true);
    }

    std::function<int()> widthNow;
    std::function<void(int)> onWidth; ///< points; less than 1: the usual width

    void paint(juce::Graphics& g) override
    {
        const bool active = isMouseOverOrDragging();
        const Palette& p = paletteFor(*this);
        g.setColour(active ? p.accent : p.line);
        g.fillRect(getLocalBounds().withSizeKeepingCentre(active ? 3 : 1, getHeight()));
    }

private:
    void mouseDown(const juce::MouseEvent&) override { before = widthNow(); }
    void mouseDrag(const juce::MouseEvent& event) override
    {
        const auto here = event.getEventRelativeTo(getParentComponent());
        onWidth(std::max(1, before - (here.x - here.getMouseDownX())));
    }
    void mouseDoubleClick(const juce::MouseEvent&) override { onWidth(0); }

    int before = 0;
};

} // namespace pacini::editor
