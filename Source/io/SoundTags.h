#pragma once

// Tags of music programs before, after and between sounds of any format.

#include "io/ByteWindow.h"

#include <cstdint>

namespace pacini
{

/// The bytes of the tag that begins at `offset` (ID3v2, ID3v1, APEv2, Lyrics3), or 0. A tag may claim more than the
/// file has.
[[nodiscard]] std::uint64_t tagBytesAt(ByteWindow& file, std::uint64_t offset);

/// Returns the end of a sound that is followed by tags up to `end`.
[[nodiscard]] std::uint64_t endBeforeTags(ByteWindow& file, std::uint64_t begin, std::uint64_t end);

} // namespace pacini
