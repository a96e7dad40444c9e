#pragma once

// Markers that a sound file holds beside its sound.

#include "io/FoundMarkers.h"
#include "io/SoundParts.h"

#include <sndfile.h>

#include <cstdint>
#include <cstdio>
#include <vector>

namespace pacini
{

/// What a file says of markers in places where libsndfile does not look.
struct TagMarkers : FoundMarkers
{
    std::uint64_t cues = 0; ///< of WAV, or markers of AIFF: how many there are, for soundMarkers()
};

/// The chapters of one sound of `file`, in an ID3 tag (before it, from `from` on, or in a chunk of WAV and AIFF) or
/// among the comments of Ogg and FLAC; the loops of a WAV ("smpl"), each as two markers, "loop start" and "loop end".
/// Those of AIFF are markers already. Moves the stream's position.
[[nodiscard]] TagMarkers tagMarkers(std::FILE* file, const SoundPart& part, std::uint64_t from, int sampleRate);

/// The markers that libsndfile finds in an open file: the cues of WAV with their labels, and the markers of AIFF. One
/// without a name is called by its number in the file. `expected` is how many the file has.
[[nodiscard]] FoundMarkers soundMarkers(SNDFILE* file, int sampleRate, std::uint64_t expected);

/// Adds what was found of a sound that begins at `offset` s of the file. What has the name and, within a millisecond,
/// the time of a marker that is there already is the same one, and is left out.
void addMarkers(FoundMarkers& all, FoundMarkers found, double offset);

} // namespace pacini
