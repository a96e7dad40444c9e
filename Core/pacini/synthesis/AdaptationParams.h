#pragma once

// Parameters of the adaptation of clips to an actuator.

#include <pacini/actuator/Profile.h>
#include <pacini/actuator/Strength.h>
#include <pacini/foundation/Units.h>

#include <optional>

namespace pacini
{

/// Parameters of the adaptation: the steps to do; by default all.
struct AdaptationParams
{
    bool frequencies = true;            ///< move frequencies outside the actuator's range into it
    bool voices = true;                 ///< as many sinusoids as the actuator has voices
    bool dynamicRange = true;           ///< raise levels below the touch threshold
    Decibels maxBoost{6.0};             ///< maximum boost of the drive to flatten a resonance, 0 to 40 dB; 0 leaves it
    double strength = standardStrength; ///< 0: as flat as can be; 1: as strong as can be (see fitActuator)
    std::optional<FrequencyMapping> mapping; ///< instead of the profile's
    bool operator==(const AdaptationParams&) const = default;
};

} // namespace pacini
