#pragma once

// Writer of the markers of a WAV file.

#include <pacini/clip/Clip.h>

#include <string>
#include <vector>

namespace pacini
{

/// The chunks of a WAV that hold `markers` as cues with labels, each at the nearest frame. Their length is even.
/// Source: Microsoft and IBM, "Multimedia Programming Interface and Data Specifications 1.0", 1991.
[[nodiscard]] std::string cueChunks(const std::vector<Marker>& markers, int sampleRate);

} // namespace pacini
