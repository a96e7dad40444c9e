// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog with the list of keyboard shortcuts and mouse gestures.

#include "editor/clip/commands/Action.h"
#include "editor/clip/sheets/Sheet.h"

namespace pacini::editor
{

class ShortcutsSheet final : public Sheet
{
public:
    explicit ShortcutsSheet(const std::vector<Menu>& menus);

private:
    class Table;
    void layOut(juce::Rectangle<int> area) override;

    juce::Viewport viewport;
};

} // namespace pacini::editor
