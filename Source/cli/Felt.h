#pragma once

// Check that a profile has the body model that predicts the acceleration of the skin.

#include <pacini/actuator/Profile.h>
#include <pacini/foundation/Result.h>

#include <filesystem>

namespace pacini::cli
{

/// Errors: invalidData at `body` when the profile has none; the message names profiles beside the program
/// `programFolder` that have one.
[[nodiscard]] Result<void> checkFelt(const Profile& profile, const std::filesystem::path& programFolder);

} // namespace pacini::cli
