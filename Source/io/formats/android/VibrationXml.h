#pragma once

// Reader of the vibration XML of Android.

#include "io/formats/ClipFormat.h"

#include <string_view>

namespace pacini
{

/// Reads a `vibration-effect`, of a `vibration-select` the first that can be read: steps (`waveform-effect`), envelopes
/// (`waveform-envelope-effect`, `basic-envelope-effect`), and of effects that each device has of its own
/// (`predefined-effect`, `primitive-effect`) clicks, ticks and thuds as events. What repeats is read once. Warnings
/// name all that is guessed or left out. Errors: invalidData with its line; tooLarge beyond 64 MiB, 24 hours or 5
/// million points. Source: Android Open Source Project, services of vibration, "vibration-effects.xsd", 2025.
[[nodiscard]] Result<ImportedClip> readVibrationXml(std::string_view bytes);

} // namespace pacini
