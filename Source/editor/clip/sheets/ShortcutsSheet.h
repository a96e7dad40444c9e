// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog with mouse gestures and keyboard shortcuts, which can be changed.

#include "editor/clip/commands/Menus.h"
#include "editor/clip/sheets/Sheet.h"

namespace pacini::editor
{

/// A click or Return on a command waits for its new key; Delete then takes its key away, Escape leaves it.
class ShortcutsSheet final : public Sheet
{
public:
    explicit ShortcutsSheet(Menus& menus);

private:
    class Table;
    void layOut(juce::Rectangle<int> area) override;
    juce::Component* firstFocus() override;

    juce::Viewport viewport;
    juce::Label note; ///< what a change has done
};

} // namespace pacini::editor
