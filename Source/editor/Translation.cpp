// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/Translation.h"

#include "TranslationData.h"
#include "editor/Text.h"

#include <memory>

namespace pacini::editor
{

namespace
{
juce::String textOfFile(const juce::String& code)
{
    for (int i = 0; i < translationData::namedResourceListSize; ++i)
    {
        const char* resource = translationData::namedResourceList[i];
        if (code + ".txt" != translationData::getNamedResourceOriginalFilename(resource))
            continue;
        int size = 0;
        const char* data = translationData::getNamedResource(resource, size);
        return toText({data, static_cast<std::size_t>(size)});
    }
    return {};
}

void translateItems(juce::ComboBox& box)
{
    for (int i = 0; i < box.getNumItems(); ++i)
        if (const int id = box.getItemId(i); id != 0)
            box.changeItemText(id, tr(box.getItemText(i)));
    if (const int chosen = box.getSelectedId(); chosen != 0)
    {
        // The box shows a copy of the text.
        box.setSelectedId(0, juce::dontSendNotification);
        box.setSelectedId(chosen, juce::dontSendNotification);
    }
}
} // namespace

juce::StringArray languages()
{
    juce::StringArray codes;
    for (int i = 0; i < translationData::namedResourceListSize; ++i)
        codes.add(juce::String(translationData::getNamedResourceOriginalFilename(translationData::namedResourceList[i]))
                      .upToFirstOccurrenceOf(".", false, false));
    codes.sort(false);
    return codes;
}

juce::String languageName(const juce::String& code)
{
    return code == "en" ? juce::String("English") : juce::LocalisedStrings(textOfFile(code), false).getLanguageName();
}

void useLanguage(const juce::String& code)
{
    const juce::String wanted = code.isNotEmpty() ? code : juce::SystemStats::getUserLanguage();
    const juce::String text = textOfFile(wanted.substring(0, 2).toLowerCase());
    juce::LocalisedStrings::setCurrentMappings(
        text.isEmpty() ? nullptr : std::make_unique<juce::LocalisedStrings>(text, false).release());
}

juce::String tr(const juce::String& english)
{
    return english.isEmpty() ? english : juce::translate(english);
}

juce::String counted(std::size_t number, const juce::String& one, const juce::String& many)
{
    return juce::String(static_cast<juce::int64>(number)) + " " + tr(number == 1 ? one : many);
}

void translateTexts(juce::Component& root)
{
    root.setTitle(tr(root.getTitle()));
    root.setDescription(tr(root.getDescription()));
    root.setHelpText(tr(root.getHelpText()));
    if (auto* tip = dynamic_cast<juce::SettableTooltipClient*>(&root))
        tip->setTooltip(tr(tip->getTooltip()));
    if (auto* button = dynamic_cast<juce::Button*>(&root))
        button->setButtonText(tr(button->getButtonText()));
    if (auto* label = dynamic_cast<juce::Label*>(&root); label != nullptr && !label->isEditable())
        label->setText(tr(label->getText()), juce::dontSendNotification);
    if (auto* box = dynamic_cast<juce::ComboBox*>(&root))
        translateItems(*box);
    if (auto* tabs = dynamic_cast<juce::TabbedComponent*>(&root))
        for (int i = 0; i < tabs->getNumTabs(); ++i)
        {
            tabs->setTabName(i, tr(tabs->getTabNames()[i]));
            // Pages that are not in front are children of nobody.
            if (auto* page = tabs->getTabContentComponent(i))
                translateTexts(*page);
        }
    for (auto* child : root.getChildren())
        translateTexts(*child);
}

} // namespace pacini::editor
