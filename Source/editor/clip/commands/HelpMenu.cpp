// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/sheets/ShortcutsSheet.h"

namespace pacini::editor
{

Menu helpMenu(EditorView& view)
{
    return {"Help",
            {
                {.id = shortcuts,
                 .name = "Keys and mouse",
                 .help = "Shows what keys and mouse do",
                 .run = [&view] { view.showSheet(std::make_unique<ShortcutsSheet>(view.menus().all())); },
                 .keys = {juce::KeyPress(juce::KeyPress::F1Key)}},
            }};
}

} // namespace pacini::editor
