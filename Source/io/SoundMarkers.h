#pragma once

// Markers in a sound file.

#include "io/FoundMarkers.h"
#include "io/SoundParts.h"

#include <cstdint>
#include <cstdio>

namespace pacini
{

/// The markers of one sound of `file`: the cues of WAV with their labels and the markers of AIFF and CAF; chapters in
/// an ID3 tag (before the sound, from `from` on, behind the last one, or in a chunk of WAV and AIFF) or among the
/// comments of Ogg and FLAC; the loops of a WAV ("smpl"), each as two markers, "loop start" and "loop end". Those of
/// AIFF are markers already. Moves the stream's position.
[[nodiscard]] FoundMarkers soundMarkers(std::FILE* file, const SoundPart& part, std::uint64_t from, std::uint64_t until,
                                        int sampleRate);

} // namespace pacini
