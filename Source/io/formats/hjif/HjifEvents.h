#pragma once

// Representation of a clip's events in an HJIF file: as Transients, as short waves, or as both.

#include <pacini/clip/Clip.h>

#include <cstddef>
#include <vector>

namespace pacini
{

/// An event as a Transient, as a short wave, or as both.
struct HjifEvent
{
    double tap = 0.0;       ///< amplitude of the Transient, 0 for none
    double wave = 0.0;      ///< and of the wave, whose window has its peak there; 0 for none
    double frequency = 0.0; ///< Hz, of the wave
    double length = 0.0;    ///< s, of the wave
    bool inTrain = false;   ///< alone it would be a Transient
};

/// One for each event of `clip`, whose bands are as they are written. Where the bands are 20 dB above an event, and
/// where it is dull, the Transient of the reference player is enough: two periods of 91 Hz. Sharper ones are
/// a wave, too, and a Transient of half their amplitude for players that show taps, with their energy together. In
/// trains of less than 60 ms a Transient would fill the gaps: there they are waves only.
[[nodiscard]] std::vector<HjifEvent> hjifEventsOf(const Clip& clip);

/// The amplitude of the event that stands alone and is told by a Transient that is read as `tap` and a short wave of
/// the height `wave` that begins with it.
[[nodiscard]] double hjifTogether(const Transient& tap, double wave);

/// The amplitude of all bands together at `time` s.
[[nodiscard]] double hjifLevelAt(const Clip& clip, double time);

/// The highest amplitude that a band has anywhere.
[[nodiscard]] double hjifHighestLevel(const Clip& clip);

} // namespace pacini
