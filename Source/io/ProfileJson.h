#pragma once

// Actuator profiles as JSON text: Resources/schema/pacini.profile.schema.json describes the format.

#include "io/ReadWarnings.h"

#include <pacini/actuator/Profile.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace pacini
{

inline constexpr std::string_view profileFormatName = "pacini.profile";
inline constexpr int profileFormatVersion = 1;

/// Longer texts are refused.
inline constexpr std::size_t largestProfileText = std::size_t(1) << 20;

/// Reads a profile and checks it with validate(). Required: `format`, `version`, `name`, `technology`,
/// `resonance.frequency`, and in each section of the equalizer `type`, `frequency` and, but for high-passes, `gain`.
/// What is missing keeps the default of its struct; `body` has none, it may be missing. Unknown keys are passed over
/// with a warning each, if `warnings` are asked for; a key given twice is an error. Errors carry the place, such as
/// `equalizer[1].gain`, or `line 3, column 17` for wrong JSON; codes invalidData, unsupportedVersion, notFinite,
/// tooLarge.
[[nodiscard]] Result<Profile> readProfileJson(std::string_view text, ReadWarnings* warnings = nullptr);

/// The text of a profile for which validate() holds: UTF-8, one line for each entry, numbers in the shortest form that
/// reads back exactly. `response`, `drive` and
/// `transient` are left out when they equal their default, and so is what is empty.
/// readProfileJson(profileJson(profile)) == profile, except that bytes which are not UTF-8 become U+FFFD.
[[nodiscard]] std::string profileJson(const Profile& profile);

} // namespace pacini
