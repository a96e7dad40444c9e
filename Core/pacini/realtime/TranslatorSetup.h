#pragma once

// Configuration of the translator: actuator, bands and strength.

#include <pacini/actuator/Profile.h>
#include <pacini/actuator/Strength.h>
#include <pacini/filters/BandLayout.h>
#include <pacini/foundation/Units.h>

#include <cstddef>
#include <optional>

namespace pacini
{

/// Configuration of the translator, fixed when it is set up.
struct TranslatorSetup
{
    std::optional<Profile> profile;     ///< valid; none: the drive signal as it is
    BandLayoutParams bands;             ///< six from 30 to 1000 Hz; at most maxTranslatorBands count
    Decibels maxBoost{6.0};             ///< maximum boost of the drive to flatten a resonance, 0 to 40 dB
    double strength = standardStrength; ///< 0: as flat as can be; 1: as strong as can be (see fitActuator)
    bool operator==(const TranslatorSetup&) const = default;
};

inline constexpr std::size_t maxTranslatorBands = 12;

} // namespace pacini
