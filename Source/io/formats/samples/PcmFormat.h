#pragma once

// Files with the drive signal itself: WAV, raw samples and a C array for firmware.

#include "io/formats/ClipFormat.h"

namespace pacini
{

/// The drive signal of the clip (made for the profile where there is one) at `sampleRate`, 2000 to 48000 Hz, 8000
/// where it is not given. `bits` of a sample are 8 or 16; 8-bit WAV is unsigned, all else signed and little-endian.
/// Losses: samples beyond full scale are cut. Errors: invalidArgument for the rate, those of driveSignal().
[[nodiscard]] Result<ExportedClip> writeWav(const Clip& clip, const ExportParams& params, int bits);
[[nodiscard]] Result<ExportedClip> writeRaw(const Clip& clip, const ExportParams& params, int bits);

[[nodiscard]] inline bool isCArray(std::string_view bytes)
{
    return bytes.starts_with("#ifndef HAPTIC_");
}

/// A C header with the 8-bit samples as a `static const int8_t` array, their number and rate.
[[nodiscard]] Result<ExportedClip> writeCArray(const Clip& clip, const ExportParams& params);

} // namespace pacini
