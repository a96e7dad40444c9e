#pragma once

// Look-up of the profile files that come with Pacini.

#include <pacini/foundation/Result.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pacini
{

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
