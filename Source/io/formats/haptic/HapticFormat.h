#pragma once

// `.haptic` files, version 1, of Lofelt Studio and Meta Haptics Studio: an amplitude curve with emphases on its points,
// and a frequency curve, as JSON.

#include "io/formats/ClipFormat.h"

#include <cstddef>

namespace pacini
{

/// Longer texts are refused; an hour at 60 points per second is a third of it.
inline constexpr std::size_t largestHapticText = std::size_t(32) << 20;

[[nodiscard]] bool isHaptic(std::string_view bytes);

/// Reads what any of the format's readers takes: single points, clips without duration, steps, a first point after 0,
/// frequencies beyond the amplitudes (cut), and no frequencies (the middle of the range). A clip that ends with an
/// emphasis lasts until that has sounded. An emphasis without amplitude has that of its point, one without frequency
/// 0.5; one that has neither is left out. Warnings name these, what a strict reader refuses and what a clip does not
/// keep. Numbers are compared as 32-bit floats. Errors: as in readJsonTree(),
/// unsupportedVersion, and invalidData with its path for what all readers refuse: missing or mistyped entries, no
/// amplitude point, times below 0 or going back, values outside of 0 to 1, an emphasis below its point.
[[nodiscard]] Result<ImportedClip> readHaptic(std::string_view text);

/// Writes what the strictest reader takes: version 1.0.0, numbers in the shortest form that a 32-bit float reads back
/// exactly, first point at 0, frequencies from the first to the last amplitude point. An emphasis weaker than the
/// curve at its time is raised to it. Errors: those of validate().
[[nodiscard]] Result<ExportedClip> writeHaptic(const Clip& clip, const ExportParams& params);

} // namespace pacini
