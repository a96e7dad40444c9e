#pragma once

// Times of the pages of an Ogg stream of Vorbis, and the frames that its packets hold.

#include "io/ByteWindow.h"
#include "io/SoundParts.h"

#include <cstdint>
#include <vector>

namespace pacini
{

/// How a stream of Vorbis is to be read whose first frame is before 0 by its times.
struct VorbisShift
{
    std::uint64_t frames = 0;       ///< by which it is before 0
    bool isEdit = false;            ///< they are to be left out; otherwise the times are wrong
    std::vector<BytePatch> patches; ///< pages with later times, so that the first frame is at 0
};

/// The shift of the stream `serial` whose pages lie in [begin, end). The time of the first page with audio, less the
/// frames that are on it, is that of the first frame. What is before 0 is left out, as an edit; but an edit is at most
/// the overlap of the first two packets, and a stream that begins earlier is not one by the standard. Decoders differ
/// on both: some leave out as much at the end instead. Trusts no number. Source: Xiph.Org Foundation, "Vorbis I
/// specification", 2020, 4.3 and A.2.
[[nodiscard]] VorbisShift vorbisShift(ByteWindow& file, std::uint64_t begin, std::uint64_t end, std::uint64_t serial);

} // namespace pacini
