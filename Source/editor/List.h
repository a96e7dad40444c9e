// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A list with a ring while it has the keyboard.

#include "editor/Theme.h"

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

class List final : public juce::ListBox
{
public:
    using juce::ListBox::ListBox;

    void paintOverChildren(juce::Graphics& g) override
    {
        juce::ListBox::paintOverChildren(g);
        drawFocusRing(g, *this, getLocalBounds().toFloat());
    }
    void focusGained(FocusChangeType) override { repaint(); }
    void focusLost(FocusChangeType) override { repaint(); }
};

} // namespace pacini::editor
