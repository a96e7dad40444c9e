// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Line breaks of languages that have no spaces: JUCE's text layouts break at spaces only.

#include <juce_graphics/juce_graphics.h>

namespace pacini::editor
{

/// The text with breaks before what would be wider than `width` pixels. Lines without Japanese stay as they are. No
/// line begins with a mark that closes something (kinsoku).
[[nodiscard]] inline juce::String withLineBreaks(const juce::String& text, const juce::Font& font, float width)
{
    constexpr juce::juce_wchar firstWide = 0x3000;
    static const juce::String closing(juce::CharPointer_UTF8(
        "\xe3\x80\x81\xe3\x80\x82\xef\xbc\x89\xe3\x80\x8d\xe3\x80\x8f\xe3\x83\xbc\xe3\x80\x85\xef\xbc\x81\xef\xbc\x9f"
        "\xe3\x83\xbb)")); // 、。）」』ー々！？・)
    juce::StringArray lines;
    for (const auto& line : juce::StringArray::fromLines(text))
    {
        juce::String current;
        int breakAt = 0; // letters before the last place that allows a break; 0: none does
        juce::juce_wchar before = 0;
        for (auto at = line.getCharPointer(); !at.isEmpty();)
        {
            const auto letter = at.getAndAdvance();
            const bool between = letter >= firstWide || before >= firstWide;
            if (current.isNotEmpty() && between && !closing.containsChar(letter))
                breakAt = current.length();
            current += juce::String::charToString(letter);
            if (breakAt > 0 && font.getStringWidthFloat(current) > width)
            {
                lines.add(current.substring(0, breakAt));
                current = current.substring(breakAt);
                breakAt = 0;
            }
            before = letter;
        }
        lines.add(current);
    }
    return lines.joinIntoString("\n");
}

} // namespace pacini::editor
