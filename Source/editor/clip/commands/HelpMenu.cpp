// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/sheets/HelpSheet.h"
#include "editor/clip/sheets/ShortcutsSheet.h"

namespace pacini::editor
{

Menu helpMenu(EditorView& view)
{
    return {"Help",
            {
                {.id = manual,
                 .name = "Manual",
                 .help = "Explains the editor, step by step",
                 .run = [&view] { view.showSheet(std::make_unique<HelpSheet>()); },
                 .keys = {juce::KeyPress(juce::KeyPress::F1Key, juce::ModifierKeys::shiftModifier, 0)}},
                {.id = shortcuts,
                 .name = "Keys and mouse",
                 .help = "Shows what keys and mouse do",
                 .run = [&view] { view.showSheet(std::make_unique<ShortcutsSheet>(view.menus().all())); },
                 .keys = {juce::KeyPress(juce::KeyPress::F1Key)}},
            }};
}

} // namespace pacini::editor
