// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog that finds a command by words of its name, menu or help, and does it.

#include "editor/Controls.h"
#include "editor/List.h"
#include "editor/clip/commands/Menus.h"
#include "editor/clip/sheets/Sheet.h"

#include <vector>

namespace pacini::editor
{

/// Type to search, choose with the arrow keys, press Return to run. Unavailable commands are dim and come last.
class CommandSheet final : public Sheet, private juce::ListBoxModel, private juce::KeyListener
{
public:
    explicit CommandSheet(Menus& menus);
    ~CommandSheet() override;

    [[nodiscard]] std::vector<Command> found() const;

private:
    struct Entry
    {
        const Action* action;
        juce::String name, menu, keys;
        bool possible;
    };

    void search();
    void performSelected();
    int getNumRows() override { return static_cast<int>(shown.size()); }
    juce::String getNameForRow(int row) override;
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool selected) override;
    void listBoxItemClicked(int row, const juce::MouseEvent&) override;
    void returnKeyPressed(int) override { performSelected(); }
    using Sheet::keyPressed;
    bool keyPressed(const juce::KeyPress& key, juce::Component*) override; ///< of the field of words
    void layOut(juce::Rectangle<int> area) override;
    juce::Component* firstFocus() override { return &words; }

    Menus& menus;
    std::vector<Entry> all;
    std::vector<const Entry*> shown;
    PromptField words;
    List list{{}, this};
};

} // namespace pacini::editor
