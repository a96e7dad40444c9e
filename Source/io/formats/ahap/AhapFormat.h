#pragma once

// AHAP files of Apple's Core Haptics: a pattern of transient and continuous events, with curves that act on all of
// them, as JSON. Intensities are taken as square roots of amplitudes, as Lofelt's and Meta's players do.

#include "io/formats/ClipFormat.h"

#include <cstddef>

namespace pacini
{

/// Longer texts are refused.
inline constexpr std::size_t largestAhapText = std::size_t(32) << 20;

/// Longest continuous event of Core Haptics, s.
inline constexpr double longestAhapEvent = 30.0;

[[nodiscard]] bool isAhap(std::string_view bytes);

/// Reads the haptic events: each transient with the curves' values of its moment, the continuous ones as one band, or
/// as one more for each that sounds at the same time. Parameters act from their time on, curves from their first to
/// their last point with the last value held; what starts later wins. As Core Haptics does, values outside of their
/// range are moved to its end, missing ones have a default (intensity 1, sharpness 0.5), continuous events without a
/// duration or with one of 0 go on until the pattern ends, at most 30 s, and those that sound together give no more
/// than full drive (see limitSum); unknown keys are ignored. Continuous events rise for their AttackTime, and fall
/// after their end for their ReleaseTime, or without Sustained at once for their DecayTime; these are read as seconds,
/// which a warning says. The clip lasts until its last event has sounded. Warnings name what was mended and what a clip
/// does not keep: audio events, and envelopes of transients. Errors: as in readJsonTree(), unsupportedVersion beyond 1,
/// invalidData with its path for missing or mistyped entries, unknown types of events and times before 0; tooLarge for
/// more than 24 hours, 256 continuous events at a time, or 4 million points of curves.
[[nodiscard]] Result<ImportedClip> readAhap(std::string_view text);

/// Writes one file, or with params.split two: the events alone in `NAME-transients.ahap`, which the curves then do not
/// act on; one if there are no events, or nothing else. Continuous events last at most 30 s and follow each other,
/// curves have at most 16 points with times that count from the curve's own and share their ends. In one file the
/// curves also scale and shift the transients, so that each transient is divided by the intensity curve and lowered by
/// the sharpness curve at its time; where the curve would be weaker than the transient, a continuous event of its own,
/// 15 ms long and less intense, lets the curve be raised without changing their product. Errors: those of validate().
[[nodiscard]] Result<ExportedClip> writeAhap(const Clip& clip, const ExportParams& params);

/// The suffix of the second file.
inline constexpr std::string_view ahapTransients = "-transients";

} // namespace pacini
