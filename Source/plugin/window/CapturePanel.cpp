// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/window/CapturePanel.h"

#include "editor/Controls.h"
#include "editor/FileQuestion.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/sheets/OverwriteQuestion.h"
#include "io/ClipFile.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace pacini::plugin
{

namespace
{
using editor::grid;
using editor::paletteFor;
using editor::toText;

constexpr std::array<int, 4> lengths{3, 5, 10, 30}; // s

/// A clip is felt as its sound was: what the encoder and the translator have in common is the same.
EncoderParams encoderOf(const TranslatorParams& live)
{
    EncoderParams params;
    params.audible = live.audible;
    params.speech = live.speech;
    return params;
}
} // namespace

CapturePanel::CapturePanel(PluginProcessor& heard)
    : source(heard), button("Capture"), editButton("Edit"), saveButton(toText("Save…")), keepButton("Keep sound")
{
    for (const int seconds : lengths)
        length.addItem(editor::tr("Last {0} s", {juce::String(seconds)}), seconds);
    length.setSelectedId(5, juce::dontSendNotification);
    length.setTitle("Length of the capture");
    length.setTooltip("Length of the recent sound that becomes a clip");
    button.setDescription("Turns the last seconds of sound into a clip");
    editor::prepareButton(button, "Turns the last seconds of sound into a clip", [this] { captureNow(); });
    editButton.setDescription("Opens the captured clip in the clip editor");
    editButton.setEnabled(false);
    editor::prepareButton(editButton, "Opens the captured clip in the clip editor",
                          [this]
                          {
                              if (onEdit)
                                  onEdit(*captured);
                          });
    saveButton.setDescription("Saves the captured clip, as JSON or packed");
    saveButton.setEnabled(false);
    editor::prepareButton(saveButton, "Saves the captured clip, as JSON or packed", [this] { chooseFile(); });
    keepButton.setToggleState(source.keepsCaptures(), juce::dontSendNotification);
    editor::prepareButton(keepButton, "Keeps the captured sound in the session, to analyse it again",
                          [this] { source.setKeepsCaptures(keepButton.getToggleState()); });
    message.setFont(editor::smallFont());
    message.setJustificationType(juce::Justification::centredLeft);
    editor::addAll(*this, {&length, &button, &keepButton, &editButton, &saveButton, &message});
    addChildComponent(chip);
    addChildComponent(notice);
}

void CapturePanel::resized()
{
    auto area = getLocalBounds();
    auto row = area.removeFromTop(3 * grid + 2);
    button.setBounds(row.removeFromLeft(11 * grid));
    row.removeFromLeft(grid);
    length.setBounds(row.removeFromLeft(13 * grid));
    row.removeFromLeft(grid);
    keepButton.setBounds(row.removeFromLeft(13 * grid));
    row.removeFromLeft(grid);
    editButton.setBounds(row.removeFromLeft(editor::buttonWidth(editButton, 9 * grid)));
    row.removeFromLeft(grid);
    saveButton.setBounds(row.removeFromLeft(editor::buttonWidth(saveButton, 9 * grid)));
    row.removeFromLeft(grid);
    chip.setBounds(row);
    message.setBounds(row);
    notice.setBounds(row);
}

void CapturePanel::captureNow()
{
    auto capture = source.capture(static_cast<double>(length.getSelectedId()));
    ++captures;
    const bool begun = job.begin({std::move(capture), source.sampleRate(), "capture " + std::to_string(captures),
                                  source.keepsCaptures(), encoderOf(source.values().translator())},
                                 [this](Result<editor::CapturedClip> made) { take(std::move(made)); });
    if (begun)
        button.setEnabled(false);
}

void CapturePanel::take(Result<editor::CapturedClip> made)
{
    button.setEnabled(true);
    if (!made)
    {
        say(editor::tr("No clip: {0}", {editor::translateMessage(juce::String(made.error().text()))}), true);
        return;
    }
    captured = std::move(made).value();
    const Clip& clip = captured->clip;
    const auto written = editor::writeForDragging(clip);
    file = written ? *written : juce::File();
    say(written ? juce::String()
                : editor::tr("Cannot be dragged: {0}", {editor::translateMessage(toText(written.error().text()))}),
        !written);
    chip.show(clip, [this] { return file; });
    if (captured->sound && !*captured->sound)
        say(editor::tr("Sound not kept: {0}",
                       {editor::translateMessage(juce::String(captured->sound->error().text()))}),
            true);
    saveButton.setEnabled(true);
    editButton.setEnabled(true);
}

void CapturePanel::chooseFile()
{
    chooser = std::make_unique<juce::FileChooser>(
        editor::tr("Save clip"), editor::documentsFolder().getChildFile(file.getFileName()), "*.json;*.pacb");
    editor::askForFiles(*chooser, juce::FileBrowserComponent::saveMode, // save() asks
                        [this](const juce::FileChooser& chosen)
                        {
                            if (chosen.getResult() != juce::File())
                                save(chosen.getResult());
                        });
}

void CapturePanel::save(const juce::File& chosen)
{
    const bool packed = chosen.hasFileExtension("pacb");
    const juce::File target = packed || chosen.hasFileExtension("json") ? chosen : chosen.withFileExtension("json");
    const auto path = editor::pathOf(target);
    const auto failed = [this](const Error& error)
    {
        say(editor::tr("Not saved: {0}", {editor::translateMessage(toText(error.text()))}), true);
    };
    const auto write = [this, path, packed, clip = captured->clip, failed]
    {
        if (const auto written = writeClip(path, clip, packed ? packedFormat() : jsonFormat()); !written)
            failed(written.error());
        else
            notice.showWritten({path});
    };
    const auto ask = [this](std::unique_ptr<editor::Sheet> asked)
    {
        auto* window = findParentComponentOfClass<juce::AudioProcessorEditor>();
        question = std::make_unique<editor::SheetOver>(window != nullptr ? static_cast<juce::Component&>(*window)
                                                                         : *getTopLevelComponent());
        question->show(std::move(asked));
    };
    editor::writeAfterAsking({path}, {}, write, ask, failed);
}

void CapturePanel::say(const juce::String& text, bool wrong)
{
    message.setColour(juce::Label::textColourId, wrong ? paletteFor(*this).warning : paletteFor(*this).dim);
    message.setText(text, juce::dontSendNotification);
    message.setTooltip(text);
    if (wrong)
        chip.setVisible(false);
}

} // namespace pacini::plugin
