#pragma once

// Lengths that the headers of less common formats and the blocks of FLAC state. libsndfile shortens a sound to what the
// file holds, or fills it with silence.

#include "io/ByteWindow.h"

#include <cstdint>
#include <optional>

namespace pacini
{

/// The audio of a file by its header, in bytes of its samples as they are decoded.
struct StatedSound
{
    std::uint64_t promised = 0;
    std::uint64_t present = 0; ///< of these, at most `promised`
    std::uint64_t behind = 0;  ///< bytes of the file after it
};

/// The audio of the NIST (SPHERE), VOC, AVR, IFF (8SVX, 16SV), MAT (4 and 5), MPC 2000, SDS or WVE file that begins at
/// `begin` and may last until `end`. Nothing for other formats (PAF, PVF and IRCAM state no length), and where the
/// header leaves the length open. Trusts no number of the file.
[[nodiscard]] std::optional<StatedSound> statedSound(ByteWindow& file, std::uint64_t begin, std::uint64_t end);

/// The frames of the FLAC stream that begins at `begin` and ends at `end`, by the number of its last block (RFC 9639,
/// 9.1), for a stream that does not state them. Nothing where no whole block ends there.
[[nodiscard]] std::optional<std::uint64_t> numberedFlacFrames(ByteWindow& file, std::uint64_t begin, std::uint64_t end);

} // namespace pacini
