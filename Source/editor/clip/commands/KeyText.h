// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Text of a keyboard shortcut, as menus, tooltips and lists show it.

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

/// "Ctrl+Shift+Z", "Ctrl+←": in the user's language, with the symbols of the system (⌘ ⇧ ⌥ on a Mac); empty for no key.
[[nodiscard]] juce::String keyText(const juce::KeyPress& key);

} // namespace pacini::editor
