#pragma once

// The interchange format of MPEG haptics (ISO/IEC 23090-31), .hjif.

#include "io/formats/ForeignFormat.h"

#include <cmath>
#include <numbers>
#include <string_view>

namespace pacini
{

/// Reads all vibrotactile channels as bands of one clip; several channels sound together at 1 / n of their amplitude.
/// VectorialWave bands become bands, Curve bands too (half a period between extrema), Transient bands events. Curve and
/// WaveletWave bands of a channel with wavelets are one waveform (see HjifWaveform), which is translated as a sound is;
/// with nothing beside it, it is levelled by an envelope. Errors have a place such as
/// `perceptions[0].channels[0].bands[2].effects[1].position`: what must be there for a signal is missing or of the
/// wrong kind, the version is none, nothing is left to play; tooLarge for waveforms of more than 2^25 samples.
/// Warnings: what is out of range is clamped; composite effects, spatial and non-vibrating perceptions are left out.
[[nodiscard]] Result<ImportedClip> readHjif(std::string_view bytes);

/// Each band becomes a VectorialWave band whose keyframes carry the amplitude as it is played (see playedClip()) and
/// the pitch. Dull events far from others become a Transient band; all transients are alike in the reference player,
/// so others become short waves, which the reader takes for events again. Up to 7 bands make the Simple Parametric
/// profile at level 1, up to 63 the Main profile at level 2. `amplitudePoints` and `frequencyPoints` limit the
/// keyframes of each band. Time is in ms, frequency in Hz without fraction.
[[nodiscard]] Result<ExportedClip> writeHjif(const Clip& clip, const ExportParams& params);

[[nodiscard]] bool isHjif(std::string_view bytes);

[[nodiscard]] const ForeignFormat& hjifFormat();

/// Frequencies of the dullest and the sharpest event in a Transient band, Hz; linear between.
inline constexpr double hjifDullFrequency = 65.0;
inline constexpr double hjifSharpFrequency = 300.0;

/// Amplitude of a transient for an event of amplitude 1: two periods of 91 Hz have the energy of two periods of 100 Hz
/// under a Hann window (3/8).
inline constexpr double hjifTransientLevel = 0.584;

/// A Hann window at `place`, 0 at its start to 1 at its end.
[[nodiscard]] inline double hannAt(double place)
{
    return std::pow(std::sin(std::numbers::pi * place), 2.0);
}

/// Whether an event that stands `gap` s from its nearest neighbour is what the reference player makes of a transient:
/// two periods at 91 Hz.
[[nodiscard]] constexpr bool hjifIsTransient(double sharpness, double gap)
{
    constexpr double dull = 0.2; // its pulse has 123 Hz
    return sharpness <= dull && gap >= 0.06;
}

} // namespace pacini
