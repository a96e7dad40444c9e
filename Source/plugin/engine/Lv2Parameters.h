// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Description of the parameters for LV2 hosts (Turtle), made from parameterTable.

#include <pacini/foundation/Result.h>

#include <string>
#include <string_view>

namespace pacini::plugin
{

/// Returns the plugin description of JUCE's generator (dsp.ttl) with new descriptions of its parameters: JUCE maps the
/// choices of each to 0 to 1, whatever its range. Errors if a parameter is missing in it, or unknown.
[[nodiscard]] Result<std::string> describeLv2Parameters(std::string_view turtle);

/// Returns the window's description of JUCE's generator (ui.ttl) without the statements that LV2 does not know.
[[nodiscard]] std::string describeLv2Window(std::string_view turtle);

} // namespace pacini::plugin
