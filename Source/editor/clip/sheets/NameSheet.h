// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog for a name.

#include "editor/clip/sheets/Sheet.h"

#include <functional>

namespace pacini::editor
{

/// Asks for a name. An empty one is not taken.
class NameSheet final : public Sheet
{
public:
    /// `answer` is the text of the button.
    NameSheet(const juce::String& title, const juce::String& label, const juce::String& name,
              std::function<void(const juce::String&)> named, const juce::String& answer = "Rename");

private:
    void layOut(juce::Rectangle<int> area) override;
    juce::Component* firstFocus() override { return &field; }
    void take();

    juce::TextEditor field;
    std::function<void(const juce::String&)> onNamed;
};

} // namespace pacini::editor
