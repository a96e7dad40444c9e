#pragma once

// Normalised frequency: the range in Hz of formats that say 0 to 1 and leave the rest to the device.

#include <pacini/actuator/Profile.h>

#include <algorithm>
#include <optional>

namespace pacini
{

/// A range of frequencies that a format calls 0 to 1, in Hz, linear between.
struct NormalisedRange
{
    double low = 0.0;  ///< Hz at 0
    double high = 0.0; ///< Hz at 1

    [[nodiscard]] double hertzOf(double normalised) const noexcept { return low + (high - low) * normalised; }

    /// 0 to 1; frequencies outside become its ends. A range of one frequency is 0.5 everywhere.
    [[nodiscard]] double normalisedOf(double hertz) const noexcept
    {
        return high > low ? std::clamp((hertz - low) / (high - low), 0.0, 1.0) : 0.5;
    }
};

/// The frequency range that the players of Quest controllers use for .haptic files, which do not state one.
inline constexpr NormalisedRange questRange{55.0, 200.0};

/// The frequency range that MPEG's reference software uses for the sharpness of Core Haptics; Apple does not state one.
inline constexpr NormalisedRange sharpnessRange{65.0, 300.0};

/// The range of the actuator, or without one that of the format's usual player, so that a frequency is played as itself
/// where it can be.
[[nodiscard]] inline NormalisedRange normalisedRangeOf(const std::optional<Profile>& profile,
                                                       const NormalisedRange& usual)
{
    if (!profile)
        return usual;
    return {profile->range.lowFrequency, profile->range.highFrequency};
}

} // namespace pacini
