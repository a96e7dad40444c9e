// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/panels/ProjectPanel.h"

#include "document/ProjectEdits.h"
#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"

#include <array>

namespace pacini::editor
{

namespace
{
constexpr int projectRowHeight = 3 * grid;
constexpr int projectPreferredHeight = 81 * grid;
constexpr int projectPause = 600; // ms without a change

/// Words between commas, each once.
std::vector<std::string> tagsIn(const juce::String& text)
{
    auto words = juce::StringArray::fromTokens(text, ",", {});
    words.trim();
    words.removeEmptyStrings();
    words.removeDuplicates(true);
    std::vector<std::string> found;
    for (const juce::String& word : words)
        found.push_back(word.toStdString());
    return found;
}

juce::String sizeText(std::uint64_t bytes)
{
    return withDecimalMark(juce::File::descriptionOfSizeInBytes(static_cast<juce::int64>(bytes)));
}
} // namespace

ProjectPanel::ProjectPanel(EditorView& shown)
    : model(shown.session().model),
      sounds(shown.session().sounds),
      list(shown.session().model),
      duplicateButton("Duplicate"),
      removeButton("Remove"),
      groupButton(toText("Group…")),
      keepCopy("Embed sound")
{
    setTitle("Project");
    addAndMakeVisible(list);
    const auto button = [this](juce::TextButton& one, const juce::String& help, std::function<void()> click)
    {
        one.setTooltip(help);
        one.onClick = std::move(click);
        addAndMakeVisible(one);
    };
    button(duplicateButton, "Duplicates the chosen clip (Ctrl+D)", [this] { list.duplicate(list.chosenRow()); });
    button(removeButton, "Removes the chosen clip, or ungroups the chosen group (Delete)",
           [this] { list.remove(list.chosenRow()); });
    button(groupButton, "Moves the chosen clip to a group, or to a new one",
           [this] {
               list.groupMenuOf(list.chosenRow())
                   .showMenuAsync(juce::PopupMenu::Options().withTargetComponent(groupButton));
           });
    keepCopy.setTitle("Embed the sound in the project");
    prepareButton(keepCopy, "Stores the sound in the project file, so that the project can be moved without it",
                  [this]
                  {
                      const auto item = model.item();
                      const bool wanted = keepCopy.getToggleState();
                      show();
                      if (item)
                          sounds.keepSound(item->source, wanted);
                  });
    addAndMakeVisible(keepCopy);
    const auto label = [this](juce::Label& one, const juce::String& text)
    {
        one.setText(text, juce::dontSendNotification);
        one.setFont(smallFont());
        one.setBorderSize({});
        addAndMakeVisible(one);
    };
    label(copyNote, {});
    copyNote.setJustificationType(juce::Justification::topLeft);
    label(clipNotesLabel, "Clip");
    label(tagsLabel, "Tags");
    label(projectNotesLabel, "Project");
    clipNotesLabel.setAccessible(false);
    tagsLabel.setAccessible(false);
    projectNotesLabel.setAccessible(false);
    const auto notes = [this](juce::TextEditor& one, const juce::String& title, const juce::String& help)
    {
        one.setMultiLine(true);
        one.setReturnKeyStartsNewLine(true);
        one.setFont(usualFont());
        one.setTitle(title);
        one.setTooltip(help);
        one.onTextChange = [this]
        {
            typed = true;
            startTimer(projectPause);
        };
        one.onFocusLost = [this]
        {
            keepNotes();
        };
        addAndMakeVisible(one);
    };
    notes(clipNotes, "Clip notes", "Notes on the clip, saved with the project");
    notes(tags, "Clip tags", "Words to find the selected clips by, with commas between them");
    tags.setMultiLine(false);
    tags.setReturnKeyStartsNewLine(false);
    tags.onReturnKey = [this]
    {
        keepNotes();
    };
    notes(projectNotes, "Project notes", "Notes on the project, saved with it");
    setSize(200, projectPreferredHeight);
    subscriptions.on({&model.projectChanged, &sounds.changed}, [this] { show(); });
    lookAndFeelChanged();
    show();
}

void ProjectPanel::keepNotes()
{
    stopTimer();
    if (!std::exchange(typed, false))
        return;
    const std::string ofClip = clipNotes.getText().toStdString();
    const std::string ofProject = projectNotes.getText().toStdString();
    const int id = notesOf;
    if (const auto item = model.document().clip(id); item && item->notes != ofClip)
        model.commit("Clip notes", withNotes(model.document().project(), id, ofClip));
    const auto wanted = tagsIn(tags.getText());
    if (const auto item = model.document().clip(id); item && item->tags != wanted)
        model.commit("Clip tags", withTags(model.document().project(), tagsOf, wanted));
    if (model.document().project().notes != ofProject)
        model.commit("Project notes", withProjectNotes(model.document().project(), ofProject));
}

void ProjectPanel::show()
{
    // What was typed belongs to the clip before.
    if (notesOf != model.activeId() && typed)
        keepNotes();
    const auto item = model.item();
    notesOf = model.activeId();
    const auto put = [this](juce::TextEditor& field, const std::string& text)
    {
        if (!typed && field.getText() != toText(text))
            field.setText(toText(text), false);
    };
    put(clipNotes, item ? item->notes : std::string());
    put(projectNotes, model.document().project().notes);
    put(tags, item ? tagText(*item).toStdString() : std::string());
    if (!typed)
        tagsOf = model.selectedClips();
    clipNotes.setEnabled(item != nullptr);
    tags.setEnabled(item != nullptr);
    duplicateButton.setEnabled(item != nullptr);
    removeButton.setEnabled(!list.rows().empty());
    const AudioReference* sound = item ? model.document().project().findSource(item->source) : nullptr;
    keepCopy.setEnabled(sound != nullptr);
    keepCopy.setToggleState(sound != nullptr && sound->embedded != nullptr, juce::dontSendNotification);
    juce::String note = tr("This clip has no sound.");
    if (sound != nullptr)
        note = tr(sounds.isMissing(sound->id) && !sound->embedded ? "{0}, {1}, missing" : "{0}, {1}",
                  {pathText(sound->path.filename()), sizeText(sound->bytes)});
    copyNote.setText(note, juce::dontSendNotification);
    copyNote.setTooltip(sound != nullptr ? pathText(sound->path) : juce::String());
}

void ProjectPanel::lookAndFeelChanged()
{
    const Palette& p = paletteFor(*this);
    for (juce::Label* one : {&copyNote, &clipNotesLabel, &tagsLabel, &projectNotesLabel})
        one->setColour(juce::Label::textColourId, p.dim);
    for (juce::TextEditor* one : {&clipNotes, &tags, &projectNotes})
    {
        one->setColour(juce::TextEditor::backgroundColourId, p.well);
        one->setColour(juce::TextEditor::outlineColourId, p.line);
        one->setColour(juce::TextEditor::focusedOutlineColourId, p.accent);
        one->applyColourToAllText(p.text);
    }
}

void ProjectPanel::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.background);
    drawCard(g, clipsCard, "Clips", p);
    drawCard(g, soundCard, "Sound", p);
    drawCard(g, notesCard, "Notes", p);
}

void ProjectPanel::resized()
{
    auto area = getLocalBounds().reduced(grid);
    notesCard = area.removeFromBottom(31 * grid);
    area.removeFromBottom(grid);
    soundCard = area.removeFromBottom(11 * grid);
    area.removeFromBottom(grid);
    clipsCard = area;

    auto inside = insideOfCard(clipsCard);
    // In one row where their texts fit, else the last one below.
    const std::array<juce::TextButton*, 3> buttons{&duplicateButton, &removeButton, &groupButton};
    const auto textWidth = [](const juce::TextButton& button)
    {
        return usualFont().getStringWidth(button.getButtonText()) + grid;
    };
    int texts = 0;
    for (const auto* button : buttons)
        texts += textWidth(*button);
    const int gaps = 2 * (grid / 2);
    const bool oneRow = texts + gaps <= inside.getWidth();
    if (!oneRow)
    {
        groupButton.setBounds(inside.removeFromBottom(projectRowHeight + 4));
        inside.removeFromBottom(grid / 2);
    }
    auto line = inside.removeFromBottom(projectRowHeight + 4);
    const int inRow = oneRow ? 3 : 2;
    const int rest = line.getWidth() - (inRow - 1) * (grid / 2) -
                     (oneRow ? texts : textWidth(duplicateButton) + textWidth(removeButton));
    for (int i = 0; i < inRow; ++i)
    {
        auto& button = *buttons[static_cast<std::size_t>(i)];
        button.setBounds(i + 1 == inRow ? line : line.removeFromLeft(textWidth(button) + rest / inRow));
        line.removeFromLeft(grid / 2);
    }
    list.setBounds(inside.withTrimmedBottom(grid));

    inside = insideOfCard(soundCard);
    keepCopy.setBounds(inside.removeFromTop(projectRowHeight));
    copyNote.setBounds(inside.withTrimmedTop(2));

    inside = insideOfCard(notesCard);
    const int tagsHeight = 3 * grid + 4;
    const int half = (inside.getHeight() - tagsHeight - grid) / 2;
    auto upper = inside.removeFromTop(half);
    clipNotesLabel.setBounds(upper.removeFromTop(2 * grid));
    clipNotes.setBounds(upper.withTrimmedBottom(grid / 2));
    auto ofTags = inside.removeFromTop(tagsHeight);
    tagsLabel.setBounds(ofTags.removeFromLeft(5 * grid));
    tags.setBounds(ofTags);
    inside.removeFromTop(grid);
    projectNotesLabel.setBounds(inside.removeFromTop(2 * grid));
    projectNotes.setBounds(inside);
}

} // namespace pacini::editor
