// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/sheets/AboutSheet.h"
#include "editor/clip/sheets/CommandSheet.h"
#include "editor/clip/sheets/HelpSheet.h"
#include "editor/clip/sheets/ShortcutsSheet.h"

namespace pacini::editor
{

Menu helpMenu(EditorView& view)
{
    Menu menu("Help");
    menu.add(searchCommands, "Find a command...", "Finds any command by its words, and its shortcut",
             [&view] { view.showSheet(std::make_unique<CommandSheet>(view.menus())); }, {}, {ctrlShift('p')});
    menu.addLine();
    menu.add(manual, "Manual", "Explains the editor step by step",
             [&view] { view.showSheet(std::make_unique<HelpSheet>()); }, {},
             {juce::KeyPress(juce::KeyPress::F1Key, juce::ModifierKeys::shiftModifier, 0)});
    menu.add(shortcuts, "Keyboard and mouse", "Lists shortcuts, which can be changed, and mouse actions",
             [&view] { view.showSheet(std::make_unique<ShortcutsSheet>(view.menus())); }, {},
             {juce::KeyPress(juce::KeyPress::F1Key)});
    menu.addLine();
    menu.add(about, "About Pacini", "Version, licence and sources of Pacini",
             [&view] { view.showSheet(aboutSheet(view.hostServices().version)); });
    return menu;
}

} // namespace pacini::editor
