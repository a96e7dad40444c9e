// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Context menu of a component: its commands, by right click or the menu key.

#include "editor/clip/commands/Command.h"

#include <vector>

namespace pacini::editor
{

/// A component that has one. The view that it lies in shows it, and that of the innermost one counts.
class ContextMenu
{
public:
    virtual ~ContextMenu() = default;

    /// In their order, `menuLine` between groups.
    [[nodiscard]] virtual std::vector<Command> contextCommands() const = 0;

    static constexpr Command menuLine = static_cast<Command>(0);

protected:
    ContextMenu() = default;
    ContextMenu(const ContextMenu&) = default;
    ContextMenu& operator=(const ContextMenu&) = default;
};

} // namespace pacini::editor
