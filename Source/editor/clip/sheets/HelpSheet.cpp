// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/HelpSheet.h"

#include "HelpData.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{
constexpr int listWidth = 24 * grid;
constexpr int helpRowHeight = 4 * grid;
} // namespace

HelpSheet::HelpSheet(bool onPlugin) : Sheet("Manual", 820, 560), topics("Topics", this)
{
    topics.setRowHeight(helpRowHeight);
    topics.setTitle("Topics");
    topics.setTooltip("Topics of the manual");
    text.setMultiLine(true);
    text.setReadOnly(true);
    text.setCaretVisible(false);
    text.setTitle("Text");
    text.setScrollbarsShown(true);
    text.setLineSpacing(1.2f);
    addAndMakeVisible(topics);
    addAndMakeVisible(text);
    setAnswers({{"Close", {}}});
    topics.selectRow(onPlugin ? getNumRows() - 1 : 0);
}

HelpSheet::~HelpSheet()
{
    topics.setModel(nullptr);
}

/// A topic begins with a heading of the first order; one paragraph a line. `1-editing.de.md` is `1-editing.md` in
/// German; where a language has no manual, the English one is shown.
std::vector<HelpSheet::Topic> HelpSheet::readTopics()
{
    juce::StringArray english, translated;
    for (int i = 0; i < helpData::namedResourceListSize; ++i)
    {
        const char* name = helpData::namedResourceList[i];
        const juce::String file(helpData::getNamedResourceOriginalFilename(name));
        const auto language = file.fromFirstOccurrenceOf(".", false, false).upToFirstOccurrenceOf(".md", false, false);
        if (language == "md")
            english.add(name);
        else if (language == languageInUse())
            translated.add(name);
    }
    juce::StringArray names = translated.isEmpty() ? english : translated;
    names.sort(false);
    std::vector<Topic> found;
    for (const auto& name : names)
    {
        int size = 0;
        const char* data = helpData::getNamedResource(name.toRawUTF8(), size);
        for (const auto& line : juce::StringArray::fromLines(toText({data, static_cast<std::size_t>(size)})))
            if (line.startsWith("# "))
                found.push_back({line.substring(2), {}});
            else if (line.isNotEmpty() && !found.empty())
                found.back().paragraphs.add(line);
    }
    return found;
}

void HelpSheet::show(const Topic& topic)
{
    const Palette& p = paletteFor(*this);
    text.clear();
    const auto add = [&](const juce::String& line, const juce::Font& font, juce::Colour colour)
    {
        text.setFont(font);
        text.setColour(juce::TextEditor::textColourId, colour);
        text.insertTextAtCaret(line);
    };
    add(topic.title + "\n\n", titleFont(), p.text);
    for (const auto& paragraph : topic.paragraphs)
    {
        const bool item = paragraph.startsWith("- ");
        const int name = item ? paragraph.indexOf(": ") : -1;
        if (name > 0)
        {
            add(toText("•  ") + paragraph.substring(2, name), usualFont().boldened(), p.text);
            add(paragraph.substring(name) + "\n", usualFont(), p.text);
        }
        else
            add(paragraph + "\n\n", usualFont(), p.text);
    }
    text.moveCaretToTop(false); // scrolls to the heading, too
}

void HelpSheet::lookAndFeelChanged()
{
    const Palette& p = paletteFor(*this);
    topics.setColour(juce::ListBox::backgroundColourId, p.well);
    text.setColour(juce::TextEditor::backgroundColourId, p.well);
    if (topics.getSelectedRow() >= 0)
        show(chapters[static_cast<std::size_t>(topics.getSelectedRow())]);
}

void HelpSheet::layOut(juce::Rectangle<int> area)
{
    topics.setBounds(area.removeFromLeft(listWidth));
    area.removeFromLeft(grid);
    text.setBounds(area);
}

void HelpSheet::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool selected)
{
    const Palette& p = paletteFor(*this);
    if (selected)
    {
        g.setColour(p.accent.withAlpha(0.25f));
        g.fillRect(0, 0, width, height);
    }
    g.setColour(p.text);
    g.setFont(usualFont());
    g.drawText(getNameForRow(row), juce::Rectangle<int>(width, height).reduced(grid, 0),
               juce::Justification::centredLeft);
}

juce::String HelpSheet::getNameForRow(int row)
{
    const auto i = static_cast<std::size_t>(row);
    return i < chapters.size() ? chapters[i].title : juce::String();
}

void HelpSheet::selectedRowsChanged(int row)
{
    if (row >= 0 && static_cast<std::size_t>(row) < chapters.size())
        show(chapters[static_cast<std::size_t>(row)]);
}

} // namespace pacini::editor
