#pragma once

// Look-up of actuator profiles by file or by the name of a shipped one.

#include "cli/Console.h"
#include "io/ReadWarnings.h"

#include <pacini/actuator/Profile.h>

#include <optional>
#include <string>

namespace pacini::cli
{

/// The profile that the file `name` is (ACF too), or that ships under this name; nothing when it is something else.
/// Keys that are not known go to `warnings`. Errors: those of readProfile and readAcfFile.
[[nodiscard]] std::optional<Result<Profile>> profileIn(const std::string& name, ReadWarnings* warnings = nullptr);

/// The profile of `--profile name`; nothing when there is none, and the console has said why.
[[nodiscard]] std::optional<Profile> openProfile(Console& console, const std::string& name);

/// Returns an error of transparentClip() or transparentScene() with the option that names the profile.
[[nodiscard]] Error ofProfileOption(Error error);

} // namespace pacini::cli
