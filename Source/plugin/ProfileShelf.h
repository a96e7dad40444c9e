// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The actuator profiles that come with the plugin, compiled in.

#include "editor/clip/session/Session.h"

#include <pacini/actuator/Profile.h>

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace pacini::plugin
{

/// The file name, without its ending, of the profile in a slot; empty for a free slot.
[[nodiscard]] std::string_view profileNameOf(std::size_t slot) noexcept;

/// Reads the profile in a slot; none for a free slot. Not for the audio thread. [any]
[[nodiscard]] std::optional<Profile> shelfProfile(std::size_t slot);

/// All of them. Not for the audio thread. [any]
[[nodiscard]] std::vector<editor::NamedProfile> shelfProfiles();

} // namespace pacini::plugin
