// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Names of undo steps: what they change, how much of it, and how that reads in the user's language.

#include "document/SelectionEdits.h"

#include <juce_core/juce_core.h>

#include <string>

namespace pacini::editor
{

/// Kind of change to points and transients.
enum class SelectionStep
{
    move,
    remove,
    scale,
    setValue,
    setSharpness
};

/// "Move point", "Move 3 points", "Move 2 events", "Move 5 points and events".
[[nodiscard]] std::string stepName(SelectionStep step, const Selection& changed);

/// The name of a step in the language of the window.
[[nodiscard]] juce::String stepText(const std::string& name);

/// "Undo move 3 points" of "Undo {0}"; `command` alone where there is no step.
[[nodiscard]] juce::String commandWithStep(const char* command, const char* pattern, const std::string& name);

} // namespace pacini::editor
