// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Menu bar and keyboard shortcuts.

#include "editor/clip/commands/Action.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <memory>
#include <optional>
#include <vector>

namespace pacini::editor
{

/// All actions of a view as menus and keys. [message]
class Menus final : public juce::MenuBarModel, private juce::ApplicationCommandTarget
{
public:
    explicit Menus(EditorView& view);
    ~Menus() override;

    [[nodiscard]] const std::vector<Menu>& all() const noexcept { return menus; }
    [[nodiscard]] juce::KeyListener* keys() { return manager.getKeyMappings(); }

    /// As it is shown: in the user's language, and what it is now.
    [[nodiscard]] static juce::String nameOf(const Action& action);
    [[nodiscard]] static bool canDo(const Action& action);

    /// A menu of commands, 0 for a line between them; see ContextMenu.
    [[nodiscard]] juce::PopupMenu menuOf(const std::vector<Command>& commands);

    /// False when it cannot be done now.
    bool perform(Command command);
    /// The keys of a command, as the user has them; the first is the one that is shown.
    [[nodiscard]] std::vector<juce::KeyPress> keysOf(Command command) const;
    /// As it is shown; empty: it has none.
    [[nodiscard]] juce::String keyTextOf(Command command) const;
    /// The only key of a command from now on, which no other command has then; one that is not valid: none.
    void setKey(Command command, const juce::KeyPress& key);
    /// Whether a command may have this key: those that lanes and dialogs need are not free.
    [[nodiscard]] static bool isFree(const juce::KeyPress& key);
    void resetKeys();
    /// What differs from the keys that the program comes with; null: nothing.
    [[nodiscard]] std::unique_ptr<juce::XmlElement> changedKeys() const;
    void restoreKeys(const juce::XmlElement& changed);
    /// What a key does; null: nothing.
    [[nodiscard]] std::optional<Command> commandOf(const juce::KeyPress& key) const;
    /// Updates which commands are enabled.
    void refresh() { manager.commandStatusChanged(); }

private:
    juce::StringArray getMenuBarNames() override;
    juce::PopupMenu getMenuForIndex(int index, const juce::String& name) override;
    void menuItemSelected(int, int) override {}

    ApplicationCommandTarget* getNextCommandTarget() override { return nullptr; }
    void getAllCommands(juce::Array<juce::CommandID>& ids) override;
    void getCommandInfo(juce::CommandID id, juce::ApplicationCommandInfo& info) override;
    bool perform(const InvocationInfo& info) override;

    void addItem(juce::PopupMenu& popup, const Action& action);
    [[nodiscard]] const Action* find(int id) const;

    juce::Component& owner;
    std::vector<Menu> menus;
    juce::ApplicationCommandManager manager;
};

} // namespace pacini::editor
