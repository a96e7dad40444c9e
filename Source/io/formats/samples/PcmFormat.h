#pragma once

// The drive signal itself: WAV, raw samples, a C array for firmware, and the arrays of OpenXR.

#include "io/formats/ForeignFormat.h"

namespace pacini
{

/// The drive signal of the clip (made for the profile where there is one) at `sampleRate`, 2000 to 48000 Hz, 8000
/// where it is not given. 8-bit WAV is unsigned, all else signed and little-endian. Losses: samples beyond full scale
/// are cut. Errors: invalidArgument for the rate, those of driveSignal().
[[nodiscard]] Result<ExportedClip> writeWav8(const Clip& clip, const ExportParams& params);
[[nodiscard]] Result<ExportedClip> writeWav16(const Clip& clip, const ExportParams& params);
[[nodiscard]] Result<ExportedClip> writeRaw8(const Clip& clip, const ExportParams& params);
[[nodiscard]] Result<ExportedClip> writeRaw16(const Clip& clip, const ExportParams& params);

/// A C header with the 8-bit samples as a `static const int8_t` array, their number and rate.
[[nodiscard]] Result<ExportedClip> writeCArray(const Clip& clip, const ExportParams& params);

/// For XR_FB_haptic_pcm and XR_FB_haptic_amplitude_envelope: a C header, or JSON, with the drive signal as floats
/// within -1..1, cut into buffers of at most 4000 samples to be appended, and the strength as amplitudes of 0 to 1 over
/// its duration in ns, 100 per second or as many as fit 4000. The rate is 2000 Hz where it is not given; what the
/// device plays at is asked of the runtime.
[[nodiscard]] Result<ExportedClip> writeOpenXrHeader(const Clip& clip, const ExportParams& params);
[[nodiscard]] Result<ExportedClip> writeOpenXrJson(const Clip& clip, const ExportParams& params);

[[nodiscard]] const ForeignFormat& wav8Format();
[[nodiscard]] const ForeignFormat& wav16Format();
[[nodiscard]] const ForeignFormat& raw8Format();
[[nodiscard]] const ForeignFormat& raw16Format();
[[nodiscard]] const ForeignFormat& cArrayFormat();
[[nodiscard]] const ForeignFormat& openXrHeaderFormat();
[[nodiscard]] const ForeignFormat& openXrJsonFormat();

} // namespace pacini
