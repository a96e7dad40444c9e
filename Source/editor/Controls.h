// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Set-up of buttons and child components, as all windows do it.

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>
#include <initializer_list>
#include <utility>

namespace pacini::editor
{

inline void prepareButton(juce::Button& button, const juce::String& tooltip, std::function<void()> click)
{
    button.setTooltip(tooltip);
    button.onClick = std::move(click);
}

/// Adds children in this order, visible.
inline void addAll(juce::Component& parent, std::initializer_list<juce::Component*> children)
{
    for (juce::Component* child : children)
        parent.addAndMakeVisible(child);
}

} // namespace pacini::editor
