// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Parameters for CLAP hosts: what they are, their texts, and the events that change them.

#include "plugin/clap/Clap.h"
#include "plugin/engine/ParameterTable.h"
#include "plugin/engine/PluginProcessor.h"

#include <cstdint>
#include <string_view>

namespace pacini::plugin
{

/// The identifier of a parameter, for ever: a hash of its text id, as in VST3.
[[nodiscard]] constexpr clap_id clapIdOf(const ParameterRow& row) noexcept
{
    std::uint32_t hash = 0;
    for (const char c : std::string_view(row.id))
        hash = 31 * hash + static_cast<unsigned char>(c);
    return hash & 0x7fffffffu;
}

/// The parameter with an identifier; null if there is none.
[[nodiscard]] const ParameterRow* rowOfClapId(clap_id id) noexcept;

/// Whether hosts may modulate a parameter: all that move smoothly. Choices, switches and counts do not, nor does the
/// strength, each change of which fades the signal out and in.
[[nodiscard]] constexpr bool isModulatable(const ParameterRow& row) noexcept
{
    return !isDiscrete(row) && row.parameter != ParameterId::strength;
}

/// Description of a parameter. False if there is none at this index.
bool describeParameter(std::uint32_t index, clap_param_info_t& info) noexcept;

/// Text of a value, cut after a whole character where it does not fit. False for a value that is no number.
bool parameterText(clap_id id, double value, char* text, std::uint32_t capacity);
/// Value of a text that was typed. False for invalid text and values out of range.
bool parameterValue(clap_id id, const char* text, double& value);

/// Applies an event to the parameter that it names; ignores all other events and values that are no numbers. [audio]
void applyEvent(const PluginProcessor& processor, const clap_event_header_t& event) noexcept;

/// The extension `clap.params` of a plugin.
[[nodiscard]] const clap_plugin_params_t& paramsExtension() noexcept;

} // namespace pacini::plugin
