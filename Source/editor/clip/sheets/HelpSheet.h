// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Help dialog: the manual of the editor, compiled in.

#include "editor/List.h"
#include "editor/clip/sheets/Sheet.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <vector>

namespace pacini::editor
{

class HelpSheet final : public Sheet, private juce::ListBoxModel
{
public:
    /// Opens with its first topic, or with the last one, on the plugin.
    explicit HelpSheet(bool onPlugin = false);
    ~HelpSheet() override;

private:
    struct Topic
    {
        juce::String title;
        juce::StringArray paragraphs;
    };

    void layOut(juce::Rectangle<int> area) override;
    juce::Component* firstFocus() override { return &topics; }
    void lookAndFeelChanged() override;
    void parentHierarchyChanged() override { lookAndFeelChanged(); }

    int getNumRows() override { return static_cast<int>(chapters.size()); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool selected) override;
    juce::String getNameForRow(int row) override;
    void selectedRowsChanged(int row) override;

    static std::vector<Topic> readTopics();
    void show(const Topic& topic);

    const std::vector<Topic> chapters = readTopics();
    List topics;
    juce::TextEditor text;
};

} // namespace pacini::editor
