// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/NameSheet.h"

#include "editor/Theme.h"

namespace pacini::editor
{

NameSheet::NameSheet(const juce::String& title, const juce::String& label, const juce::String& name,
                     std::function<void(const juce::String&)> named, const juce::String& answer)
    : Sheet(title, 440, 168), onNamed(std::move(named))
{
    field.setTitle(label);
    field.setFont(usualFont());
    field.setIndents(grid, 7);
    field.setSelectAllWhenFocused(true);
    field.setInputRestrictions(200);
    field.setText(name, false);
    field.onReturnKey = [this]
    {
        take();
    };
    field.onEscapeKey = [this]
    {
        close();
    };
    field.onTextChange = [this]
    {
        setAnswerEnabled(field.getText().trim().isNotEmpty());
    };
    addAndMakeVisible(field);
    setAnswers({{answer, {}}, {"Cancel", {}}});
    setAnswerEnabled(name.trim().isNotEmpty());
    setUsualAnswer([this] { take(); });
}

void NameSheet::take()
{
    const auto name = field.getText().trim();
    if (name.isEmpty())
        return;
    // What follows may put another sheet in place of this one.
    const auto named = onNamed;
    close();
    named(name);
}

void NameSheet::layOut(juce::Rectangle<int> area)
{
    field.setBounds(area.removeFromTop(4 * grid));
    field.applyColourToAllText(paletteFor(*this).text);
}

} // namespace pacini::editor
