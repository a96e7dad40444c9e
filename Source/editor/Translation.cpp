// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/Translation.h"

#include "TranslationData.h"
#include "editor/Text.h"
#include "editor/Theme.h"

#include <pacini/foundation/NumberText.h>

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace pacini::editor
{

namespace
{
/// A message with values in it, such as `Gain of {0} dB`.
struct Template
{
    juce::String key;
    juce::StringArray fixed;      ///< what stands between the values; may be empty at the ends
    juce::StringArray names;      ///< of the values
    std::vector<bool> translated; ///< whether a value is a text of the table, too
    int letters = 0;              ///< fixed ones: of two templates that fit, the more specific one counts

    /// Whether a text that fits is this one: "{0} of {1}" would fit half of all sentences.
    [[nodiscard]] bool isSpecific() const
    {
        constexpr int enough = 10;
        return letters >= enough || (letters > 0 && juce::CharacterFunctions::isLetter(fixed[0][0]));
    }
};

struct Table
{
    juce::String code = "en";
    std::unordered_map<juce::String, juce::String> texts;
    std::vector<Template> templates;
};

juce::String& askedFor()
{
    static juce::String code;
    return code;
}

Table& tableNow()
{
    static Table table;
    return table;
}

Template templateOf(const juce::String& key)
{
    Template made;
    made.key = key;
    juce::String rest = key;
    while (rest.containsChar('{') && rest.containsChar('}'))
    {
        made.fixed.add(rest.upToFirstOccurrenceOf("{", false, false));
        const auto inside = rest.fromFirstOccurrenceOf("{", false, false).upToFirstOccurrenceOf("}", false, false);
        made.names.add(inside.upToFirstOccurrenceOf(":", false, false));
        made.translated.push_back(inside.endsWith(":text"));
        rest = rest.fromFirstOccurrenceOf("}", false, false);
    }
    made.fixed.add(rest);
    for (const auto& part : made.fixed)
        for (int i = 0; i < part.length(); ++i)
            made.letters += juce::CharacterFunctions::isLetter(part[i]) ? 1 : 0;
    return made;
}

juce::String filled(juce::String text, const juce::StringArray& names, const juce::StringArray& values)
{
    juce::String result;
    while (text.containsChar('{'))
    {
        const auto inside = text.fromFirstOccurrenceOf("{", false, false).upToFirstOccurrenceOf("}", false, false);
        const int which = names.indexOf(inside.upToFirstOccurrenceOf(":", false, false));
        result << text.upToFirstOccurrenceOf("{", false, false) << (which >= 0 ? values[which] : "{" + inside + "}");
        text = text.fromFirstOccurrenceOf("}", false, false);
    }
    return result + text;
}

/// The values of a template in a text that fits.
std::optional<juce::StringArray> valuesOf(const Template& wanted, const juce::String& text)
{
    if (!text.startsWith(wanted.fixed[0]))
        return std::nullopt;
    juce::StringArray values;
    int at = wanted.fixed[0].length();
    for (int i = 1; i < wanted.fixed.size(); ++i)
    {
        const auto& next = wanted.fixed[i];
        const bool last = i + 1 == wanted.fixed.size();
        const int found = last ? text.length() - next.length() : text.indexOf(at, next);
        // What may follow at the end, such as advice, may be missing.
        const bool isOptional = last && next.isEmpty() && wanted.translated[static_cast<std::size_t>(i - 1)];
        if (found < at || (found == at && !isOptional) || (last && !text.endsWith(next)) || (next.isEmpty() && !last))
            return std::nullopt;
        // A number or a name is within a line: what has several is translated line by line.
        if (!wanted.translated[static_cast<std::size_t>(i - 1)] && text.substring(at, found).containsChar('\n'))
            return std::nullopt;
        values.add(text.substring(at, found));
        at = found + next.length();
    }
    return values;
}

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

/// The code of the system's language with more behind it. On Linux JUCE has the English name of the locale's
/// language, of which "Ge" is left.
juce::String systemLocale()
{
#if JUCE_LINUX || JUCE_BSD
    for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"})
        if (auto value = juce::SystemStats::getEnvironmentVariable(name, {}); value.isNotEmpty())
            return value;
    return {};
#else
    return juce::SystemStats::getUserLanguage();
#endif
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

bool canShow(const juce::String& code)
{
    return code != "ja" || findJapaneseFont();
}

void useTranslations(const juce::String& text)
{
    const juce::LocalisedStrings read(text, false);
    Table& table = tableNow();
    table = {};
    const juce::StringPairArray& pairs = read.getMappings();
    for (int i = 0; i < pairs.size(); ++i)
    {
        const juce::String& key = pairs.getAllKeys()[i];
        table.texts[key] = pairs.getAllValues()[i];
        if (key.containsChar('{'))
            table.templates.push_back(templateOf(key));
    }
    // JUCE looks here for what its own components say.
    juce::LocalisedStrings::setCurrentMappings(
        table.texts.empty() ? nullptr : std::make_unique<juce::LocalisedStrings>(text, false).release());
}

void useLanguage(const juce::String& code)
{
    askedFor() = code;
    const auto wanted = code.isNotEmpty() ? code.substring(0, 2).toLowerCase() : systemLanguage();
    const juce::String text = canShow(wanted) ? textOfFile(wanted) : juce::String();
    useTranslations(text);
    if (text.isNotEmpty())
        tableNow().code = wanted;
    useFontOf(tableNow().code);
}

juce::String languageAskedFor()
{
    return askedFor();
}

juce::String systemLanguage()
{
    return systemLocale().substring(0, 2).toLowerCase();
}

juce::String languageInUse()
{
    return tableNow().code;
}

juce::String tr(const juce::String& english)
{
    const auto& texts = tableNow().texts;
    const auto found = texts.find(english);
    return found == texts.end() ? english : found->second;
}

juce::String tr(const juce::String& english, std::initializer_list<juce::String> values)
{
    juce::StringArray names, given;
    for (const auto& value : values)
    {
        names.add(juce::String(names.size()));
        given.add(value);
    }
    return filled(tr(english), names, given);
}

juce::String counted(std::size_t number, const juce::String& one, const juce::String& many)
{
    return tr(number == 1 ? one : many, {juce::String(static_cast<juce::int64>(number))});
}

namespace
{
/// Puts a mark in the place of another where it stands between two digits, once in each number.
juce::String withMark(const juce::String& text, juce::juce_wchar from, juce::juce_wchar to)
{
    if (from == to || !text.containsChar(from))
        return text;
    const auto isDigit = [&](int i)
    {
        return i >= 0 && i < text.length() && juce::CharacterFunctions::isDigit(text[i]);
    };
    const auto isIn = [&](int i)
    {
        return isDigit(i) || (i >= 0 && i < text.length() && text[i] == from);
    };
    juce::String result;
    for (int i = 0; i < text.length();)
    {
        if (!isIn(i))
        {
            result << juce::String::charToString(text[i++]);
            continue;
        }
        int end = i;
        while (isIn(end))
            ++end;
        const auto run = text.substring(i, end);
        const int mark = run.indexOfChar(from);
        const bool one = mark > 0 && mark + 1 < run.length() && run.lastIndexOfChar(from) == mark;
        result << (one ? run.replaceCharacter(from, to) : run);
        i = end;
    }
    return result;
}

juce::juce_wchar decimalMark()
{
    return tableNow().code == "de" ? ',' : '.';
}

/// "3.25", "-12.5 dB": numbers that code without windows has put into a message.
bool isNumber(const juce::String& value)
{
    const auto digits = value.trimCharactersAtStart("+-");
    const int end = digits.indexOfAnyOf(" %");
    const auto number = end < 0 ? digits : digits.substring(0, end);
    return number.isNotEmpty() && number.containsOnly("0123456789.") && (end < 0 || !digits.containsChar('/'));
}
} // namespace

juce::String numberText(double value, int decimals)
{
    return withDecimalMark(toText(decimalText(value, decimals)));
}

juce::String withDecimalMark(const juce::String& text)
{
    return withMark(text, '.', decimalMark());
}

juce::String withDecimalPoint(const juce::String& typed)
{
    return withMark(typed, ',', '.');
}

juce::String translateMessage(const juce::String& english)
{
    const Table& table = tableNow();
    if (table.texts.empty() || english.isEmpty())
        return english;
    if (const auto found = table.texts.find(english); found != table.texts.end())
        return found->second;
    const Template* best = nullptr;
    juce::StringArray values;
    for (const Template& one : table.templates)
        if (one.isSpecific() && (best == nullptr || one.letters > best->letters))
            if (auto fitting = valuesOf(one, english))
            {
                best = &one;
                values = std::move(*fitting);
            }
    if (best != nullptr)
    {
        for (int i = 0; i < values.size(); ++i)
            if (best->translated[static_cast<std::size_t>(i)])
                values.set(i, translateMessage(values[i]));
            else if (isNumber(values[i]))
                values.set(i, withDecimalMark(values[i]));
        return filled(table.texts.at(best->key), best->names, values);
    }
    if (english.containsChar('\n'))
    {
        auto lines = juce::StringArray::fromLines(english);
        for (auto& line : lines)
            line = translateMessage(line);
        return lines.joinIntoString("\n");
    }
    if (const int colon = english.indexOf(": "); colon > 0)
        return english.substring(0, colon + 2) + translateMessage(english.substring(colon + 2));
    juce::StringArray list = juce::StringArray::fromTokens(english, ",", {}); // "travel, heat"
    list.trim();
    for (auto& one : list)
    {
        if (table.texts.count(one) == 0)
            return english;
        one = tr(one);
    }
    return list.joinIntoString(", ");
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
