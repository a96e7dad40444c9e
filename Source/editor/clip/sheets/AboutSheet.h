// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog with version, licence and sources of the program.

#include "editor/clip/sheets/Sheet.h"

#include <memory>

namespace pacini::editor
{

[[nodiscard]] std::unique_ptr<Sheet> aboutSheet(const juce::String& version);

} // namespace pacini::editor
