#pragma once

// `.tact` files of bHaptics: strengths of motors in frames of 20 ms.

#include "io/formats/ClipFormat.h"

#include <cstdint>

namespace pacini
{

[[nodiscard]] bool isTact(std::string_view bytes);

/// Reads the strongest motor of all positions as one amplitude, since a clip has no places: a warning says so. Dots and
/// the points of paths count alike; fades are straight. Disabled tracks are left out. Motors spin at no frequency that
/// the file says: 150 Hz is taken. Errors: invalidData with a place such as
/// `project.tracks[0].effects[2].startTime`.
[[nodiscard]] Result<ImportedClip> readTact(std::string_view bytes);

/// Writes the strength as dots of one motor on each forearm, one feedback for each run of equal frames.
[[nodiscard]] Result<ExportedClip> writeTact(const Clip& clip, const ExportParams& params);

/// Effects are made of frames of this length, ms.
inline constexpr std::int64_t tactFrame = 20;

/// Frequency of the sinusoid for a motor's strength, Hz.
inline constexpr double tactMotorFrequency = 150.0;

} // namespace pacini
