// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/ClipChip.h"

#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "io/ClipFile.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini::editor
{

Result<juce::File> writeForDragging(const Clip& clip)
{
    // In a folder of its own: captures of several windows have one name.
    const auto folder = juce::File::getSpecialLocation(juce::File::tempDirectory)
                            .getChildFile("Pacini clips")
                            .getChildFile(juce::Uuid().toDashedString());
    folder.createDirectory();
    const juce::String name = juce::File::createLegalFileName(toText(clip.name).replaceCharacter(' ', '-'));
    const auto file = folder.getChildFile((name.isEmpty() ? juce::String("clip") : name) + ".json");
    if (const auto written = writeClip(pathOf(file), clip, jsonFormat()); !written)
        return written.error();
    return file;
}

ClipChip::ClipChip()
{
    setTitle("Captured clip");
    setDescription("Drag to a folder or another program");
    setTooltip("Drag to a folder or another program");
    setMouseCursor(juce::MouseCursor::DraggingHandCursor);
    setVisible(false);
}

void ClipChip::show(const Clip& clip, std::function<juce::File()> file)
{
    makeFile = std::move(file);
    text = toText(clip.name) + ", " + numberText(clip.duration, 1) + " s";
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

void ClipChip::mouseDown(const juce::MouseEvent&)
{
    begun = false;
}

void ClipChip::mouseDrag(const juce::MouseEvent& event)
{
    constexpr int least = 6; // pixels
    if (begun || event.getDistanceFromDragStart() <= least || !makeFile)
        return;
    begun = true;
    if (const juce::File file = makeFile(); file.existsAsFile())
        juce::DragAndDropContainer::performExternalDragDropOfFiles({file.getFullPathName()}, false, this);
}

} // namespace pacini::editor
