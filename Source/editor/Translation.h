// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Translation of the interface to the user's language.

#include <juce_gui_basics/juce_gui_basics.h>

#include <cstddef>

namespace pacini::editor
{

/// What there is besides English, as codes of ISO 639-1: the files of Resources/translations, which are compiled in.
[[nodiscard]] juce::StringArray languages();

/// The name that a language gives itself.
[[nodiscard]] juce::String languageName(const juce::String& code);

/// From now on: the language with this code, "en" for none, or the system's when it is empty. Windows that are open
/// stay as they are. [message]
void useLanguage(const juce::String& code);

/// An English text in the language; itself where there is no translation.
[[nodiscard]] juce::String tr(const juce::String& english);

/// "1 point", "3 points": a number and its word, of which both are translated.
[[nodiscard]] juce::String counted(std::size_t number, const juce::String& one, const juce::String& many);

/// Translates what a component and all inside it say: names, descriptions, tooltips, buttons, labels that are not
/// edited, choices and tabs. What is put together or drawn while the program runs is up to who does that. Twice does no
/// harm.
void translateTexts(juce::Component& root);

} // namespace pacini::editor
