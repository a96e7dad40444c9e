// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Work in the background that can be watched and stopped.

#include <juce_core/juce_core.h>

#include <atomic>

namespace pacini::editor
{

/// Shared by the thread that works and the message thread.
struct Task
{
    std::atomic<double> progress{-1.0}; ///< 0 to 1; below 0: nobody knows
    std::atomic<bool> stopped{false};

    /// For analyse(). [worker]
    bool goOn(double done) noexcept
    {
        progress = done;
        return !stopped;
    }
};

/// What is going on, for a bar.
struct WorkState
{
    juce::String text;
    double progress = -1.0; ///< as in Task
    bool operator==(const WorkState&) const = default;
};

} // namespace pacini::editor
