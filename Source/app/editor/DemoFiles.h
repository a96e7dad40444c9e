// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Demo sounds and sample project, embedded in the program.

#include <juce_core/juce_core.h>

#include <filesystem>
#include <vector>

namespace pacini::app
{

/// Writes the files of Resources/demo to `folder`, which it creates; intact files are kept. Returns the paths of the
/// sounds in alphabetical order; the sample project is beside them. Empty if writing fails.
[[nodiscard]] std::vector<std::filesystem::path> putDemoFiles(const juce::File& folder);

} // namespace pacini::app
