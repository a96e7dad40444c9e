#pragma once

// A clip as few waves with few keyframes.

#include "io/formats/LossList.h"

#include <pacini/clip/Clip.h>

#include <cstddef>

namespace pacini
{

/// Waves that an HJIF file makes of a levelled clip: with the events that leaves the bands of the Simple Parametric
/// profile (7). More take more bytes, since each carries the rise and fall of the envelope, and beat more.
inline constexpr std::size_t hjifVoices = 5;

/// The clip as playedClip() makes it, on at most hjifVoices bands where its bands have pitch. What levels them is worth
/// a point where that saves 12 dB^2 in steps of 5 ms (1.5 dB over 25 ms), down to -35 dB below the loudest: errors
/// below are hardly felt. Pitch is within two semitones, of the eighth to the quarter of an octave that skin tells
/// apart. Events that the bands reach by themselves have an amplitude by which their pulses stand 25 dB below the
/// bands: they are still events of the file, and add nothing. Clips that are not levelled keep their points and their
/// events.
[[nodiscard]] Clip hjifVoicesOf(const Clip& clip, LossList& losses);

/// The amplitude of all bands together at `time` s.
[[nodiscard]] double hjifLevelAt(const Clip& clip, double time);

} // namespace pacini
