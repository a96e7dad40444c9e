#pragma once

// The actuator profiles that come with Pacini, compiled in.

#include <pacini/actuator/Profile.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// An actuator that can be chosen.
struct NamedProfile
{
    std::string name; ///< such as l5-wristband
    std::shared_ptr<const Profile> profile;
    bool own = false; ///< not one of those that come with Pacini: projects carry it with them
};

/// The file name, without its ending, of the profile in a slot (the plugin's parameter); empty for a free slot.
[[nodiscard]] std::string_view profileNameOf(std::size_t slot) noexcept;

/// Reads the profile in a slot; none for a free slot. Not for the audio thread. [any]
[[nodiscard]] std::optional<Profile> builtInProfile(std::size_t slot);

/// All of them. Not for the audio thread. [any]
[[nodiscard]] std::vector<NamedProfile> builtInProfiles();

} // namespace pacini
