// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/HistorySheet.h"

#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/session/StepText.h"

#include <algorithm>

namespace pacini::editor
{

HistorySheet::HistorySheet(EditorModel& project) : Sheet("History", 360, 720), model(project)
{
    list.setTitle("Steps");
    list.setRowHeight(3 * grid);
    list.setColour(juce::ListBox::backgroundColourId, juce::Colours::transparentBlack);
    addAndMakeVisible(list);
    setAnswers({{"Close", {}}});
    standAside();
    subscriptions.on({&model.projectChanged}, [this] { showCurrent(); });
    showCurrent();
}

HistorySheet::~HistorySheet()
{
    list.setModel(nullptr);
}

int HistorySheet::getNumRows()
{
    return static_cast<int>(model.document().steps().size());
}

juce::String HistorySheet::getNameForRow(int row)
{
    if (row < 0 || row >= getNumRows())
        return {};
    return row == 0 ? tr("As opened") : stepText(model.document().steps().name(static_cast<std::size_t>(row)));
}

void HistorySheet::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool selected)
{
    const Palette& p = paletteFor(*this);
    const juce::Rectangle<int> area(width, height);
    if (selected)
    {
        g.setColour(p.accent.withAlpha(list.hasKeyboardFocus(true) ? 0.35f : 0.2f));
        g.fillRoundedRectangle(area.toFloat().reduced(1.0f), 4.0f);
    }
    // What was undone is still there.
    const bool undone = row > static_cast<int>(model.document().steps().current());
    g.setColour(undone ? quietTextColour(p, selected) : p.text);
    g.setFont(usualFont());
    g.drawText(getNameForRow(row), area.reduced(grid, 0), juce::Justification::centredLeft, true);
}

void HistorySheet::selectedRowsChanged(int row)
{
    if (row >= 0 && row != static_cast<int>(model.document().steps().current()))
        model.goTo(static_cast<std::size_t>(row));
}

void HistorySheet::showCurrent()
{
    constexpr int least = 6, most = 24; // rows
    setContentHeight(std::clamp(getNumRows(), least, most) * list.getRowHeight());
    list.updateContent();
    const int row = static_cast<int>(model.document().steps().current());
    juce::SparseSet<int> chosen;
    chosen.addRange({row, row + 1});
    list.setSelectedRows(chosen, juce::dontSendNotification);
    list.scrollToEnsureRowIsOnscreen(row);
    list.repaint();
}

} // namespace pacini::editor
