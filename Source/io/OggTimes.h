#pragma once

// Times of the pages of an Ogg stream of Vorbis or Opus, and the frames that its packets hold.

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

/// What the packets of a stream hold. Frames of Opus are at 48 kHz; those of other codecs than it and Vorbis are not
/// counted.
struct OggContent
{
    std::uint64_t frames = 0;       ///< of all packets, also of damaged pages
    std::uint64_t leftOut = 0;      ///< of these at the end, by the time of the last page; 0 for less than a packet
    std::uint64_t lastTime = 0;     ///< the latest of pages that are not damaged
    std::uint64_t damagedPages = 0; ///< whose checksum is wrong, which decoders leave out
};

/// The content of the stream `serial` whose pages lie in [begin, end). An encoder fills up the last packet and leaves
/// that out by the time of the last page; a whole packet is more than that. Sources: as above, A.2; RFC 7845, 4.4; RFC
/// 3533, 6.
[[nodiscard]] OggContent oggContent(ByteWindow& file, std::uint64_t begin, std::uint64_t end, std::uint64_t serial);

} // namespace pacini
