#pragma once

// Conversion of a clip's events to emphases, for players that duck the voice under them.

#include "io/formats/LossList.h"
#include "io/formats/NormalisedFrequency.h"

#include <pacini/clip/Clip.h>

#include <algorithm>
#include <vector>

namespace pacini
{

/// Playback of events by a player: by an oscillator of its own, which goes from a sine (sharpness 0) to a square (1),
/// while the voice is weaker.
struct EmphasisPlayer
{
    NormalisedRange range = {}; ///< Hz of the dullest and the crispest
    double dullLength = 0.0;    ///< s
    double crispLength = 0.0;   ///< s
    double ducking = 1.0;       ///< gain of the voice meanwhile; at 1 they are played on top of it

    [[nodiscard]] double lengthOf(double sharpness) const noexcept
    {
        return dullLength + (crispLength - dullLength) * sharpness;
    }
    [[nodiscard]] double sharpnessOfLength(double length) const noexcept
    {
        return std::clamp((dullLength - length) / (dullLength - crispLength), 0.0, 1.0);
    }
};

/// That of Quest controllers, as the Meta haptics SDK and its actuator file say.
inline constexpr EmphasisPlayer questPlayer{{55.0, 165.0}, 0.0364, 0.0121, 0.5};

/// The events of a clip of several bands beside its one voice `amplitude` (not empty; linear): `events` are as strong
/// as what the voice does not reach by itself, and their sharpness means 100 to 280 Hz (see makePulse), which becomes
/// the one played at that frequency.
///
/// On top of the voice (a ducking of 1) they are played as strong as the voice around them or stronger, and those that
/// it reaches are left out. Under a player that ducks the voice, the level of each makes up for that: both together
/// have the power of voice and event. So an event that the voice reaches can be an emphasis too, which is what phones
/// show best; it is left out only where that would change the levels by more than is noticed. In fast trains the
/// sharpness rises until the pulse is as short as the decoder's own. What is left out is in `losses`.
[[nodiscard]] std::vector<Transient> emphasesOf(std::vector<Transient> events, const Curve& amplitude,
                                                const EmphasisPlayer& player, LossList& losses);

} // namespace pacini
