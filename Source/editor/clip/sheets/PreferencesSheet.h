// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Preferences dialog: looks and behaviour in one place; most of it is in the View menu as well.

#include "editor/clip/sheets/Sheet.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>
#include <memory>
#include <vector>

namespace pacini::editor
{

class EditorView;

/// Every change is seen at once.
class PreferencesSheet final : public Sheet
{
public:
    explicit PreferencesSheet(EditorView& shown);

private:
    struct Row
    {
        juce::Label name;
        std::unique_ptr<juce::Component> control;
    };

    void layOut(juce::Rectangle<int> area) override;
    juce::Component* firstFocus() override { return rows.front()->control.get(); }
    void addLanguages();
    void add(const juce::String& name, std::unique_ptr<juce::Component> control);
    void addChoice(const juce::String& name, const juce::String& help, const juce::StringArray& offered, int chosen,
                   std::function<void(int)> choose);
    void addButton(const juce::String& name, const juce::String& text, const juce::String& help, Command command);
    void addSwitch(const juce::String& name, const juce::String& help, bool on, std::function<void(bool)> turn);

    EditorView& view;
    std::vector<std::unique_ptr<Row>> rows;
    juce::Label lack; ///< what the language needs before it is shown
};

} // namespace pacini::editor
