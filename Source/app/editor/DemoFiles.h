// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Demo sounds and sample project, which are inside of the program.

#include <juce_core/juce_core.h>

#include <filesystem>
#include <vector>

namespace pacini::app
{

/// Puts the files of Resources/demo into `folder`, which is made; those that are there as they should be are left. The
/// paths of the sounds in alphabetical order; the sample project is beside them. Empty where nothing can be written.
[[nodiscard]] std::vector<std::filesystem::path> putDemoFiles(const juce::File& folder);

} // namespace pacini::app
