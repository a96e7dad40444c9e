// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Menu action: a command with its place, name, help, keys and function.

#include "editor/clip/commands/Command.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>
#include <vector>

namespace pacini::editor
{

class EditorView;

struct Action
{
    Command id;
    const char* name; ///< three dots at its end: it asks something first
    const char* help;
    std::function<void()> run = {};
    std::function<bool()> can = {};                ///< empty: always
    std::function<bool()> on = {};                 ///< of a switch
    std::vector<juce::KeyPress> keys = {};         ///< the first is the one that is shown
    std::function<juce::String()> fullName = {};   ///< when it changes
    std::function<juce::PopupMenu()> choices = {}; ///< of a menu in the menu
    bool lineBefore = false;
};

struct Menu
{
    const char* name;
    std::vector<Action> actions;
};

/// In their order in the menu bar. What they work on outlives them.
[[nodiscard]] Menu fileMenu(EditorView& view);
[[nodiscard]] Menu editMenu(EditorView& view);
[[nodiscard]] Menu shapeMenu(EditorView& view);
[[nodiscard]] Menu clipMenu(EditorView& view);
[[nodiscard]] Menu markerMenu(EditorView& view);
[[nodiscard]] Menu playMenu(EditorView& view);
[[nodiscard]] Menu viewMenu(EditorView& view);
[[nodiscard]] Menu toolsMenu(EditorView& view);
[[nodiscard]] Menu helpMenu(EditorView& view);

/// A key with Ctrl (Cmd on a Mac), Shift.
[[nodiscard]] inline juce::KeyPress alt(int key)
{
    return {key, juce::ModifierKeys::altModifier, 0};
}

[[nodiscard]] inline juce::KeyPress ctrl(int key)
{
    return {key, juce::ModifierKeys::commandModifier, 0};
}

[[nodiscard]] inline juce::KeyPress ctrlShift(int key)
{
    return {key, juce::ModifierKeys::commandModifier | juce::ModifierKeys::shiftModifier, 0};
}

} // namespace pacini::editor
