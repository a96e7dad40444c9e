#pragma once

// Description of an actuator profile, as text and as JSON.

#include <pacini/actuator/Profile.h>

#include <nlohmann/json.hpp>

#include <string>

namespace pacini::cli
{

/// The profile's own entries after `kind`, and `assumed`: the paths of the numbers whose source says so.
[[nodiscard]] nlohmann::ordered_json describe(const Profile& profile);

/// Lines for people; `file` names where it was found. Assumed numbers carry an asterisk.
[[nodiscard]] std::string profileText(const std::string& file, const Profile& profile);

/// The technology in words.
[[nodiscard]] const char* technologyText(Technology technology);

/// "any", "amplitude only" or a number of voices.
[[nodiscard]] std::string voicesText(int polyphony);

} // namespace pacini::cli
