// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plugin state: what a host's session keeps of the plugin, as JSON.

#include "document/SettingsPresets.h"
#include "plugin/engine/EditHistory.h"
#include "plugin/engine/ParameterValues.h"

#include <pacini/actuator/Profile.h>
#include <pacini/foundation/Result.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::plugin
{

inline constexpr std::string_view stateFormatName = "pacini.plugin";
inline constexpr int stateFormatVersion = 1;

/// Longer states are refused.
inline constexpr std::size_t largestState = std::size_t(64) << 20;

/// The sides of a comparison.
enum class Side
{
    a,
    b
};
[[nodiscard]] constexpr Side otherOf(Side side) noexcept
{
    return side == Side::a ? Side::b : Side::a;
}

/// The settings of one of the two sides of a comparison.
struct PluginSettings
{
    ParameterValues values;
    std::optional<Profile> profile; ///< the content of the chosen one, so that a session sounds the same for ever
    /// Likewise those of the haptic channels behind the first; none for one that follows that.
    std::array<std::optional<Profile>, maxHapticChannels - 1> furtherProfiles;
    PresetChoice preset;
    bool operator==(const PluginSettings&) const = default;
};

/// The settings in use, and the other content of a session.
struct PluginState : PluginSettings
{
    Side side = Side::a;                 ///< the one that is in use
    std::optional<PluginSettings> other; ///< settings of the other side; none: it was never used
    std::string clips;                   ///< the project of the clip editor, as text; empty: none
    int windowWidth = 0;                 ///< 0: the default size
    int windowHeight = 0;
    bool keepsCaptures = true; ///< captured clips keep their sound
    std::string controller;    ///< name of the one that plays along; empty: none
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

/// Reads a state of any version up to this one. A missing parameter gets its default, or the value that sounds like
/// versions without it (strength: 0). Unknown parameters are ignored, values are limited to their ranges. Errors:
/// invalidData for other content, unsupportedVersion for newer versions, tooLarge; no part of the state may be used
/// then.
[[nodiscard]] Result<ReadState> readState(std::string_view text);

/// A preset of the user; as the shipped ones it leaves routing, actuators and bypass as they are.
struct UserPreset
{
    std::string name;
    TranslatorParams params;
};

/// The live parameters in a settings file, see readLiveSettings(), or in a state, which presets of earlier versions
/// and whole sessions are. Errors as there and in readState(), and invalidData for a state with defects: a preset is
/// used as a whole or not at all.
[[nodiscard]] Result<TranslatorParams> readPreset(std::string_view text);

/// Presets in a folder.
struct PresetListing
{
    std::vector<UserPreset> presets; ///< by name
    std::vector<Error> broken;       ///< files that cannot be used, `where` their names
};
[[nodiscard]] PresetListing presetsIn(const SettingsPresets& files);

} // namespace pacini::plugin
