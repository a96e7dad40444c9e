#pragma once

// Conversion of profiles from and to the actuator configuration files (ACF) of the Meta haptics SDK.

#include "io/Acf.h"

#include <pacini/actuator/Profile.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pacini
{

/// A profile converted from an ACF; each warning names entries that are lost or assumed.
struct ProfileOfAcf
{
    Profile profile;
    std::vector<std::string> warnings;
};

/// An ACF converted from a profile, with the same kind of warnings.
struct AcfOfProfile
{
    Acf acf;
    std::vector<std::string> warnings;
};

/// Whether the file is an ACF by its name, `.acf` in any case.
[[nodiscard]] bool hasAcfExtension(const std::filesystem::path& path);

/// What an ACF says of an actuator. Range and name are the file's; equal frequencies mean that only amplitude counts
/// (polyphony 0). The SDK's documentation sets the ends of the emphasis at 0.8 and 1.8 times the resonance, so their
/// geometric mean over 1.2 is taken for it. Two equal ends become a fixed transient, others the adaptive one. A
/// continuous gain below that of the emphasis leaves room for events: that is `drive.overdrive`.
[[nodiscard]] ProfileOfAcf profileOfAcf(const Acf& acf);

/// The ACF of a valid profile by the same rules; emphasis lasts two cycles as in the SDK's file for its own
/// controllers, but not less than the rise time.
[[nodiscard]] AcfOfProfile acfOfProfile(const Profile& profile);

/// The same from a file. Errors: io as in readWholeFile, and those of readAcf().
[[nodiscard]] Result<ProfileOfAcf> readAcfFile(const std::filesystem::path& path);

} // namespace pacini
