// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What keeps a language from being shown, and where that is told.

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

/// The name that a choice of languages shows: in the language itself, or with what it lacks where no font can show it.
[[nodiscard]] juce::String languageChoice(const juce::String& code);

/// What has to be done before a language can be shown, in the language in use; empty where it can be.
[[nodiscard]] juce::String missingFont(const juce::String& code);

/// Why the language that useLanguage() was last asked for is not in use; empty where it is. That there are no texts in
/// the system's language is no problem.
[[nodiscard]] juce::String languageProblem();

/// Prints languageProblem(), if there is one, on the terminal. `program` is the name of what was started. [message]
void tellLanguageProblem(const char* program);

} // namespace pacini::editor
