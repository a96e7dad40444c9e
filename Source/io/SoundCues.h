#pragma once

// Reader of the markers of WAV and AIFF files.

#include "io/AudioHeader.h"
#include "io/ByteWindow.h"
#include "io/FoundMarkers.h"

#include <cstdint>
#include <vector>

namespace pacini
{

/// The cues of a WAV with their labels, or the markers of an AIFF, by the chunks of the file that begins at `begin`.
/// One without a name is called by its number in the file. Sources: Microsoft and IBM, "Multimedia Programming
/// Interface and Data Specifications 1.0", 1991; Apple, "Audio Interchange File Format 1.3", 1989.
[[nodiscard]] FoundMarkers cuesOf(ByteWindow& file, std::uint64_t begin, const std::vector<FileChunk>& chunks,
                                  int sampleRate);

} // namespace pacini
