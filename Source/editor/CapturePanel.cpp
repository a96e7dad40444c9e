// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/CapturePanel.h"

#include "editor/Text.h"
#include "editor/Theme.h"
#include "io/ClipFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr std::array<int, 4> lengths{3, 5, 10, 30}; // s

juce::File dragFolder()
{
    return juce::File::getSpecialLocation(juce::File::tempDirectory).getChildFile("Pacini captures");
}
} // namespace

ClipChip::ClipChip()
{
    setTitle("Captured clip");
    setDescription("Drag it to a folder or into a program that takes files");
    setTooltip("Drag it to a folder or into a program that takes files");
    setMouseCursor(juce::MouseCursor::DraggingHandCursor);
    setVisible(false);
}

void ClipChip::show(const Clip& clip, const juce::File& wanted)
{
    dragged = wanted;
    text = toText(clip.name) + ", " + juce::String(clip.duration, 1) + " s";
    curve.clear();
    curve.startNewSubPath(0.0f, 1.0f);
    double loudest = 1e-9;
    for (const auto& point : clip.envelope)
        loudest = std::max(loudest, point.value);
    for (const auto& point : clip.envelope)
        curve.lineTo(static_cast<float>(point.time / std::max(clip.duration, 1e-9)),
                     1.0f - static_cast<float>(std::sqrt(std::max(point.value, 0.0) / loudest)));
    curve.lineTo(1.0f, 1.0f);
    curve.closeSubPath();
    setVisible(true);
    repaint();
}

void ClipChip::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    const auto area = getLocalBounds().toFloat().reduced(0.5f);
    g.setColour(p.well);
    g.fillRoundedRectangle(area, 4.0f);
    const auto plot = area.reduced(4.0f, 3.0f);
    g.setColour(p.accent.withAlpha(0.35f));
    g.fillPath(curve, juce::AffineTransform::scale(plot.getWidth(), plot.getHeight()).translated(plot.getTopLeft()));
    g.setColour(p.accent);
    g.drawRoundedRectangle(area, 4.0f, 1.0f);
    g.setColour(p.text);
    g.setFont(smallFont());
    g.drawFittedText(text, getLocalBounds().reduced(grid, 0), juce::Justification::centredLeft, 1);
}

void ClipChip::mouseDrag(const juce::MouseEvent& event)
{
    if (event.getDistanceFromDragStart() > 6 && dragged.existsAsFile())
        juce::DragAndDropContainer::performExternalDragDropOfFiles({dragged.getFullPathName()}, false, this);
}

CapturePanel::CapturePanel(LiveSource& heard)
    : source(heard), button("Capture"), editButton("Edit"), saveButton("Save" + toText("…"))
{
    for (const int seconds : lengths)
        length.addItem("Last " + juce::String(seconds) + " s", seconds);
    length.setSelectedId(5, juce::dontSendNotification);
    length.setTitle("Length of the capture");
    length.setTooltip("How much of what was heard becomes a clip");
    button.setTooltip("Turns the last seconds of the sound into a clip");
    button.setDescription("Turns the last seconds of the sound into a clip");
    button.onClick = [this]
    {
        captureNow();
    };
    editButton.setTooltip("Opens the captured clip in the clip editor");
    editButton.setDescription("Opens the captured clip in the clip editor");
    editButton.setEnabled(false);
    editButton.onClick = [this]
    {
        if (onEdit)
            onEdit(*clip);
    };
    saveButton.setTooltip("Saves the captured clip, as JSON or packed");
    saveButton.setDescription("Saves the captured clip, as JSON or packed");
    saveButton.setEnabled(false);
    saveButton.onClick = [this]
    {
        chooseFile();
    };
    message.setFont(smallFont());
    message.setJustificationType(juce::Justification::centredLeft);
    for (juce::Component* child :
         std::initializer_list<juce::Component*>{&length, &button, &editButton, &saveButton, &message})
        addAndMakeVisible(child);
    addChildComponent(chip);
}

void CapturePanel::resized()
{
    auto area = getLocalBounds();
    auto row = area.removeFromTop(3 * grid + 2);
    button.setBounds(row.removeFromLeft(11 * grid));
    row.removeFromLeft(grid);
    length.setBounds(row.removeFromLeft(13 * grid));
    row.removeFromLeft(grid);
    editButton.setBounds(row.removeFromLeft(7 * grid));
    row.removeFromLeft(grid);
    saveButton.setBounds(row.removeFromLeft(9 * grid));
    row.removeFromLeft(grid);
    chip.setBounds(row);
    message.setBounds(row);
}

void CapturePanel::captureNow()
{
    auto capture = source.capture(static_cast<double>(length.getSelectedId()));
    ++captures;
    const bool begun = job.begin(std::move(capture), source.sampleRate(), "capture " + juce::String(captures),
                                 [this](Result<Clip> made) { take(std::move(made)); });
    if (begun)
        button.setEnabled(false);
}

void CapturePanel::take(Result<Clip> made)
{
    button.setEnabled(true);
    if (!made)
    {
        say("No clip: " + juce::String(made.error().text()), true);
        return;
    }
    clip = std::move(made).value();
    const auto file = dragFolder().getChildFile(juce::String(clip->name).replaceCharacter(' ', '-') + ".json");
    dragFolder().createDirectory();
    const auto written = writeClip(file.getFullPathName().toStdString(), *clip, ClipFormat::json);
    if (!written)
        say("Cannot be dragged: " + juce::String(written.error().text()), true);
    else
        say("", false);
    chip.show(*clip, file);
    saveButton.setEnabled(true);
    editButton.setEnabled(true);
}

void CapturePanel::chooseFile()
{
    chooser = std::make_unique<juce::FileChooser>(
        "Save the clip",
        juce::File::getSpecialLocation(juce::File::userDocumentsDirectory).getChildFile(chip.file().getFileName()),
        "*.json;*.pacb");
    chooser->launchAsync(juce::FileBrowserComponent::saveMode | juce::FileBrowserComponent::warnAboutOverwriting,
                         [this](const juce::FileChooser& chosen)
                         {
                             if (chosen.getResult() != juce::File())
                                 save(chosen.getResult());
                         });
}

void CapturePanel::save(const juce::File& file)
{
    const bool packed = file.hasFileExtension("pacb");
    const juce::File target = packed || file.hasFileExtension("json") ? file : file.withFileExtension("json");
    const auto written =
        writeClip(target.getFullPathName().toStdString(), *clip, packed ? ClipFormat::packed : ClipFormat::json);
    if (!written)
        say("Not saved: " + juce::String(written.error().text()), true);
}

void CapturePanel::say(const juce::String& text, bool wrong)
{
    message.setColour(juce::Label::textColourId, wrong ? paletteFor(*this).warning : paletteFor(*this).dim);
    message.setText(text, juce::dontSendNotification);
    message.setTooltip(text);
    if (wrong)
        chip.setVisible(false);
}

} // namespace pacini::editor
