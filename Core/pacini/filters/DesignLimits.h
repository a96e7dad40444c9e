#pragma once

// Limits of filter design: the range in which filters are designed. Every design function clamps to it, so that no
// parameter can make a filter unstable; NaN counts as the lower limit.

#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Units.h>

namespace pacini
{

namespace designLimits
{
// In double precision the poles of a second-order direct form can still be told from z = 1 at 1e-7 of the sample rate.
inline constexpr double lowestFrequency = 1e-7;    ///< times the sample rate
inline constexpr double highestFrequency = 0.4999; ///< times the sample rate: tan(pi f / fs) must stay finite
inline constexpr double lowestQ = 1e-6;            ///< a band-pass over the whole range needs 1e-5
inline constexpr double highestQ = 1e5;
inline constexpr double highestGain = 120.0; ///< dB, up and down
} // namespace designLimits

[[nodiscard]] inline double clampedFrequency(Hertz f, double fs) noexcept
{
    return clampTo(f.value, designLimits::lowestFrequency * fs, designLimits::highestFrequency * fs);
}

[[nodiscard]] inline double clampedQ(double q) noexcept
{
    return clampTo(q, designLimits::lowestQ, designLimits::highestQ);
}

[[nodiscard]] inline Decibels clampedGain(Decibels gain) noexcept
{
    return Decibels(clampTo(gain.value, -designLimits::highestGain, designLimits::highestGain));
}

} // namespace pacini
