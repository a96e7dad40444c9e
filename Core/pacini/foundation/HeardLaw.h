#pragma once

// Law of the tone for sound above the range of touch, shared by live and offline translation.

#include <algorithm>
#include <cmath>

namespace pacini
{

inline constexpr double heardSteadySeconds = 0.05; ///< time constant with which the steady part follows the loudness

/// Returns the part of a `loudness` that counts as above the range of touch: the geometric mean of `loudness` and
/// `high`, the loudness above that range. It fades in between a `share` of the power there (0 to 1) of .05 and .2.
[[nodiscard]] inline double heardAbove(double loudness, double high, double share) noexcept
{
    constexpr double none = 0.05;
    constexpr double all = 0.2;
    const double u = std::min(1.0, std::max(0.0, (share - none) / (all - none)));
    return u * u * (3.0 - 2.0 * u) * std::sqrt(std::max(0.0, loudness * high));
}

/// Returns the amplitude of the tone, 0 and above, from `loudness` and its `steady` part, 1 at full drive. 45 % of the
/// steady part do not count, so that hiss and ringing leave pauses; below .03 nothing is felt. Loudness grows with
/// amplitude to the power of .6: the exponent 5/3 makes a sound of half the level half as strong.
[[nodiscard]] inline double heardRise(double loudness, double steady) noexcept
{
    constexpr double steadyPart = 0.45;
    constexpr double unheard = 0.03;
    const double rise = (loudness - steadyPart * steady) / (1.0 - 0.5 * steadyPart);
    const double u = std::max(0.0, rise - unheard) / (1.0 - unheard);
    return u * std::cbrt(u * u);
}

inline constexpr double heardMaskedBy = 300.0; ///< Hz, below which a sound masks the tone

/// Returns the power (amplitude squared) of the tone beside the rest of the sound, below 0 where that masks it, from
/// its amplitude `wanted`, the amplitude `own` of all bands and the power of the `low` ones, all at a full drive of 1.
/// A tone 6 dB below the low part is masked. The bands have priority for the drive.
[[nodiscard]] inline double heardBesidePower(double wanted, double own, double low) noexcept
{
    const double a = std::min(wanted, std::max(0.0, 1.0 - own));
    return a * a - 0.25 * low;
}

/// Returns the amplitude of the tone beside the rest of the sound, see heardBesidePower().
[[nodiscard]] inline double heardBeside(double wanted, double own, double low) noexcept
{
    return std::sqrt(std::max(0.0, heardBesidePower(wanted, own, low)));
}

/// Returns the pitch of the tone, Hz, for a brightness of 0 to 1: above the frequencies that the low part of a sound
/// masks, below the upper limit of skin and actuators.
[[nodiscard]] inline double heardPitch(double brightness) noexcept
{
    constexpr double lowest = 280.0;
    constexpr double highest = 380.0;
    return lowest * std::pow(highest / lowest, brightness);
}

} // namespace pacini
