#pragma once

// HMPG files: MPEG haptics (ISO/IEC 23090-31) as a stream of units and packets of bits, as the reference programs write
// and read them.

#include "io/formats/ClipFormat.h"

#include <string_view>

namespace pacini
{

/// Reads what readHjif() reads: the entries of both are the same, and so are places of errors and warnings. Errors
/// also: invalidData with the byte of a unit or packet that is cut off or refers to nothing. Warnings also: packets of
/// unknown kinds are left out, as are units of spatial haptics. Checksums are not checked.
[[nodiscard]] Result<ImportedClip> readHmpg(std::string_view bytes);

/// Writes what writeHjif() writes, with amplitudes in 255 steps of -1 to 1, phases in 65535 steps, times in ms, and
/// waves of more than a minute in several effects. Quiet clips use the steps by a gain of the channel. A unit is 128 ms
/// long, as the reference program has it. Errors also: tooLarge for more than 65536 effects.
[[nodiscard]] Result<ExportedClip> writeHmpg(const Clip& clip, const ExportParams& params);

[[nodiscard]] bool isHmpg(std::string_view bytes);

} // namespace pacini
