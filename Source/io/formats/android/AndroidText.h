#pragma once

// Text helpers that the writers of Android's effects share.

#include "io/formats/android/AndroidEffects.h"

#include <string>
#include <vector>

namespace pacini
{

/// The durations of a waveform's steps, or their amplitudes, with commas between them: twelve to a line, each line
/// after `indent`.
[[nodiscard]] std::string timingsOf(const std::vector<AndroidStep>& steps, const char* indent);
[[nodiscard]] std::string amplitudesOf(const std::vector<AndroidStep>& steps, const char* indent);

/// An export of one file.
[[nodiscard]] ExportedClip oneFile(std::string text, std::vector<FormatLoss> losses);

} // namespace pacini
