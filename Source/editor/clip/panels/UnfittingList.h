// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// List of the hand edits that do not fit the current analysis, each with its reason.

#include "editor/List.h"
#include "editor/clip/session/Transport.h"
#include "editor/clip/session/ViewState.h"

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

class UnfittingList final : public juce::Component, private juce::ListBoxModel
{
public:
    UnfittingList(EditorModel& project, ViewState& sight, Transport& playing);
    ~UnfittingList() override;

    /// The clip has changed.
    void refresh();
    [[nodiscard]] juce::String heading() const;

    /// Shows the time of an edit of the list; edits of the whole clip show all of it.
    void showEdit(int row);
    void removeEdit(int row);

    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    class Row;

    int getNumRows() override;
    void paintListBoxItem(int, juce::Graphics&, int, int, bool) override {}
    juce::Component* refreshComponentForRow(int row, bool selected, juce::Component* existing) override;
    juce::String getNameForRow(int row) override;
    void returnKeyPressed(int row) override { showEdit(row); }
    void deleteKeyPressed(int row) override { removeEdit(row); }
    [[nodiscard]] std::shared_ptr<const Edit> editOf(int row) const;
    [[nodiscard]] juce::String reasonOf(int row) const;

    EditorModel& model;
    ViewState& viewState;
    Transport& transport;
    List list{{}, this};
};

} // namespace pacini::editor
