// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/LossTable.h"

#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>
#include <array>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr int lossRowHeight = 3 * grid;
constexpr int countWidth = 7 * grid, worstWidth = 12 * grid, placeWidth = 12 * grid;

/// Without its numbers.
std::string patternOf(const std::string& message)
{
    std::string pattern;
    for (const char c : message)
        if ((c < '0' || c > '9') && c != '.' && c != ',')
            pattern += c;
    return pattern;
}

juce::String worstText(const FormatLoss& loss)
{
    if (!(loss.error > 0.0))
        return {};
    if (loss.kind == LossKind::frequency)
        return tr("{0} octaves", {numberText(loss.error, 2)});
    if (loss.kind == LossKind::timeStep || loss.kind == LossKind::length)
        return numberText(1000.0 * loss.error, 1) + " ms";
    return numberText(100.0 * loss.error, 1) + " %";
}

juce::String placeText(const FormatLoss& loss)
{
    return loss.duration > 0.0
               ? tr("{0} to {1} s", {numberText(loss.time, 2), numberText(loss.time + loss.duration, 2)})
               : numberText(loss.time, 2) + " s";
}

/// The columns of a row, from left to right.
std::array<juce::Rectangle<int>, 4> columnsOf(juce::Rectangle<int> row)
{
    row.reduce(grid, 0);
    const auto place = row.removeFromRight(placeWidth);
    const auto worst = row.removeFromRight(worstWidth);
    const auto count = row.removeFromRight(countWidth);
    return {row, count, worst, place};
}
} // namespace

std::vector<LossGroup> groupedLosses(const std::vector<FormatLoss>& losses)
{
    std::vector<LossGroup> groups;
    std::vector<std::string> patterns;
    for (const FormatLoss& loss : losses)
    {
        const std::string pattern = patternOf(loss.message);
        std::size_t at = 0;
        while (at < groups.size() && (groups[at].worst.kind != loss.kind || patterns[at] != pattern))
            ++at;
        if (at == groups.size())
        {
            groups.push_back({loss, 0});
            patterns.push_back(pattern);
        }
        ++groups[at].count;
        if (loss.error > groups[at].worst.error)
            groups[at].worst = loss;
    }
    return groups;
}

LossTable::LossTable()
{
    setTitle("Losses");
    setFocusContainerType(FocusContainerType::focusContainer);
    list.setTitle("Losses");
    list.setRowHeight(lossRowHeight);
    list.setColour(juce::ListBox::backgroundColourId, juce::Colours::transparentBlack);
    addAndMakeVisible(list);
}

LossTable::~LossTable()
{
    list.setModel(nullptr);
}

void LossTable::show(const std::vector<Part>& parts)
{
    rows.clear();
    for (const Part& part : parts)
    {
        if (part.title.isNotEmpty() && !part.losses.empty())
            rows.push_back({.loss = part.title, .count = {}, .worst = {}, .place = {}, .isTitle = true});
        for (const LossGroup& group : groupedLosses(part.losses))
            rows.push_back({.loss = translateMessage(toText(group.worst.message)),
                            .count = juce::String(static_cast<int>(group.count)),
                            .worst = worstText(group.worst),
                            .place = placeText(group.worst),
                            .time = group.worst.time,
                            .duration = group.worst.duration,
                            .clip = part.clip});
    }
    list.deselectAllRows();
    list.updateContent();
    list.repaint();
}

juce::String LossTable::getNameForRow(int row)
{
    if (row < 0 || row >= getNumRows())
        return {};
    const Row& one = rows[static_cast<std::size_t>(row)];
    juce::StringArray parts{one.loss, one.count, one.worst, one.place};
    parts.removeEmptyStrings();
    return parts.joinIntoString(", ");
}

juce::String LossTable::getTooltipForRow(int row)
{
    return row >= 0 && row < getNumRows() ? rows[static_cast<std::size_t>(row)].loss : juce::String();
}

void LossTable::go(int row)
{
    if (row < 0 || row >= getNumRows() || rows[static_cast<std::size_t>(row)].isTitle || !onPlace)
        return;
    // What is called may remove this table.
    const Row one = rows[static_cast<std::size_t>(row)];
    const auto place = onPlace;
    place(one.clip, one.time, one.duration);
}

void LossTable::listBoxItemClicked(int row, const juce::MouseEvent&)
{
    go(row);
}

void LossTable::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool selected)
{
    if (row < 0 || row >= getNumRows())
        return;
    const Palette& p = paletteFor(*this);
    const Row& one = rows[static_cast<std::size_t>(row)];
    const juce::Rectangle<int> area(width, height);
    if (selected)
    {
        g.setColour(p.accent.withAlpha(list.hasKeyboardFocus(true) ? 0.35f : 0.2f));
        g.fillRoundedRectangle(area.toFloat().reduced(1.0f), space::corner);
    }
    g.setFont(one.isTitle ? smallFont().boldened() : smallFont());
    const auto columns = columnsOf(area);
    g.setColour(p.text);
    g.drawText(one.loss, one.isTitle ? area.reduced(grid, 0) : columns[0].withTrimmedRight(grid),
               juce::Justification::centredLeft, true);
    g.drawText(one.count, columns[1], juce::Justification::centredRight, true);
    g.drawText(one.worst, columns[2], juce::Justification::centredRight, true);
    g.setColour(quietTextColour(p, selected));
    g.drawText(one.place, columns[3], juce::Justification::centredRight, true);
}

void LossTable::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.setColour(p.well);
    g.fillRoundedRectangle(getLocalBounds().toFloat(), space::corner);
    g.setColour(p.dim);
    g.setFont(smallFont());
    const auto columns = columnsOf(getLocalBounds().removeFromTop(lossRowHeight).withTrimmedRight(space::scrollBar));
    g.drawText(tr("Loss"), columns[0], juce::Justification::centredLeft, true);
    g.drawText(tr("Count"), columns[1], juce::Justification::centredRight, true);
    g.drawText(tr("Worst"), columns[2], juce::Justification::centredRight, true);
    g.drawText(tr("Where"), columns[3], juce::Justification::centredRight, true);
    g.setColour(p.line);
    g.fillRect(0, lossRowHeight - 1, getWidth(), 1);
}

void LossTable::resized()
{
    list.setBounds(getLocalBounds().withTrimmedTop(lossRowHeight));
    list.setVisible(getHeight() > 2 * lossRowHeight);
}

} // namespace pacini::editor
