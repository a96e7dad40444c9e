// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Stored settings and command-line options of the standalone program.

#include "app/AudioDevices.h"

#include <juce_data_structures/juce_data_structures.h>

#include <optional>
#include <string>
#include <vector>

namespace pacini::app
{

/// Choices of the command line, see `--help`.
struct CommandLineChoices
{
    bool fresh = false;
    bool testSignal = false;
    juce::String deviceType;
    juce::File file;
    std::vector<int> hapticOutputs; ///< of each channel from the first on, from 0, -1: none; empty: as remembered
    std::optional<int> soundOutput; ///< likewise
    std::optional<std::string> controller; ///< empty: none; nothing: as remembered
};

/// Returns the code to end with where the program is not to start: see readCommandLine().
[[nodiscard]] std::optional<int> readCommandLine(CommandLineChoices& choices, const juce::StringArray& arguments);

/// Reads the stored routing; defaults for missing settings.
[[nodiscard]] Routing routingOf(juce::PropertiesFile& settings);
void remember(juce::PropertiesFile& settings, const Routing& routing);

} // namespace pacini::app
