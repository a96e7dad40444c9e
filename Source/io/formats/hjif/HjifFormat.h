#pragma once

// HJIF files, the interchange format of MPEG haptics (ISO/IEC 23090-31).

#include "io/formats/ClipFormat.h"

#include <cmath>
#include <numbers>
#include <string_view>

namespace pacini
{

/// Reads all vibrotactile channels as bands of one clip; several channels sound together at 1 / n of their amplitude.
/// VectorialWave bands become bands, Curve bands too (half a period between extrema), Transient bands and short waves
/// events, one where both begin together. Curve and WaveletWave bands of a channel with wavelets are one waveform (see
/// HjifWaveform), which is translated as a sound is; with nothing beside it, it is levelled by an envelope. Errors have
/// a place such as
/// `perceptions[0].channels[0].bands[2].effects[1].position`: what must be there for a signal is missing or of the
/// wrong kind, the version is none, nothing is left to play; tooLarge for waveforms of more than 2^25 samples.
/// Warnings: what is out of range is clamped; composite effects, spatial and non-vibrating perceptions are left out.
[[nodiscard]] Result<ImportedClip> readHjif(std::string_view bytes);

/// Levelled clips become a few VectorialWave bands of few keyframes (see hjifVoicesOf), others one for each of their
/// bands with all of its points. Events become a Transient band, which is two periods of 91 Hz in the reference player
/// whatever their sharpness and for which the bands make room (see hjifMakeRoom) unless events are merged, and short
/// waves where that is not enough (see hjifEventsOf), which the reader takes for events again. Up to 7 bands make the
/// Simple Parametric profile at level 1, up to 63 the Main profile at level 2. `amplitudePoints` and `frequencyPoints`
/// limit the keyframes of each band. Time is in ms, frequency in Hz without fraction, amplitudes have three digits.
[[nodiscard]] Result<ExportedClip> writeHjif(const Clip& clip, const ExportParams& params);

[[nodiscard]] bool isHjif(std::string_view bytes);

/// Default representation of events: players give all transients the same 22 ms of 91 Hz.
inline constexpr EventExport hjifEvents = EventExport::merged;

/// Length of the reference player's only transient, s.
inline constexpr double hjifTransientLength = 0.022;

/// Frequencies of the dullest and the sharpest event in a Transient band, Hz; linear between.
inline constexpr double hjifDullFrequency = 65.0;
inline constexpr double hjifSharpFrequency = 300.0;

/// Amplitude of a transient for an event of amplitude 1 that stands alone: two periods of 91 Hz have the energy of two
/// periods of 100 to 280 Hz under a Hann window (3/8).
[[nodiscard]] inline double hjifTransientLevel(double sharpness)
{
    return std::sqrt(3.0 / 8.0 * (2.0 / (100.0 * std::pow(2.8, sharpness))) / hjifTransientLength);
}

/// A Hann window at `place`, 0 at its start to 1 at its end.
[[nodiscard]] inline double hannAt(double place)
{
    return std::pow(std::sin(std::numbers::pi * place), 2.0);
}

} // namespace pacini
