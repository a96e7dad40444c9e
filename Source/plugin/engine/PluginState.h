// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plugin state: what a host's session keeps of the plugin, as JSON.

#include "plugin/engine/ParameterValues.h"

#include <pacini/actuator/Profile.h>
#include <pacini/foundation/Result.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace pacini::plugin
{

inline constexpr std::string_view stateFormatName = "pacini.plugin";
inline constexpr int stateFormatVersion = 1;

/// Longer states are refused.
inline constexpr std::size_t largestState = std::size_t(64) << 20;

struct PluginState
{
    ParameterValues values;
    std::optional<Profile> profile; ///< the content of the chosen one, so that a session sounds the same for ever
    /// Likewise those of the haptic channels behind the first; none for one that follows that.
    std::array<std::optional<Profile>, maxHapticChannels - 1> furtherProfiles;
    int program = 0;
    std::string clips;   ///< the project of the clip editor, as text; empty: none
    int windowWidth = 0; ///< 0: as it comes
    int windowHeight = 0;
    bool keepsCaptures = true; ///< captured clips keep their sound
    bool operator==(const PluginState&) const = default;
};

/// JSON. Values by the ids of the parameters, in their units.
[[nodiscard]] std::string stateText(const PluginState& state);

/// A state, and the defects that were ignored.
struct ReadState
{
    PluginState state;
    std::string note; ///< empty: nothing
};

/// Reads a state of any version up to this one. A parameter that it does not name has its default, or the value that
/// sounds as before there was one (strength: 0); one that is unknown is ignored, values are limited to their ranges.
/// Errors: invalidData for what is no state, unsupportedVersion for one from the future, tooLarge; nothing of it is to
/// be used then.
[[nodiscard]] Result<ReadState> readState(std::string_view text);

} // namespace pacini::plugin
