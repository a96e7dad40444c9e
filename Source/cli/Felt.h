#pragma once

// Settings for rendering the felt acceleration instead of the drive signal.

#include <pacini/synthesis/SignalPlayer.h>

#include <filesystem>

namespace pacini::cli
{

/// What `profile` makes `wearer` (see bodyOn) feel. Errors: invalidData at `body` when the profile has none; the
/// message names profiles beside the program `programFolder` that have one.
[[nodiscard]] Result<FeltSettings> feltSettings(const Profile& profile, unsigned wearer, double fullScale,
                                                const std::filesystem::path& programFolder);

} // namespace pacini::cli
