// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog that makes a study from a template.

#include "editor/clip/sheets/Sheet.h"
#include "editor/study/StudyMaking.h"

#include <array>
#include <filesystem>

namespace pacini::editor
{

class EditorView;

/// Question, sounds, groups and place of a study; what is made can be run at once.
class NewStudySheet final : public Sheet
{
public:
    static constexpr std::size_t mostGroups = 4;

    explicit NewStudySheet(EditorView& shown);

    /// What the controls say. A group without a name is none.
    [[nodiscard]] StudyWish wish() const;

private:
    /// A path with a button that looks for it.
    struct PathRow
    {
        juce::Label name;
        juce::TextEditor path;
        juce::TextButton browse;
    };
    struct GroupRow
    {
        juce::TextEditor name, people;
    };

    void layOut(juce::Rectangle<int> area) override;
    juce::Component* firstFocus() override { return &question; }
    void prepare(PathRow& row, const juce::String& name, const juce::String& help, const juce::String& title);
    void showTemplate();
    void make();

    EditorView& view;
    juce::Label questionLabel, groupsLabel, peopleLabel;
    juce::ComboBox question;
    juce::Label purpose, problem;
    PathRow sounds, folder;
    std::array<GroupRow, mostGroups> groups;
};

} // namespace pacini::editor
