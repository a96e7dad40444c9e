#pragma once

// Settings for rendering the felt acceleration instead of the drive signal.

#include <pacini/actuator/FeltModel.h>

#include <filesystem>

namespace pacini::cli
{

/// Conversion of drive signals to samples of felt acceleration.
struct FeltSettings
{
    FeltModelParams model;
    unsigned wearer = 0;
    double drive = 1.0;       ///< rated drives at a drive signal of 1: the profile's overdrive
    double fullScale = 100.0; ///< m/s^2 at a sample of 1
};

/// What `profile` makes `wearer` (see bodyOn) feel. Errors: invalidData at `body` when the profile has none; the
/// message names profiles beside the program `programFolder` that have one.
[[nodiscard]] Result<FeltSettings> feltSettings(const Profile& profile, unsigned wearer, double fullScale,
                                                const std::filesystem::path& programFolder);

} // namespace pacini::cli
