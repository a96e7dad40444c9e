// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/CommandSheet.h"

#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/commands/KeyText.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{
/// How well words fit a text: 3 where each begins a word of it in order from its start, 2 where each begins a word, 1
/// where each is somewhere, 0 where one is missing.
int fitOf(const juce::StringArray& words, const juce::String& text)
{
    int fit = 3;
    int from = 0;
    for (const juce::String& word : words)
    {
        const int at = text.indexOfIgnoreCase(word);
        if (at < 0)
            return 0;
        const auto beginsWord = [&](int place)
        {
            return place == 0 || !juce::CharacterFunctions::isLetterOrDigit(text[place - 1]);
        };
        int begin = at;
        while (begin >= 0 && !beginsWord(begin))
            begin = text.indexOfIgnoreCase(begin + 1, word);
        fit = std::min(fit, begin < 0 ? 1 : begin >= from && (from > 0 || begin == 0) ? 3 : 2);
        from = std::max(from, begin + 1);
    }
    return fit;
}
} // namespace

CommandSheet::CommandSheet(Menus& ofView) : Sheet("Find a command", 560, 440), menus(ofView)
{
    for (const Menu& menu : menus.all())
        for (const Action& action : menu.actions)
            if (action.run)
                all.push_back(
                    {&action, Menus::nameOf(action), tr(menu.name), menus.keyTextOf(action.id), Menus::canDo(action)});
    words.setTitle("Find a command");
    words.setFont(usualFont());
    words.setIndents(grid, 0);
    words.setJustification(juce::Justification::centredLeft);
    words.showWhenEmpty(tr("Words of a command"));
    words.onTextChange = [this]
    {
        search();
    };
    words.onReturnKey = [this]
    {
        performSelected();
    };
    words.onEscapeKey = [this]
    {
        close();
    };
    words.addKeyListener(this);
    addAndMakeVisible(words);
    list.setTitle("Commands");
    list.setRowHeight(4 * grid);
    list.setColour(juce::ListBox::backgroundColourId, juce::Colours::transparentBlack);
    list.setWantsKeyboardFocus(false);
    addAndMakeVisible(list);
    search();
}

CommandSheet::~CommandSheet()
{
    words.removeKeyListener(this);
    list.setModel(nullptr);
}

std::vector<Command> CommandSheet::found() const
{
    std::vector<Command> commands;
    for (const Entry* entry : shown)
        commands.push_back(entry->action->id);
    return commands;
}

void CommandSheet::search()
{
    const auto parts = juce::StringArray::fromTokens(words.getText(), " ", {});
    std::vector<std::pair<int, const Entry*>> ranked;
    for (const Entry& entry : all)
    {
        // English too: most manuals are.
        const int byName = std::max(fitOf(parts, entry.name), fitOf(parts, entry.action->name));
        const int fit =
            byName > 0 ? 10 + byName
                       : fitOf(parts, entry.menu + " " + entry.name + " " + tr(entry.action->help) + " " + entry.keys);
        if (fit > 0)
            ranked.emplace_back(fit + (entry.possible ? 100 : 0), &entry);
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    shown.clear();
    for (const auto& [rank, entry] : ranked)
        shown.push_back(entry);
    list.updateContent();
    list.selectRow(0);
    list.repaint();
}

juce::String CommandSheet::getNameForRow(int row)
{
    if (row < 0 || row >= getNumRows())
        return {};
    const Entry& entry = *shown[static_cast<std::size_t>(row)];
    return entry.name + ", " + entry.menu + (entry.keys.isEmpty() ? juce::String() : ", " + entry.keys) +
           (entry.possible ? juce::String() : ", " + tr("not possible now"));
}

void CommandSheet::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool selected)
{
    if (row < 0 || row >= getNumRows())
        return;
    const Palette& p = paletteFor(*this);
    const Entry& entry = *shown[static_cast<std::size_t>(row)];
    auto area = juce::Rectangle<int>(width, height);
    if (selected)
    {
        g.setColour(p.accent.withAlpha(0.35f));
        g.fillRoundedRectangle(area.toFloat().reduced(1.0f), 4.0f);
    }
    area = area.reduced(grid, 0);
    g.setColour(quietTextColour(p, selected));
    g.setFont(smallFont());
    g.drawText(entry.keys, area.removeFromRight(18 * grid), juce::Justification::centredRight, true);
    g.drawText(entry.menu, area.removeFromLeft(11 * grid), juce::Justification::centredLeft, true);
    g.setColour(entry.possible ? p.text : quietTextColour(p, selected));
    g.setFont(usualFont());
    g.drawText(entry.name, area, juce::Justification::centredLeft, true);
}

void CommandSheet::listBoxItemClicked(int row, const juce::MouseEvent&)
{
    list.selectRow(row);
    performSelected();
}

void CommandSheet::performSelected()
{
    const int row = list.getSelectedRow();
    if (row < 0 || row >= getNumRows() || !shown[static_cast<std::size_t>(row)]->possible)
        return;
    // Behind the end of this sheet: the command may open another.
    juce::MessageManager::callAsync(
        [owner = juce::Component::SafePointer<juce::Component>(getParentComponent()), list = &menus,
         id = shown[static_cast<std::size_t>(row)]->action->id]
        {
            if (owner)
                list->perform(id);
        });
    close();
}

bool CommandSheet::keyPressed(const juce::KeyPress& key, juce::Component*)
{
    const int page = std::max(1, list.getHeight() / list.getRowHeight() - 1);
    const int by = key == juce::KeyPress::downKey       ? 1
                   : key == juce::KeyPress::upKey       ? -1
                   : key == juce::KeyPress::pageDownKey ? page
                   : key == juce::KeyPress::pageUpKey   ? -page
                                                        : 0;
    if (by == 0 || shown.empty())
        return by != 0;
    list.selectRow(std::clamp(list.getSelectedRow() + by, 0, getNumRows() - 1));
    // The keyboard stays in the text field, so a screen reader does not see the row.
    juce::AccessibilityHandler::postAnnouncement(getNameForRow(list.getSelectedRow()),
                                                 juce::AccessibilityHandler::AnnouncementPriority::high);
    return true;
}

void CommandSheet::layOut(juce::Rectangle<int> area)
{
    words.setBounds(area.removeFromTop(4 * grid));
    area.removeFromTop(grid);
    list.setBounds(area);
}

} // namespace pacini::editor
