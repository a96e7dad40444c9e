// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a window opens: inside the screen that there is now.

#include <juce_graphics/juce_graphics.h>

#include <algorithm>

namespace pacini::app
{

/// Borders that the window manager adds, before it has told them.
inline constexpr int usualTitleBar = 32;

/// `wanted`, without its borders, moved and where need be shrunk into `screen`, which has room for the borders, too.
[[nodiscard]] inline juce::Rectangle<int> insideOf(juce::Rectangle<int> screen, juce::Rectangle<int> wanted) noexcept
{
    const auto room = screen.withTrimmedTop(std::min(usualTitleBar, screen.getHeight() / 4));
    return wanted.withSize(std::min(wanted.getWidth(), room.getWidth()), std::min(wanted.getHeight(), room.getHeight()))
        .constrainedWithin(room);
}

/// Whether a window covers its screen but for the window manager's borders: it was maximised.
[[nodiscard]] inline bool fills(juce::Rectangle<int> screen, juce::Rectangle<int> window) noexcept
{
    constexpr int border = 8;
    return window.getWidth() >= screen.getWidth() - border &&
           window.getHeight() >= screen.getHeight() - usualTitleBar - border;
}

} // namespace pacini::app
