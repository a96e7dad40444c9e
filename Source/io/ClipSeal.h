#pragma once

// Seal of a clip: a checksum that detects edits after encoding.

#include <pacini/clip/Clip.h>

namespace pacini
{

/// The parameter of the encoder's record that holds the checksum.
inline constexpr const char* clipSealName = "seal";

enum class ClipSeal
{
    missing, ///< not encoded by a version that seals
    whole,   ///< all of the clip is as it was encoded
    broken,  ///< something was changed
};

/// Adds to the encoder's record a checksum of everything else in the clip, in 32 bits. It holds in every form of the
/// clip that keeps all of it: a clip on the grids of its packed form stays sealed when it is packed.
void sealClip(Clip& clip);

[[nodiscard]] ClipSeal sealOf(const Clip& clip);

} // namespace pacini
