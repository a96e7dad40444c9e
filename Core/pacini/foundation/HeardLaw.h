#pragma once

// The law by which what is heard above the range of touch becomes a tone beside what is felt, live and offline.

#include <algorithm>
#include <cmath>

namespace pacini
{

inline constexpr double heardSteadySeconds = 0.05; ///< in which the steady part of loudness follows it, time constant

/// What of a `loudness` counts as heard above the range of touch, where `high` is the part of it that lies there, and
/// `share` (0 to 1) that of the power: their geometric mean. A sound with less than a twentieth of its power there has
/// none.
[[nodiscard]] inline double heardAbove(double loudness, double high, double share) noexcept
{
    constexpr double none = 0.05;
    constexpr double all = 0.2;
    const double u = std::min(1.0, std::max(0.0, (share - none) / (all - none)));
    return u * u * (3.0 - 2.0 * u) * std::sqrt(std::max(0.0, loudness * high));
}

/// Amplitude of the tone, 0 and above, from `loudness` and its `steady` part, 1 at full drive. 45 % of the steady part
/// do not count, so that hiss and ringing leave room for what happens; below .03 nothing is felt. Loudness grows as
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

/// Amplitude of the tone beside the rest of the sound, from `wanted`, the amplitude `own` of all bands and the power
/// (amplitude squared) of the `low` ones, all at a full drive of 1. What is 6 dB below the low part is masked; the
/// drive that the bands need is theirs.
[[nodiscard]] inline double heardBeside(double wanted, double own, double low) noexcept
{
    const double a = std::min(wanted, std::max(0.0, 1.0 - own));
    return std::sqrt(std::max(0.0, a * a - 0.25 * low));
}

/// Pitch of the tone, Hz, from brightness 0 to 1: above what the low part of a sound masks, below where skin and
/// actuators end.
[[nodiscard]] inline double heardPitch(double brightness) noexcept
{
    constexpr double lowest = 280.0;
    constexpr double highest = 380.0;
    return lowest * std::pow(highest / lowest, brightness);
}

} // namespace pacini
