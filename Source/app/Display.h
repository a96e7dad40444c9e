// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Check that there is a screen before the first window is made.

#include <juce_gui_basics/juce_gui_basics.h>

#include <cstdio>

namespace pacini::app
{

/// Whether there is a screen. Without one JUCE cannot create a window: prints an error; the program then has to end
/// with code 1, before it has written anything. [message]
[[nodiscard]] inline bool hasDisplay(const char* program)
{
    if (!juce::Desktop::getInstance().isHeadless())
        return true;
    std::fprintf(stderr,
                 "%s: there is no display to open a window on; start it in a desktop session or set DISPLAY. The "
                 "command pacini works without one.\n",
                 program);
    return false;
}

} // namespace pacini::app
