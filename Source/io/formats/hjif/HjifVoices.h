#pragma once

// Reduction of a clip to few waves with few keyframes.

#include "io/formats/ClipFormat.h"
#include "io/formats/LossList.h"
#include "io/formats/hjif/HjifEvents.h"

#include <pacini/clip/Clip.h>

#include <vector>

namespace pacini
{

/// Effort of the search for a file of few bytes that feels like the clip.
enum class HjifEffort
{
    search, ///< up to 54 files are compared with the clip: 60 ms a second of sound
    usual   ///< one that is mostly good
};

/// Content of a clip in a file.
struct HjifVoices
{
    Clip clip;
    std::vector<HjifEvent> events; ///< how its transients are told
};

/// The clip as bakedClip() makes it, on four to six bands where its bands have pitch (with the events that leaves the
/// seven of the Simple Parametric profile): more take more bytes, since each carries the rise and fall of the envelope,
/// and beat more. Pitch is within one or two semitones, of the eighth to the quarter of an octave that skin tells
/// apart. How many bands, how near their pitch and how many points are what makes the file feel most like the clip for
/// its bytes (see HjifLikeness): a kilobyte per second costs 0.6 points. Around events that are felt in one of both
/// only, errors count three times, up to twice over. Without a search, and in clips of more than two minutes, there are
/// five bands within two semitones and points that save 12 dB^2 in steps of 5 ms. Events that the bands reach by
/// themselves have an amplitude by which their pulses stand 25 dB below the bands: they are still events of the file,
/// and add nothing. Clips that are not levelled keep their points and their events.
///
/// With `events` as transients the bands make room for Transients (see hjifMakeRoom): for all events, but those where
/// that would change more of what is felt than an event is worth; these are in `losses` one by one, as are merged ones.
[[nodiscard]] HjifVoices hjifVoicesOf(const Clip& clip, LossList& losses, HjifEffort effort = HjifEffort::search,
                                      EventExport events = EventExport::merged);

} // namespace pacini
