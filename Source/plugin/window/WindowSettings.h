// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Settings of the plugin's windows, the same for all sessions and hosts of a user.

#include <juce_data_structures/juce_data_structures.h>

#include <array>

namespace pacini::plugin
{

/// Returns the folder of the user's files of the plugin, at the usual place of each system.
[[nodiscard]] juce::File usualUserFolder();

/// The scale depends on the screen and the eyes in front of it, not on the piece of music: so it is no part of a
/// session. Read when a window opens, written when something is chosen. [message]
class WindowSettings
{
public:
    static constexpr std::array<int, 6> scales{75, 100, 125, 150, 175, 200}; ///< %

    explicit WindowSettings(const juce::File& folder);

    /// One of `scales`; 100 where nothing, or nothing of use, was chosen.
    [[nodiscard]] int scale() const;
    void setScale(int percent);

private:
    juce::PropertiesFile file;
};

} // namespace pacini::plugin
