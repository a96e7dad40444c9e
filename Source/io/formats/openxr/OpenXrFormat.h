#pragma once

// Arrays for OpenXR: the drive signal and its strength, as a C header or JSON.

#include "io/formats/ClipFormat.h"

namespace pacini
{

[[nodiscard]] inline bool isOpenXrHeader(std::string_view bytes)
{
    return bytes.starts_with("/* XR_FB_haptic_pcm:");
}

[[nodiscard]] inline bool isOpenXrJson(std::string_view bytes)
{
    return bytes.find("\"amplitudeEnvelopeVibration\"") != std::string_view::npos ||
           bytes.find("\"pcmVibration\"") != std::string_view::npos;
}

/// For XR_FB_haptic_pcm and XR_FB_haptic_amplitude_envelope: a C header, or JSON, with the drive signal as floats
/// within -1..1, cut into buffers of at most 4000 samples to be appended, and the strength as amplitudes of 0 to 1 over
/// its duration in ns, 100 per second or as many as fit 4000. The rate is 2000 Hz where it is not given; what the
/// device plays at is asked of the runtime.
[[nodiscard]] Result<ExportedClip> writeOpenXrHeader(const Clip& clip, const ExportParams& params);
[[nodiscard]] Result<ExportedClip> writeOpenXrJson(const Clip& clip, const ExportParams& params);

} // namespace pacini
