// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/Sheet.h"

#include "editor/FocusEntry.h"
#include "editor/LineBreaks.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr int titleHeight = 5 * grid;
constexpr int buttonHeight = 4 * grid;
constexpr int border = 3 * grid;
} // namespace

Sheet::Sheet(const juce::String& title, int width, int height)
    : wantedWidth(width), wantedHeight(height), shownHeight(height)
{
    setTitle(title);
    setWantsKeyboardFocus(true);
    setFocusContainerType(FocusContainerType::keyboardFocusContainer);
}

void Sheet::takeFocus()
{
    if (!isShowing())
        return;
    auto* first = firstFocus();
    // From the sheet itself Tab would go to what lies behind it.
    if (first == nullptr && !buttons.empty())
        first = buttons.front().get();
    (first != nullptr ? *first : static_cast<juce::Component&>(*this)).grabKeyboardFocus();
}

juce::Rectangle<int> Sheet::panel() const
{
    auto area = getLocalBounds().withSizeKeepingCentre(std::min(wantedWidth, getWidth() - 2 * grid),
                                                       std::min(wantedHeight, getHeight() - 2 * grid));
    area.setHeight(std::min(area.getHeight(), shownHeight));
    return aside ? area.withPosition(getWidth() - grid - area.getWidth(), getHeight() - grid - area.getHeight()) : area;
}

juce::Rectangle<int> Sheet::inside() const
{
    auto area = panel().reduced(border, 2 * grid).withTrimmedTop(titleHeight);
    return buttons.empty() ? area : area.withTrimmedBottom(buttonHeight + 2 * grid);
}

void Sheet::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    if (!aside)
        g.fillAll(juce::Colours::black.withAlpha(0.45f));
    const auto area = panel();
    g.setColour(p.card);
    g.fillRoundedRectangle(area.toFloat(), 8.0f);
    g.setColour(aside ? p.accent : p.line);
    g.drawRoundedRectangle(area.toFloat().reduced(0.5f), 8.0f, 1.0f);
    g.setColour(p.text);
    g.setFont(titleFont());
    g.drawText(getTitle(), area.reduced(border, 2 * grid).removeFromTop(titleHeight - grid),
               juce::Justification::centredLeft, true);
}

void Sheet::resized()
{
    auto row = panel().reduced(border, 2 * grid).removeFromBottom(buttonHeight);
    for (auto& button : buttons)
    {
        const int width = std::max(11 * grid, usualFont().getStringWidth(button->getButtonText()) + 4 * grid);
        button->setBounds(row.removeFromRight(width));
        row.removeFromRight(grid);
    }
    layOut(inside());
}

void Sheet::setAnswers(std::vector<Answer> answers)
{
    buttons.clear();
    choices = std::move(answers);
    for (std::size_t i = 0; i < choices.size(); ++i)
    {
        auto button = std::make_unique<juce::TextButton>(choices[i].text);
        button->onClick = [this, i]
        {
            if (i == 0 && usual)
                return usual();
            // Closing ends this sheet: what was chosen must not live in it.
            const auto chosen = choices[i].chosen;
            close();
            if (chosen)
                chosen();
        };
        if (i == 0 && choices.size() > 1) // what Return does
            makePrimary(*button);
        addAndMakeVisible(*button);
        buttons.push_back(std::move(button));
    }
    resized();
}

void Sheet::setAnswerEnabled(bool enabled)
{
    if (!buttons.empty())
        buttons.front()->setEnabled(enabled);
}

void Sheet::setContentHeight(int height)
{
    const int below = buttons.empty() ? 0 : buttonHeight + 2 * grid;
    const int wanted = std::min(wantedHeight, 2 * 2 * grid + titleHeight + height + below);
    if (std::exchange(shownHeight, wanted) == wanted)
        return;
    resized();
    repaint();
}

void Sheet::standAside()
{
    aside = true;
    resized();
    repaint();
}

void Sheet::close()
{
    if (onClose)
        onClose();
}

bool Sheet::keyPressed(const juce::KeyPress& key)
{
    if ((onKey && onKey(key)) || enterByTab(*this, key))
        return true;
    if (key == juce::KeyPress::escapeKey)
        close();
    else if (key == juce::KeyPress::returnKey && !buttons.empty() && buttons.front()->isEnabled())
        buttons.front()->triggerClick();
    // Nothing else behind a sheet hears keys, but Tab goes on.
    return key.getKeyCode() != juce::KeyPress::tabKey;
}

namespace
{
constexpr int messageWidth = 560;

/// The height of a message, so that a short one does not scroll.
int messageHeight(const juce::String& text)
{
    constexpr int least = 26 * grid, most = 60 * grid;
    constexpr int around = 16 * grid; // title, answers and margins
    constexpr float beside = 8.0f * grid;
    juce::AttributedString words;
    words.append(withLineBreaks(text, usualFont(), messageWidth - beside), usualFont());
    juce::TextLayout layout;
    layout.createLayout(words, messageWidth - beside);
    return juce::jlimit(least, most, around + static_cast<int>(layout.getHeight()) + grid);
}
} // namespace

MessageSheet::MessageSheet(const juce::String& title, const juce::String& text, std::vector<Answer> answers)
    : Sheet(translateMessage(title), messageWidth, messageHeight(translateMessage(text)))
{
    words.setMultiLine(true);
    words.setReadOnly(true);
    words.setCaretVisible(false);
    words.setScrollbarsShown(true);
    words.setColour(juce::TextEditor::backgroundColourId, juce::Colours::transparentBlack);
    words.setColour(juce::TextEditor::outlineColourId, juce::Colours::transparentBlack);
    words.setColour(juce::TextEditor::focusedOutlineColourId, juce::Colours::transparentBlack);
    words.setFont(usualFont());
    words.setBorder({});
    words.setIndents(0, 4); // below its title
    words.setText(translateMessage(text), juce::dontSendNotification);
    words.setTitle(translateMessage(title));
    words.setWantsKeyboardFocus(false);
    addAndMakeVisible(words);
    setAnswers(std::move(answers));
    setDescription(translateMessage(text));
}

void MessageSheet::layOut(juce::Rectangle<int> area)
{
    words.setBounds(area);
    words.applyColourToAllText(paletteFor(*this).text);
}

} // namespace pacini::editor
