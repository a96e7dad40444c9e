#pragma once

// Conversion of a clip's events to emphases, for players that duck the voice under them.

#include "io/formats/NormalisedFrequency.h"

#include <pacini/clip/Clip.h>

#include <cstddef>
#include <vector>

namespace pacini
{

/// Playback of events by a player: with its own oscillator, from a sine (sharpness 0) to a square (1), while the voice
/// is attenuated.
struct EmphasisPlayer
{
    NormalisedRange range = {}; ///< Hz of the dullest and the crispest
    double dullLength = 0.0;    ///< s
    double crispLength = 0.0;   ///< s
    double ducking = 1.0;       ///< gain of the voice meanwhile; at 1 they are played on top of it
    double separation = 0.0;    ///< s; of two events that are nearer it shows one
    double periods = 0.0;       ///< above 0: events are so many periods of a sine, whatever the lengths are

    [[nodiscard]] double lengthOf(double sharpness) const noexcept; ///< s
    [[nodiscard]] double sharpnessOfLength(double length) const noexcept;
};

/// The player of Quest controllers, from the Meta haptics SDK and its actuator file.
inline constexpr EmphasisPlayer questPlayer{{55.0, 165.0}, 0.0364, 0.0121, 0.5, 0.0121};

/// The events of a clip of several bands beside its one voice `amplitude` (not empty; linear): `events` are as strong
/// as what the voice does not reach by itself, and their sharpness means 100 to 280 Hz (see makePulse), which becomes
/// the one played at that frequency.
///
/// On top of the voice (a ducking of 1) they are played as strong as the voice around them or stronger, and those that
/// it reaches are left out. Under a player that ducks the voice, the level of each makes up for that: both together
/// have the power of voice and event. So an event that the voice reaches can be an emphasis too, which is what phones
/// show best; it is left out only where that would change the levels by more than is noticed. In fast trains the
/// sharpness rises until the pulse is as short as the decoder's own.
[[nodiscard]] std::vector<Transient> emphasesOf(std::vector<Transient> events, const Curve& amplitude,
                                                const EmphasisPlayer& player);

/// The same with an emphasis for each event, for a player that ducks the voice or a file that is ducked for it.
/// `beyond` is how strong each of `events` is beside the voice. An emphasis is as strong as what is ducked and the
/// event together, and at least as the voice that comes back after it, which would else be felt as a second hit; no
/// less than leastAmplitude. It is as sharp as the event, or sharper, where a shorter pulse leaves the levels nearer to
/// those of the voice.
[[nodiscard]] std::vector<Transient> emphasisOfEach(std::vector<Transient> events, const std::vector<double>& beyond,
                                                    const Curve& amplitude, const EmphasisPlayer& player);

/// Returns the indices of events, in order, that are at least `separation` s apart; of closer events the stronger ones
/// stay.
[[nodiscard]] std::vector<std::size_t> separated(const std::vector<Transient>& events, double separation);

} // namespace pacini
