#pragma once

// The actuator profiles that come with Pacini: compiled in, and as files beside the program.

#include <pacini/actuator/Profile.h>
#include <pacini/foundation/Result.h>

#include <cstddef>
#include <filesystem>
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

/// Returns all shipped profiles. Not for the audio thread. [any]
[[nodiscard]] std::vector<NamedProfile> builtInProfiles();

/// The file of a profile.
struct ShippedProfile
{
    std::string name; ///< such as l5-wristband
    std::filesystem::path path;
};

/// The files NAME.json, by name, of the first folder that has any: `profiles` or `share/pacini/profiles` in `beside` or
/// in one of the five folders above it.
[[nodiscard]] std::vector<ShippedProfile> shippedProfiles(const std::filesystem::path& beside);

/// Finds the profile that the user named: a file, or the name of a shipped one. Errors: io, listing the shipped names.
[[nodiscard]] Result<std::filesystem::path> findProfile(const std::string& name, const std::filesystem::path& beside);

} // namespace pacini
