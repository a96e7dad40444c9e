// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog with all steps of the project, done and undone, to go to any of them.

#include "editor/List.h"
#include "editor/clip/session/EditorModel.h"
#include "editor/clip/sheets/Sheet.h"

namespace pacini::editor
{

class HistorySheet final : public Sheet, private juce::ListBoxModel
{
public:
    explicit HistorySheet(EditorModel& project);
    ~HistorySheet() override;

    [[nodiscard]] std::vector<Command> commands() const override { return {undo, redo, editor::save, saveAs}; }

private:
    int getNumRows() override;
    juce::String getNameForRow(int row) override;
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool selected) override;
    void selectedRowsChanged(int row) override;
    void layOut(juce::Rectangle<int> area) override { list.setBounds(area); }
    juce::Component* firstFocus() override { return &list; }
    void showCurrent();

    EditorModel& model;
    List list{{}, this};
    Subscriptions subscriptions;
};

} // namespace pacini::editor
