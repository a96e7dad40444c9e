#pragma once

// A language in which every text of the tables is marked, and a walk that finds texts which are not.

#include "editor/Text.h"
#include "editor/Translation.h"
#include "support/Paths.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <fstream>
#include <string>

namespace pacini::test
{

/// Marks all texts of the German table; English again at the end.
struct MarkedLanguage
{
    MarkedLanguage()
    {
        std::ifstream file(sourceFolder() / "Resources/translations/de.txt", std::ios::binary);
        std::string table;
        for (std::string line; std::getline(file, line);)
            if (!line.empty() && line.front() == '"')
            {
                const std::string key = line.substr(1, line.find("\" = \"") - 1);
                table += "\"" + key + "\" = \"\xe2\x9f\xa6" + key + "\xe2\x9f\xa7\"\n";
            }
        editor::useTranslations(editor::toText(table));
    }
    ~MarkedLanguage() { editor::useLanguage("en"); }
};

/// What a text says outside of marks, in words of three letters and more.
inline juce::StringArray unmarkedWords(const juce::String& text, const juce::StringArray& names)
{
    juce::String outside;
    int depth = 0;
    for (auto at = text.getCharPointer(); !at.isEmpty();)
    {
        const juce::juce_wchar c = at.getAndAdvance();
        if (c == 0x27e6)
            ++depth;
        else if (c == 0x27e7)
            --depth;
        else if (depth == 0)
            outside += c;
    }
    for (const auto& name : names)
        outside = outside.replace(name, " ");
    juce::StringArray words;
    juce::String word;
    for (auto at = outside.getCharPointer();;)
    {
        const juce::juce_wchar c = at.getAndAdvance();
        if (juce::CharacterFunctions::isLetter(c))
        {
            word += c;
            continue;
        }
        if (word.length() > 2)
            words.add(word);
        word = {};
        if (c == 0)
            return words;
    }
}

/// All texts of a component and of those inside that have words without a mark. `names` are what things are called:
/// clips, files, devices, units.
inline void addUnmarked(juce::Component& root, const juce::StringArray& names, juce::StringArray& found)
{
    const auto look = [&](const juce::String& text)
    {
        // A path of a file is no text.
        if (!text.startsWithChar('/') && !unmarkedWords(text, names).isEmpty())
            found.addIfNotAlreadyThere(text);
    };
    look(root.getTitle());
    look(root.getDescription());
    look(root.getHelpText());
    if (auto* tip = dynamic_cast<juce::SettableTooltipClient*>(&root))
        look(tip->getTooltip());
    if (auto* button = dynamic_cast<juce::Button*>(&root))
        look(button->getButtonText());
    if (auto* label = dynamic_cast<juce::Label*>(&root))
        look(label->getText());
    if (auto* text = dynamic_cast<juce::TextEditor*>(&root); text != nullptr && text->isReadOnly())
        look(text->getText());
    if (auto* box = dynamic_cast<juce::ComboBox*>(&root))
    {
        for (int i = 0; i < box->getNumItems(); ++i)
            look(box->getItemText(i));
        look(box->getTextWhenNothingSelected());
    }
    if (auto* tabs = dynamic_cast<juce::TabbedComponent*>(&root))
        for (int i = 0; i < tabs->getNumTabs(); ++i)
        {
            look(tabs->getTabNames()[i]);
            if (auto* page = tabs->getTabContentComponent(i))
                addUnmarked(*page, names, found);
        }
    for (auto* child : root.getChildren())
        addUnmarked(*child, names, found);
}

inline void addUnmarked(const juce::PopupMenu& menu, const juce::StringArray& names, juce::StringArray& found)
{
    juce::PopupMenu::MenuItemIterator items(menu, true);
    while (items.next())
        if (!unmarkedWords(items.getItem().text, names).isEmpty())
            found.addIfNotAlreadyThere(items.getItem().text);
}

} // namespace pacini::test
