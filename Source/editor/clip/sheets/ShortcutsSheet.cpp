// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/ShortcutsSheet.h"

#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/commands/KeyText.h"

#include <vector>

namespace pacini::editor
{

namespace
{
constexpr int shortcutRowHeight = 3 * grid;
constexpr int keyWidth = 25 * grid;
} // namespace

class ShortcutsSheet::Table final : public juce::Component
{
public:
    explicit Table(const std::vector<Menu>& menus)
    {
        rows = {{"In lanes", {}},
                {"Double-click", "Adds a point or a transient"},
                {"Drag a point", "Moves the selection; Shift: one direction only, Alt: no snapping"},
                {"Ctrl+drag a line", "Bends the line between its two points"},
                {"Drag with D, or Draw", "Draws the curve"},
                {"Drag elsewhere", "Selects what is inside the frame, across lanes; Shift adds"},
                {"Arrow keys", "Move the selection by one pixel, 1 dB or a semitone; Shift: ten times as far"},
                {"Alt+left, right", "Shortens or stretches the selection; so do the ends of its bar in the ruler"},
                {"Alt+up, down", "Expands or compresses the selected levels"},
                {"Ruler", "Click: playhead; drag: time range or one of its ends; markers below can be dragged"},
                {", and .", "Select the previous or next point"},
                {"Return", "Adds a point at the playhead"},
                {"Tab, Shift+Tab", "Next and previous lane or control"},
                {"Mouse wheel",
                 "Scrolls; over ruler and sound, or with Ctrl: zooms; Shift: scrolls in time; Alt: lane height"}};
        for (auto& [key, text] : rows)
        {
            key = tr(key);
            text = tr(text);
        }
        for (const Menu& menu : menus)
        {
            rows.push_back({tr(menu.name), {}});
            for (const Action& action : menu.actions)
                if (!action.keys.empty())
                    rows.push_back({keyText(action.keys.front()), tr(action.name) + ": " + tr(action.help)});
        }
        setSize(600, static_cast<int>(rows.size()) * shortcutRowHeight);
        setTitle("Keyboard and mouse");
        juce::StringArray lines;
        for (const auto& [key, text] : rows)
            lines.add(key + " " + text);
        setDescription(lines.joinIntoString(". "));
    }

    void paint(juce::Graphics& g) override
    {
        const Palette& p = paletteFor(*this);
        auto area = getLocalBounds();
        for (const auto& [key, text] : rows)
        {
            auto row = area.removeFromTop(shortcutRowHeight);
            if (text.isEmpty())
            {
                g.setColour(p.accent);
                g.setFont(usualFont().boldened());
                g.drawText(key, row, juce::Justification::bottomLeft);
                continue;
            }
            g.setFont(smallFont());
            g.setColour(p.text);
            g.drawFittedText(key, row.removeFromLeft(keyWidth).withTrimmedRight(grid), juce::Justification::centredLeft,
                             1);
            g.setColour(p.dim);
            g.drawFittedText(text, row, juce::Justification::centredLeft, 1);
        }
    }

private:
    std::vector<std::pair<juce::String, juce::String>> rows;
};

ShortcutsSheet::ShortcutsSheet(const std::vector<Menu>& menus) : Sheet("Keyboard and mouse", 760, 600)
{
    viewport.setViewedComponent(new Table(menus), true);
    viewport.setScrollBarsShown(true, false);
    addAndMakeVisible(viewport);
    setAnswers({{"Close", {}}});
}

void ShortcutsSheet::layOut(juce::Rectangle<int> area)
{
    viewport.setBounds(area);
    auto* table = viewport.getViewedComponent();
    table->setSize(area.getWidth() - viewport.getScrollBarThickness() - grid, table->getHeight());
}

} // namespace pacini::editor
