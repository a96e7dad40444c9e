// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/study/NewStudySheet.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"
#include "study/Plan.h"
#include "study/StudyFile.h"
#include "study/StudyTemplates.h"

#include <memory>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr int studyRowHeight = 4 * grid;
constexpr int studyLabelWidth = 14 * grid;

void prepareField(juce::TextEditor& field, const juce::String& title, const juce::String& help)
{
    field.setTitle(title);
    field.setTooltip(help);
    field.setFont(usualFont());
    field.setIndents(grid, 6);
    field.setSelectAllWhenFocused(true);
}
} // namespace

NewStudySheet::NewStudySheet(EditorView& shown) : Sheet("New study", 720, 500), view(shown)
{
    for (const auto& [label, text] :
         {std::pair(&questionLabel, "Question"), std::pair(&groupsLabel, "Groups"), std::pair(&peopleLabel, "People")})
    {
        prepareLabel(*label, text, usualFont());
        addAndMakeVisible(*label);
    }
    for (const auto& one : study::studyTemplates())
        question.addItem(toText(one.title), question.getNumItems() + 1);
    question.setTitle("Question");
    question.setTooltip("Template of the study");
    question.setSelectedId(1, juce::dontSendNotification);
    question.onChange = [this]
    {
        showTemplate();
    };
    for (juce::Label* one : {&purpose, &problem})
    {
        one->setFont(smallFont());
        one->setBorderSize({});
        one->setJustificationType(juce::Justification::topLeft);
        one->setMinimumHorizontalScale(1.0f);
    }
    purpose.setTitle("Purpose");
    problem.setTitle("Problem");
    addAll(*this, {&question, &purpose});
    prepare(sounds, "Sounds", "Folder of the sounds that are presented", "Folder of the sounds");
    prepare(folder, "Folder", "Folder for the study and its answers; it may be new", "Folder of the study");
    folder.path.setText(documentsFolder().getChildFile("study").getFullPathName(), false);
    for (std::size_t i = 0; i < groups.size(); ++i)
    {
        const juce::String number(static_cast<int>(i) + 1);
        prepareField(groups[i].name, tr("Name of group {0}", {number}), tr("Empty: there is no such group"));
        prepareField(groups[i].people, tr("People in group {0}", {number}), {});
        groups[i].people.setInputRestrictions(4, "0123456789");
        addAll(*this, {&groups[i].name, &groups[i].people});
    }
    addAndMakeVisible(problem);
    setAnswers({{"Create", {}}, {"Cancel", {}}});
    setUsualAnswer([this] { make(); });
    showTemplate();
}

void NewStudySheet::prepare(PathRow& row, const juce::String& name, const juce::String& help, const juce::String& title)
{
    prepareLabel(row.name, name, usualFont());
    prepareField(row.path, name, help);
    row.browse.setButtonText(tr(toText("Browse…")));
    row.browse.setTitle(title);
    prepareButton(row.browse, help,
                  [this, &row, title]
                  {
                      const auto start = pathOf(row.path.getText());
                      view.files().askForFolder(tr(title), start,
                                                [self = SafePointer(this), &row](const std::filesystem::path& chosen)
                                                {
                                                    if (self)
                                                        row.path.setText(pathText(chosen));
                                                });
                  });
    addAll(*this, {&row.name, &row.path, &row.browse});
}

/// The groups of the template, as far as they have room; and what it asks.
void NewStudySheet::showTemplate()
{
    const auto& chosen = study::studyTemplates()[static_cast<std::size_t>(question.getSelectedId() - 1)];
    juce::String text = translateMessage(toText(chosen.purpose));
    text = text.substring(0, 1).toUpperCase() + text.substring(1);
    if (chosen.fewestSounds > 0)
        text << "\n" << counted(chosen.fewestSounds, "Needs {0} sound or more.", "Needs {0} sounds or more.");
    else if (chosen.mostSounds > 0)
        text << "\n"
             << tr("Takes {0} to {1} sounds, or none.", {juce::String(static_cast<int>(chosen.fewestOwn)),
                                                         juce::String(static_cast<int>(chosen.mostSounds))});
    else
        text << "\n" << tr("Presents no sounds.");
    purpose.setText(text, juce::dontSendNotification);
    std::vector<std::string> enough(chosen.fewestSounds, "sound.wav");
    for (std::size_t i = 0; i < enough.size(); ++i)
        enough[i] = std::to_string(i) + enough[i];
    const auto standard = study::makeStudy(chosen.name, enough);
    for (std::size_t i = 0; i < groups.size(); ++i)
    {
        const bool there = standard && i < standard->groups.size();
        groups[i].name.setText(there ? toText(standard->groups[i].name) : juce::String(), false);
        groups[i].people.setText(there ? juce::String(standard->groups[i].size) : juce::String(), false);
    }
    problem.setText({}, juce::dontSendNotification);
}

StudyWish NewStudySheet::wish() const
{
    StudyWish wanted;
    wanted.kind = study::studyTemplates()[static_cast<std::size_t>(question.getSelectedId() - 1)].name;
    wanted.folder = pathOf(folder.path.getText().trim());
    wanted.sounds = pathOf(sounds.path.getText().trim());
    for (const GroupRow& row : groups)
        if (const auto name = row.name.getText().trim(); name.isNotEmpty())
            wanted.groups.push_back({name.toStdString(), row.people.getText().getIntValue()});
    return wanted;
}

void NewStudySheet::make()
{
    const auto made = makeStudyFile(wish());
    if (!made)
    {
        problem.setText(translateMessage(toText(made.error().text())), juce::dontSendNotification);
        return;
    }
    const auto read = study::readStudy(*made);
    const auto people = read ? static_cast<std::size_t>(study::participantsOf(*read)) : 0;
    auto& shown = view;
    const auto& run = shown.hostServices().runStudy;
    std::vector<Answer> answers;
    if (run)
        answers.push_back({"Run", [run, file = *made]
                           {
                               run(file);
                           }});
    answers.push_back({"Show in folder", [file = *made]
                       {
                           juce::File(pathText(file)).revealToUser();
                       }});
    answers.push_back({"Close", {}});
    const auto text = pathText(*made) + "\n" + counted(people, "For {0} participant.", "For {0} participants.") +
                      "\n\n" + tr("Questions, scales and texts can be changed in this file before the first session.");
    shown.showMessage(std::make_unique<MessageSheet>("Study made", text, std::move(answers)));
    close();
}

void NewStudySheet::layOut(juce::Rectangle<int> area)
{
    const Palette& p = paletteFor(*this);
    purpose.setColour(juce::Label::textColourId, p.dim);
    problem.setColour(juce::Label::textColourId, p.danger);
    const auto line = [&area](juce::Label& label)
    {
        auto row = area.removeFromTop(studyRowHeight);
        area.removeFromTop(grid);
        label.setBounds(row.removeFromLeft(studyLabelWidth));
        return row;
    };
    question.setBounds(line(questionLabel).withWidth(34 * grid));
    purpose.setBounds(area.removeFromTop(5 * grid).withTrimmedLeft(studyLabelWidth));
    area.removeFromTop(grid);
    for (PathRow* row : {&sounds, &folder})
    {
        auto rest = line(row->name);
        row->browse.setBounds(rest.removeFromRight(13 * grid));
        row->path.setBounds(rest.withTrimmedRight(grid));
        row->path.applyColourToAllText(p.text);
    }
    auto head = area.removeFromTop(3 * grid);
    groupsLabel.setBounds(head.removeFromLeft(studyLabelWidth));
    auto columns = head;
    columns.removeFromLeft(26 * grid + grid);
    peopleLabel.setBounds(columns.withWidth(12 * grid));
    for (GroupRow& row : groups)
    {
        auto rest = area.removeFromTop(studyRowHeight).withTrimmedLeft(studyLabelWidth);
        area.removeFromTop(grid / 2);
        row.name.setBounds(rest.removeFromLeft(26 * grid));
        rest.removeFromLeft(grid);
        row.people.setBounds(rest.removeFromLeft(12 * grid));
        for (juce::TextEditor* field : {&row.name, &row.people})
            field->applyColourToAllText(p.text);
    }
    area.removeFromTop(grid / 2);
    problem.setBounds(area.withTrimmedLeft(studyLabelWidth));
}

} // namespace pacini::editor
