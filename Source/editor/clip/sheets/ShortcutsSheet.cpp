// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/ShortcutsSheet.h"

#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/commands/KeyText.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace pacini::editor
{

namespace
{
constexpr int shortcutRowHeight = 3 * grid;
constexpr int keyWidth = 24 * grid;
constexpr std::array<std::pair<const char*, const char*>, 13> gestures{{
    {"Double-click", "Adds a point or an event"},
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
    {"Mouse wheel", "Scrolls; over ruler and sound, or with Ctrl: zooms; Shift: scrolls in time; Alt: lane height"},
}};
} // namespace

/// One row for each gesture and command, drawn and read out as a list.
class ShortcutsSheet::Table final : public juce::Component, public juce::SettableTooltipClient
{
public:
    explicit Table(Menus& shown) : menus(shown)
    {
        setTitle("Keyboard and mouse");
        setWantsKeyboardFocus(true);
        fill();
    }

    std::function<void(const juce::String&)> say;

    void paint(juce::Graphics& g) override
    {
        const Palette& p = paletteFor(*this);
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            const Row& one = rows[i];
            auto row = placeOf(i);
            if (!g.getClipBounds().intersects(row))
                continue;
            if (one.isHeading)
            {
                g.setColour(p.accent);
                g.setFont(usualFont().boldened());
                g.drawText(one.key, row.withTrimmedLeft(grid / 2), juce::Justification::bottomLeft);
                continue;
            }
            const bool isChosen = chosen == i;
            if (isChosen && (hasKeyboardFocus(false) || waits))
            {
                g.setColour(p.accent.withAlpha(0.25f));
                g.fillRoundedRectangle(row.toFloat().reduced(1.0f), space::corner);
            }
            else if (over == i)
            {
                g.setColour(p.control);
                g.fillRoundedRectangle(row.toFloat().reduced(1.0f), space::corner);
            }
            row.reduce(grid / 2, 0);
            g.setFont(smallFont());
            g.setColour(isChosen && waits ? p.accent : p.text);
            g.drawText(isChosen && waits   ? tr(toText("Press a key…"))
                       : one.key.isEmpty() ? toText("–")
                                           : one.key,
                       row.removeFromLeft(keyWidth).withTrimmedRight(grid), juce::Justification::centredLeft, true);
            g.setColour(p.dim);
            g.drawText(one.text, row, juce::Justification::centredLeft, true);
        }
    }

private:
    struct Row
    {
        juce::String key, text;
        bool isHeading = false;
        std::optional<Command> command = {}; ///< none: a gesture, which stays
    };

    void fill()
    {
        rows = {{tr("In lanes"), {}, true}};
        for (const auto& [key, text] : gestures)
            rows.push_back({tr(key), tr(text)});
        for (const Menu& menu : menus.all())
        {
            rows.push_back({tr(menu.name), {}, true});
            for (const Action& action : menu.actions)
                if (action.run)
                    rows.push_back(
                        {menus.keyTextOf(action.id), Menus::nameOf(action) + ": " + tr(action.help), false, action.id});
        }
        setSize(std::max(600, getWidth()), static_cast<int>(rows.size()) * shortcutRowHeight);
        juce::StringArray lines;
        for (const Row& one : rows)
            lines.add(one.key + " " + one.text);
        setDescription(lines.joinIntoString(". "));
        repaint();
    }

    [[nodiscard]] juce::Rectangle<int> placeOf(std::size_t row) const
    {
        return {0, static_cast<int>(row) * shortcutRowHeight, getWidth(), shortcutRowHeight};
    }

    [[nodiscard]] std::optional<std::size_t> commandRowAt(int y) const
    {
        const auto row = static_cast<std::size_t>(std::max(0, y) / shortcutRowHeight);
        return y >= 0 && row < rows.size() && rows[row].command ? std::optional(row) : std::nullopt;
    }

    void choose(std::size_t row)
    {
        chosen = row;
        waits = false;
        if (auto* list = findParentComponentOfClass<juce::Viewport>())
        {
            const auto seen = list->getViewArea();
            const auto place = placeOf(row);
            if (place.getY() < seen.getY())
                list->setViewPosition(0, place.getY());
            else if (place.getBottom() > seen.getBottom())
                list->setViewPosition(0, place.getBottom() - seen.getHeight());
        }
        if (hasKeyboardFocus(false))
            juce::AccessibilityHandler::postAnnouncement(rows[row].key + " " + rows[row].text,
                                                         juce::AccessibilityHandler::AnnouncementPriority::medium);
        repaint();
    }

    void step(int direction)
    {
        const int count = static_cast<int>(rows.size());
        for (int row = (chosen ? static_cast<int>(*chosen) : -1) + direction; row >= 0 && row < count; row += direction)
            if (rows[static_cast<std::size_t>(row)].command)
                return choose(static_cast<std::size_t>(row));
    }

    void wait()
    {
        if (!chosen)
            return;
        waits = true;
        say(tr("Press the new key of {0}. Delete: none; Esc: as before",
               {rows[*chosen].text.upToFirstOccurrenceOf(":", false, false)}));
        repaint();
    }

    void take(const juce::KeyPress& key)
    {
        using Key = juce::KeyPress;
        const Command command = *rows[*chosen].command;
        const bool none = key.getKeyCode() == Key::deleteKey || key.getKeyCode() == Key::backspaceKey;
        if (key.getKeyCode() == Key::escapeKey)
            say({});
        else if (!none && !Menus::isFree(key))
            return say(tr("Lanes and dialogs need {0}. Press another key", {keyText(key)}));
        else
        {
            const auto before = none ? std::nullopt : menus.commandOf(key);
            menus.setKey(command, none ? Key() : key);
            say(before && *before != command
                    ? tr("{0} was the key of another command, which has none now", {keyText(key)})
                    : juce::String());
        }
        waits = false;
        fill();
    }

    bool keyPressed(const juce::KeyPress& key) override
    {
        using Key = juce::KeyPress;
        if (waits)
            take(key);
        else if (key == Key(Key::downKey) || key == Key(Key::upKey))
            step(key.getKeyCode() == Key::downKey ? 1 : -1);
        else if (key == Key(Key::returnKey) && chosen)
            wait();
        else
            return false;
        return true;
    }

    void mouseDown(const juce::MouseEvent& event) override
    {
        if (const auto row = commandRowAt(event.y))
        {
            choose(*row);
            grabKeyboardFocus();
            wait();
        }
    }
    void mouseMove(const juce::MouseEvent& event) override { show(commandRowAt(event.y)); }
    void mouseExit(const juce::MouseEvent&) override { show(std::nullopt); }
    void show(std::optional<std::size_t> row)
    {
        if (std::exchange(over, row) == row)
            return;
        setTooltip(row ? rows[*row].text : juce::String());
        repaint();
    }
    void focusGained(FocusChangeType) override
    {
        if (!chosen)
            step(1);
        repaint();
    }
    void focusLost(FocusChangeType) override
    {
        waits = false;
        repaint();
    }

    Menus& menus;
    std::vector<Row> rows;
    std::optional<std::size_t> chosen, over;
    bool waits = false; ///< for a key of the chosen row
};

ShortcutsSheet::ShortcutsSheet(Menus& menus) : Sheet("Keyboard and mouse", 864, 720)
{
    auto* table = new Table(menus);
    table->say = [this](const juce::String& text)
    {
        note.setText(text, juce::dontSendNotification);
    };
    viewport.setViewedComponent(table, true);
    viewport.setScrollBarsShown(true, false);
    viewport.setWantsKeyboardFocus(false);
    note.setFont(smallFont());
    note.setText(tr("Click a command, or choose it with the arrow keys and press Return, to change its key."),
                 juce::dontSendNotification);
    addAndMakeVisible(viewport);
    addAndMakeVisible(note);
    setAnswers({{"Close", {}},
                {"Reset all keys", [&menus]
                 {
                     menus.resetKeys();
                 }}});
}

juce::Component* ShortcutsSheet::firstFocus()
{
    return viewport.getViewedComponent();
}

void ShortcutsSheet::layOut(juce::Rectangle<int> area)
{
    note.setBounds(area.removeFromBottom(3 * grid));
    viewport.setBounds(area.withTrimmedBottom(grid));
    auto* table = viewport.getViewedComponent();
    table->setSize(area.getWidth() - viewport.getScrollBarThickness() - grid, table->getHeight());
}

} // namespace pacini::editor
