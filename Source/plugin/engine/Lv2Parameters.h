// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Description of the parameters for LV2 hosts (Turtle), made from parameterTable.

#include <pacini/foundation/Result.h>

#include <string>
#include <string_view>

namespace pacini::plugin
{

/// The description of the plugin that JUCE's generator wrote (dsp.ttl), with its parameters described anew: JUCE puts
/// the choices of each on 0 to 1, whatever its range is. Error where it has no parameter of the table, or others.
[[nodiscard]] Result<std::string> describeLv2Parameters(std::string_view turtle);

} // namespace pacini::plugin
