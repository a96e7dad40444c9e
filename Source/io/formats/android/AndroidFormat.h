#pragma once

// Files with vibration effects of Android: JSON, XML, Kotlin and Java.

#include "io/formats/ClipFormat.h"

namespace pacini
{

[[nodiscard]] bool isAndroidJson(std::string_view bytes);

namespace detail
{
[[nodiscard]] inline bool isVibrationXml(std::string_view bytes)
{
    return bytes.find("<vibration-effect") != std::string_view::npos;
}
} // namespace detail

[[nodiscard]] inline bool isAndroidEnvelopeXml(std::string_view bytes)
{
    return detail::isVibrationXml(bytes) && bytes.find("<waveform-envelope-effect") != std::string_view::npos;
}

[[nodiscard]] inline bool isAndroidBasicXml(std::string_view bytes)
{
    return detail::isVibrationXml(bytes) && bytes.find("<basic-envelope-effect") != std::string_view::npos;
}

[[nodiscard]] inline bool isAndroidXml(std::string_view bytes)
{
    return detail::isVibrationXml(bytes) && !isAndroidEnvelopeXml(bytes) && !isAndroidBasicXml(bytes);
}

[[nodiscard]] inline bool isAndroidKotlin(std::string_view bytes)
{
    return bytes.starts_with("import android.os.Build\nimport android.os.VibrationEffect\n");
}

[[nodiscard]] inline bool isAndroidJava(std::string_view bytes)
{
    return bytes.starts_with("import android.os.Build;\nimport android.os.VibrationEffect;\n");
}

/// Reads the JSON that writeAndroidJson() writes: of its effects `waveformEnvelope`, else `basicEnvelope`, else
/// `waveform`. A warning says what is not read: amplitudes of -1 (the device's default) become 255, repetition is left
/// out. Errors: invalidData with a place such as `waveform.timings[3]`; lists of unequal length, durations that are no
/// whole ms from 0 (of a waveform) or 1 on, values outside their ranges.
[[nodiscard]] Result<ImportedClip> readAndroidJson(std::string_view bytes);

/// One object with the effects of androidEffectsOf(): `waveform` {timings, amplitudes, repeat}, `basicEnvelope`
/// {initialSharpness, controlPoints} and `waveformEnvelope` {initialFrequencyHz, controlPoints}, all with the names and
/// units of the functions that they are for.
[[nodiscard]] Result<ExportedClip> writeAndroidJson(const Clip& clip, const ExportParams& params);

/// The waveform as a `vibration-effect` document; with `split` the envelopes too, each in its file.
[[nodiscard]] Result<ExportedClip> writeAndroidXml(const Clip& clip, const ExportParams& params);

/// The envelope of androidEnvelopeOf() as a `vibration-effect` document with a `waveform-envelope-effect` (amplitude,
/// frequencyHz) or a `basic-envelope-effect` (intensity, sharpness). Errors: those of androidEnvelopeOf().
[[nodiscard]] Result<ExportedClip> writeAndroidEnvelopeXml(const Clip& clip, const ExportParams& params);
[[nodiscard]] Result<ExportedClip> writeAndroidBasicXml(const Clip& clip, const ExportParams& params);

/// A function that returns the effect: the envelope from API 36 on where the device plays it, before the waveform.
[[nodiscard]] Result<ExportedClip> writeAndroidKotlin(const Clip& clip, const ExportParams& params);
[[nodiscard]] Result<ExportedClip> writeAndroidJava(const Clip& clip, const ExportParams& params);

} // namespace pacini
