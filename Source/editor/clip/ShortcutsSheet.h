// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What keys and mouse do.

#include "editor/clip/Sheet.h"

namespace pacini::editor
{

class ShortcutsSheet final : public Sheet
{
public:
    ShortcutsSheet();

private:
    class Table;
    void layOut(juce::Rectangle<int> area) override;

    juce::Viewport viewport;
};

} // namespace pacini::editor
