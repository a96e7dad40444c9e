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

/// The factor, 1 or less, by which a window is drawn that has at least the size `least`, without its borders, and would
/// not fit on the screen.
[[nodiscard]] inline float scaleThatFits(juce::Rectangle<int> screen, juce::Point<float> least) noexcept
{
    const auto room = screen.withTrimmedTop(std::min(usualTitleBar, screen.getHeight() / 4)).toFloat();
    return std::min({1.0f, room.getWidth() / std::max(1.0f, least.x), room.getHeight() / std::max(1.0f, least.y)});
}

/// Whether a window covers its screen but for the window manager's borders: it was maximised.
[[nodiscard]] inline bool fills(juce::Rectangle<int> screen, juce::Rectangle<int> window) noexcept
{
    constexpr int border = 8;
    return window.getWidth() >= screen.getWidth() - border &&
           window.getHeight() >= screen.getHeight() - usualTitleBar - border;
}

} // namespace pacini::app
