#pragma once

// Transients of HJIF for events, with the waves ducked around them.

#include "io/formats/hjif/HjifEvents.h"

#include <pacini/clip/Clip.h>

#include <vector>

namespace pacini
{

/// A Transient is felt as its event from a quarter of the event's amplitude on (-12 dB): two periods of 91 Hz have more
/// energy than the pulse of an event of the same amplitude, and more than the attack that it stands for.
inline constexpr double hjifLeastTap = 0.25;

/// Share of the waves that becomes the transient of an event.
struct HjifTapShare
{
    double share = 0.0; ///< of what is felt of them while the Transient plays
    double least = 0.0; ///< amplitude of the Transient, which takes more where the share gives less; 0: the event stays
                        ///< as it is told
};

/// Makes the events of `clip`, told as `events`, Transients by these shares, one for each. What a Transient takes over
/// is taken from the short wave of its event first where it has to be stronger than its share, and then from the bands,
/// which have points every millisecond, are levelled to `envelope` and get weaker by it while it plays; so nothing is
/// played twice. What is felt counts: bands above 300 Hz, which skin hardly feels, give less than their energy.
void hjifMakeRoom(Clip& clip, std::vector<HjifEvent>& events, const std::vector<HjifTapShare>& shares,
                  const Curve& envelope);

/// Whether an event of this amplitude that is told as `told` is a Transient of the file.
[[nodiscard]] bool isHjifTap(const HjifEvent& told, double amplitude);

} // namespace pacini
