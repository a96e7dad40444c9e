#pragma once

// Markers that a sound file holds beside its sound.

#include <pacini/clip/Clip.h>

#include <sndfile.h>

#include <vector>

namespace pacini
{

/// The markers of an open file (the cues of WAV with their labels, and the markers of AIFF), in order, with times in s.
/// One without a name is called by its number in the file.
[[nodiscard]] std::vector<Marker> soundMarkers(SNDFILE* file, int sampleRate);

} // namespace pacini
