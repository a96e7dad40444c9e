// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// List of the project's clips under their groups: chosen, renamed, ordered, grouped by mouse and keys.

#include "document/view/ClipRows.h"
#include "editor/Controls.h"
#include "editor/List.h"
#include "editor/clip/session/EditorModel.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <memory>
#include <optional>
#include <vector>

namespace pacini::editor
{

/// The tags of a clip, with commas between them.
[[nodiscard]] inline juce::String tagText(const ClipItem& item)
{
    juce::StringArray words;
    for (const std::string& tag : item.tags)
        words.add(juce::String::fromUTF8(tag.data(), static_cast<int>(tag.size())));
    return words.joinIntoString(", ");
}

/// The chosen clip is the one that is shown; several can be selected, to remove, group or export them at once. Return
/// or F2 renames, Delete removes, Alt with the arrows moves, a drag moves too; the menu of a row has it all. With many
/// clips there is a field to search them by words of their names, groups and notes.
class ClipList final : public juce::Component,
                       public juce::DragAndDropContainer,
                       public juce::DragAndDropTarget,
                       private juce::ListBoxModel,
                       private juce::KeyListener
{
public:
    explicit ClipList(EditorModel& project);
    ~ClipList() override;

    [[nodiscard]] const std::vector<ClipRow>& rows() const noexcept { return rowsNow; }
    [[nodiscard]] int chosenRow() const { return list.getSelectedRow(); }
    void choose(int row) { list.selectRow(row); }
    /// Empty: all are shown.
    void search(const juce::String& words);

    /// Of a clip or a group. Empty names change nothing.
    void rename(int row, const juce::String& name);
    /// Removes a clip, or a group whose clips stay.
    void remove(int row);
    void duplicate(int row);
    /// Puts a clip above row `gap`, see placeAbove().
    void move(int row, std::size_t gap);
    /// Empty: out of its group.
    void setGroup(int row, const std::string& group);
    /// A new group, with the clip of a row in it if that is one. Its name can be typed at once.
    void addGroup(int row);
    void beginRename(int row);
    /// What can be done with a row.
    [[nodiscard]] juce::PopupMenu menuOf(int row);
    [[nodiscard]] juce::PopupMenu groupMenuOf(int row);

    void mouseDrag(const juce::MouseEvent& event) override;
    void paintOverChildren(juce::Graphics& g) override;
    void resized() override;

private:
    void refresh();
    void showMenu(int row, juce::Rectangle<int> beside);
    [[nodiscard]] std::vector<int> clipsFor(int row) const;
    [[nodiscard]] juce::String nameOf(const ClipRow& row) const;
    [[nodiscard]] const ClipRow* at(int row) const;

    int getNumRows() override { return static_cast<int>(rowsNow.size()); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool selected) override;
    juce::String getNameForRow(int row) override;
    juce::String getTooltipForRow(int row) override;
    void selectedRowsChanged(int row) override;
    void listBoxItemClicked(int row, const juce::MouseEvent& event) override;
    void listBoxItemDoubleClicked(int row, const juce::MouseEvent&) override { beginRename(row); }
    void returnKeyPressed(int row) override { beginRename(row); }
    void deleteKeyPressed(int row) override { remove(row); }
    using juce::Component::keyPressed;
    bool keyPressed(const juce::KeyPress& key, juce::Component*) override;

    bool isInterestedInDragSource(const SourceDetails& details) override;
    void itemDragMove(const SourceDetails& details) override;
    void itemDragExit(const SourceDetails&) override;
    void itemDropped(const SourceDetails& details) override;
    [[nodiscard]] int gapAt(const SourceDetails& details) const;

    EditorModel& model;
    std::vector<ClipRow> rowsNow; ///< as the search has left them
    juce::StringArray wordsNow;
    PromptField searchField;
    List list{{}, this};
    std::unique_ptr<juce::TextEditor> nameField; ///< over a row while it is renamed
    std::optional<int> gap;                      ///< of a drag
    Subscriptions subscriptions;
};

} // namespace pacini::editor
