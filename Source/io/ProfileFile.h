#pragma once

// Actuator profiles as JSON files.

#include <pacini/actuator/Profile.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace pacini
{

/// Reads a profile ("format": "pacini.profile", "version": 1). Required: format, version, name, resonance.frequency;
/// equalizer[{type,frequency,gain,q,order}] is optional, other keys are ignored. Errors carry the place, such as
/// `equalizer[1].gain`; codes invalidData, unsupportedVersion, tooLarge.
[[nodiscard]] Result<Profile> readProfileJson(std::string_view text);

/// The same from a file. Errors also: io.
[[nodiscard]] Result<Profile> readProfile(const std::filesystem::path& path);

/// Finds the profile that the user named: a file, or the name of a shipped one, which is looked for as
/// `profiles/NAME.json` in `beside` and the folders above it. Errors: io, listing the shipped names.
[[nodiscard]] Result<std::filesystem::path> findProfile(const std::string& name, const std::filesystem::path& beside);

} // namespace pacini
