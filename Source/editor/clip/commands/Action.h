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
struct Session;

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

/// A menu and its actions.
class Menu
{
public:
    explicit Menu(const char* title) : name(title) {}

    /// What is added next stands below a line.
    void addLine() { line = true; }
    Action& add(Command id, const char* text, const char* help, std::function<void()> run,
                std::function<bool()> can = {}, std::vector<juce::KeyPress> keys = {});
    void addSwitch(Command id, const char* text, const char* help, std::function<void()> run, std::function<bool()> on,
                   std::vector<juce::KeyPress> keys = {}, std::function<bool()> can = {});
    void addMenu(Command id, const char* text, const char* help, std::function<juce::PopupMenu()> choices,
                 std::function<bool()> can, std::function<void()> run = {});

    const char* name;
    std::vector<Action> actions;

private:
    bool line = false;
};

/// Whether a clip is shown, for `can`.
[[nodiscard]] std::function<bool()> hasClip(const Session& session);

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
