// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/commands/Menus.h"

#include "editor/Text.h"
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/ContextMenu.h"
#include "editor/clip/commands/KeyText.h"

#include <utility>

namespace pacini::editor
{

Action& Menu::add(Command id, const char* text, const char* help, std::function<void()> run, std::function<bool()> can,
                  std::vector<juce::KeyPress> keys)
{
    return actions.emplace_back(Action{.id = id,
                                       .name = text,
                                       .help = help,
                                       .run = std::move(run),
                                       .can = std::move(can),
                                       .keys = std::move(keys),
                                       .lineBefore = std::exchange(line, false)});
}

void Menu::addSwitch(Command id, const char* text, const char* help, std::function<void()> run,
                     std::function<bool()> on, std::vector<juce::KeyPress> keys, std::function<bool()> can)
{
    add(id, text, help, std::move(run), std::move(can), std::move(keys)).on = std::move(on);
}

void Menu::addMenu(Command id, const char* text, const char* help, std::function<juce::PopupMenu()> choices,
                   std::function<bool()> can, std::function<void()> run)
{
    add(id, text, help, std::move(run), std::move(can)).choices = std::move(choices);
}

std::function<bool()> hasClip(const Session& session)
{
    return [&session]
    {
        return session.model.clip() != nullptr;
    };
}

Menus::Menus(EditorView& view) : owner(view)
{
    for (const auto make :
         {fileMenu, editMenu, shapeMenu, clipMenu, markerMenu, playMenu, viewMenu, toolsMenu, helpMenu})
        menus.push_back(make(view));
    manager.registerAllCommandsForTarget(this);
    manager.setFirstCommandTarget(this);
    setApplicationCommandManagerToWatch(&manager);
}

Menus::~Menus()
{
    setApplicationCommandManagerToWatch(nullptr);
}

juce::String Menus::nameOf(const Action& action)
{
    return (action.fullName ? action.fullName() : tr(action.name)).replace("...", toText("…"));
}

bool Menus::canDo(const Action& action)
{
    return !action.can || action.can();
}

const Action* Menus::find(int id) const
{
    for (const Menu& menu : menus)
        for (const Action& action : menu.actions)
            if (action.id == id)
                return &action;
    return nullptr;
}

bool Menus::perform(Command command)
{
    const Action* action = find(command);
    if (action == nullptr || !action->run || !canDo(*action))
        return false;
    action->run();
    refresh();
    return true;
}

std::optional<Command> Menus::commandOf(const juce::KeyPress& key) const
{
    const auto found = manager.getKeyMappings()->findCommandForKeyPress(key);
    return found != 0 ? std::optional(static_cast<Command>(found)) : std::nullopt;
}

std::vector<juce::KeyPress> Menus::keysOf(Command command) const
{
    const auto keys = manager.getKeyMappings()->getKeyPressesAssignedToCommand(command);
    return {keys.begin(), keys.end()};
}

juce::String Menus::keyTextOf(Command command) const
{
    const auto keys = keysOf(command);
    return keys.empty() ? juce::String() : keyText(keys.front());
}

void Menus::setKey(Command command, const juce::KeyPress& key)
{
    auto& mappings = *manager.getKeyMappings();
    mappings.clearAllKeyPresses(command);
    if (!key.isValid())
        return;
    mappings.removeKeyPress(key);
    mappings.addKeyPress(command, key);
}

bool Menus::isFree(const juce::KeyPress& key)
{
    using Key = juce::KeyPress;
    for (const int code : {Key::tabKey, Key::returnKey, Key::escapeKey, Key::leftKey, Key::rightKey, Key::upKey,
                           Key::downKey, Key::deleteKey, Key::backspaceKey})
        if (key.getKeyCode() == code)
            return false;
    return key.isValid();
}

void Menus::resetKeys()
{
    manager.getKeyMappings()->resetToDefaultMappings();
}

std::unique_ptr<juce::XmlElement> Menus::changedKeys() const
{
    auto changed = manager.getKeyMappings()->createXml(true);
    return changed && changed->getNumChildElements() > 0 ? std::move(changed) : nullptr;
}

void Menus::restoreKeys(const juce::XmlElement& changed)
{
    manager.getKeyMappings()->restoreFromXml(changed);
}

bool Menus::perform(const InvocationInfo& info)
{
    return perform(static_cast<Command>(info.commandID));
}

juce::StringArray Menus::getMenuBarNames()
{
    juce::StringArray names;
    for (const Menu& menu : menus)
        names.add(tr(menu.name));
    return names;
}

juce::PopupMenu Menus::getMenuForIndex(int index, const juce::String&)
{
    juce::PopupMenu popup;
    popup.setLookAndFeel(&owner.getLookAndFeel());
    for (const Action& action : menus[static_cast<std::size_t>(index)].actions)
    {
        if (action.lineBefore)
            popup.addSeparator();
        addItem(popup, action);
    }
    return popup;
}

void Menus::addItem(juce::PopupMenu& popup, const Action& action)
{
    if (action.choices)
        return popup.addSubMenu(nameOf(action), canDo(action) ? action.choices() : juce::PopupMenu(), canDo(action));
    juce::PopupMenu::Item item(nameOf(action));
    item.itemID = action.id;
    item.isEnabled = canDo(action);
    item.isTicked = action.on && action.on();
    item.shortcutKeyDescription = keyTextOf(action.id);
    item.action = [this, id = action.id]
    {
        perform(id);
    };
    popup.addItem(std::move(item));
}

juce::PopupMenu Menus::menuOf(const std::vector<Command>& commands)
{
    juce::PopupMenu popup;
    popup.setLookAndFeel(&owner.getLookAndFeel());
    for (const Command command : commands)
        if (command == ContextMenu::menuLine)
            popup.addSeparator();
        else if (const Action* action = find(command))
            addItem(popup, *action);
    return popup;
}

void Menus::getAllCommands(juce::Array<juce::CommandID>& ids)
{
    for (const Menu& menu : menus)
        for (const Action& action : menu.actions)
            ids.add(action.id);
}

void Menus::getCommandInfo(juce::CommandID id, juce::ApplicationCommandInfo& info)
{
    const Action* action = find(id);
    if (action == nullptr)
        return;
    info.setInfo(nameOf(*action), tr(action->help), {}, 0);
    info.setActive(canDo(*action));
    info.setTicked(action->on && action->on());
    for (const juce::KeyPress& key : action->keys)
        info.defaultKeypresses.add(key);
}

} // namespace pacini::editor
