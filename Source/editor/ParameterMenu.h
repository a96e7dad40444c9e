// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Context menu of a control for a parameter: by right click, or by Shift+F10 and the menu key.

#include <juce_audio_processors/juce_audio_processors.h>

#include <functional>

namespace pacini::editor
{

/// Whether a key asks for the context menu.
[[nodiscard]] bool isContextMenuKey(const juce::KeyPress& key);

/// Reset, `type` where a value can be typed, and what the host offers for the parameter; `host` may be null.
[[nodiscard]] juce::PopupMenu parameterMenu(juce::AudioProcessorParameter& parameter, std::function<void()> type,
                                            const juce::AudioProcessorEditorHostContext* host);

/// Shows it for a control in the editor of a processor, or elsewhere, where there is no host.
void showParameterMenu(juce::Component& control, juce::AudioProcessorParameter& parameter, std::function<void()> type,
                       bool atPointer);

} // namespace pacini::editor
