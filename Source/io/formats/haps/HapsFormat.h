#pragma once

// `.haps` files, version 5, of Interhaptics (Razer).

#include "io/formats/ClipFormat.h"

namespace pacini
{

[[nodiscard]] bool isHaps(std::string_view bytes);

/// Reads the vibration: transient notes become events, continuous ones a band each (those of one melody that do not
/// overlap share one); gains of perception, melody and note multiply, muted melodies are left out. Keyframes count from
/// the start of their note. Warnings: textures and stiffness are not read; keyframes after a note's length are kept,
/// since common writers state a length of 1 s; a start, or a time or value of a keyframe that is missing is 0;
/// frequencies of a note that are all 0 to 1 are fractions. Errors: unsupportedVersion for other than version 5,
/// invalidData with a place such as `m_vibration.m_melodies[1].m_notes[0].m_length`.
[[nodiscard]] Result<ImportedClip> readHaps(std::string_view bytes);

/// Writes events as the notes of the first melody and the one voice of the clip as one note of the second, whose
/// frequencies are in Hz. At most 60 amplitude and 20 frequency points per second unless `params` say otherwise.
[[nodiscard]] Result<ExportedClip> writeHaps(const Clip& clip, const ExportParams& params);

/// What Interhaptics' own files state as the length of a transient, s.
inline constexpr double hapsTransientLength = 0.022;

/// Frequency of notes that say none, or 0, Hz.
inline constexpr double hapsMotorFrequency = 150.0;

/// Frequencies of notes that say them as fractions, 0 and 1, as ReaHaptic maps them to Hz.
inline constexpr double hapsLowestFraction = 60.0;
inline constexpr double hapsHighestFraction = 760.0;

} // namespace pacini
