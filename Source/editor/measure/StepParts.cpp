// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/measure/StepParts.h"

#include "editor/Text.h"
#include "editor/Translation.h"

#include <cmath>

namespace pacini::editor
{

void prepareSlider(juce::Slider& slider, double least, double most, double step, const juce::String& unit, int decimals)
{
    slider.setSliderStyle(juce::Slider::LinearHorizontal);
    slider.setTextBoxStyle(juce::Slider::TextBoxRight, false, 9 * grid, 3 * grid);
    slider.setRange(least, most, step);
    slider.setNumDecimalPlacesToDisplay(decimals);
    slider.setTextValueSuffix(unit.isEmpty() ? unit : " " + unit);
}

juce::String signedText(double value, int decimals)
{
    const juce::String text = numberText(value, decimals);
    return value > 0.0 && text.containsAnyOf("123456789") ? "+" + text : text;
}

juce::String worstText(const Linearity& linearity)
{
    return tr("{0} dB at {1} Hz", {signedText(linearity.worstDeviation, 2), numberText(linearity.worstFrequency, 0)});
}

void drawSideAndPlot(juce::Graphics& g, const juce::Component& step, const juce::String& title)
{
    const Palette& p = paletteFor(step);
    auto area = step.getLocalBounds();
    drawCard(g, area.removeFromLeft(stepSide), title, p);
    area.removeFromLeft(grid);
    g.setColour(p.card);
    g.fillRoundedRectangle(area.toFloat(), 6.0f);
}

NoteBox::NoteBox(const juce::String& name)
{
    setMultiLine(true);
    setReadOnly(true);
    setCaretVisible(false);
    setScrollbarsShown(true);
    setTitle(name);
    setFont(usualFont());
    setIndents(grid, grid / 2);
    for (const int id : {backgroundColourId, outlineColourId, shadowColourId}) // but for the ring
        setColour(id, juce::Colours::transparentBlack);
}

void NoteBox::show(std::vector<Note> wanted)
{
    if (wanted == notes)
        return;
    notes = std::move(wanted);
    fill();
}

void NoteBox::lookAndFeelChanged()
{
    juce::TextEditor::lookAndFeelChanged();
    fill();
}

void NoteBox::fill()
{
    const Palette& p = paletteFor(*this);
    setText({}, false);
    for (std::size_t i = 0; i < notes.size(); ++i)
    {
        setColour(textColourId, notes[i].kind == Note::Kind::warning ? p.warning : p.text);
        insertTextAtCaret((i > 0 ? "\n" : "") + translateMessage(toText(notes[i].text)));
    }
    moveCaretToTop(false);
    setDescription(getText());
}

void FactTable::show(Facts wanted)
{
    if (wanted == facts)
        return;
    facts = std::move(wanted);
    juce::StringArray lines;
    for (const auto& [name, value] : facts)
        lines.add(name + ": " + value);
    setDescription(lines.joinIntoString(", "));
    repaint();
}

void FactTable::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    auto area = getLocalBounds();
    g.setFont(usualFont());
    for (const auto& [name, value] : facts)
    {
        const auto row = area.removeFromTop(rowHeight);
        g.setColour(p.dim);
        g.drawText(name, row, juce::Justification::centredLeft, true);
        g.setColour(p.text);
        g.drawText(value, row.withTrimmedLeft(usualFont().getStringWidth(name) + grid),
                   juce::Justification::centredRight, true);
    }
}

} // namespace pacini::editor
