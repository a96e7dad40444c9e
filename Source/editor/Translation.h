// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Translation of the interface to the user's language.

#include <juce_gui_basics/juce_gui_basics.h>

#include <cstddef>
#include <initializer_list>

namespace pacini::editor
{

/// What there is besides English, as codes of ISO 639-1: the files of Resources/translations, which are compiled in.
[[nodiscard]] juce::StringArray languages();

/// The name that a language gives itself.
[[nodiscard]] juce::String languageName(const juce::String& code);

/// Whether a font of this system has the characters of a language.
[[nodiscard]] bool canShow(const juce::String& code);

/// From now on: the language with this code, "en" for none, or the system's when it is empty. English when no font can
/// show it, which LanguageProblem.h tells. Windows that are open stay as they are. [message]
void useLanguage(const juce::String& code);

/// The code that useLanguage() was last given; empty: the system's language.
[[nodiscard]] juce::String languageAskedFor();

/// The code that the system's language begins with, of which there may be no texts.
[[nodiscard]] juce::String systemLanguage();

/// The same with a table as the files of Resources/translations have it.
void useTranslations(const juce::String& table);

/// The code of the language in use.
[[nodiscard]] juce::String languageInUse();

/// An English text in the language; itself where there is no translation.
[[nodiscard]] juce::String tr(const juce::String& english);

/// A template in the language, with `{0}`, `{1}`... replaced by values. Values are not translated.
[[nodiscard]] juce::String tr(const juce::String& english, std::initializer_list<juce::String> values);

/// "1 point", "3 points": one of two templates with the number as `{0}`.
[[nodiscard]] juce::String counted(std::size_t number, const juce::String& one, const juce::String& many);

/// A rounded number, with the decimal mark of the language. All numbers that windows show are made here or pass
/// withDecimalMark().
[[nodiscard]] juce::String numberText(double value, int decimals);

/// A text of one or several numbers with decimal points, such as "-3.5 dB" or "0.1 to 2.5 s", with the decimal mark of
/// the language. Points that are not between two digits, and those of "1.2.3", stay.
[[nodiscard]] juce::String withDecimalMark(const juce::String& text);

/// What was typed in a window with decimal points, as numbers are read. A point or a comma counts in every language.
[[nodiscard]] juce::String withDecimalPoint(const juce::String& typed);

/// A text that was put together in English by code without windows (documents, writers of formats): whole, by a
/// template of the table that it fits, or line by line. `{0:text}` in a template stands for a value that is translated
/// in turn. What comes before ": " may be a name. Costs a search of the table: not for painting.
[[nodiscard]] juce::String translateMessage(const juce::String& english);

/// Translates what a component and all inside it say: names, descriptions, tooltips, buttons, labels that are not
/// edited, choices and tabs. What is put together or drawn while the program runs is up to who does that. Twice does no
/// harm.
void translateTexts(juce::Component& root);

} // namespace pacini::editor
