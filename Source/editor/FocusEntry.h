// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tab from a window that has the keyboard itself: JUCE looks for the next stop beside such a container, not inside.

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

/// Tab gives the keyboard to the first stop inside of `container`, Shift+Tab to the last. False: this is another key, a
/// part has the keyboard already, or there is no stop.
inline bool enterByTab(juce::Component& container, const juce::KeyPress& key)
{
    if (key.getKeyCode() != juce::KeyPress::tabKey || !container.hasKeyboardFocus(false))
        return false;
    const auto stops = container.createKeyboardFocusTraverser()->getAllComponents(&container);
    if (stops.empty())
        return false;
    (key.getModifiers().isShiftDown() ? stops.back() : stops.front())->grabKeyboardFocus();
    return true;
}

} // namespace pacini::editor
