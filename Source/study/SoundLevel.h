#pragma once

// Levels of sounds: RMS, A-weighted (IEC 61672-1), loudness (EBU R 128), and at the ear by a calibration.

#include "study/Study.h"

#include <optional>
#include <span>
#include <vector>

namespace pacini::study
{

/// Levels of a sound that both ears get.
struct SoundLevels
{
    double rms = 0.0;               ///< dB re full scale (RMS); a full sine has -3.01
    double weighted = 0.0;          ///< the same, A-weighted
    std::optional<double> loudness; ///< LUFS, integrated; none if it is too short (400 ms) or quiet (-70 LUFS), or
                                    ///< without libebur128
    bool clipped = false;           ///< a sample is beyond full scale
};

/// All levels of a sound at a sample rate in Hz; -infinity of silence.
[[nodiscard]] SoundLevels levelsOf(std::span<const float> sound, int sampleRate);

/// The A-weighted level alone, dB re full scale (RMS). Weighted in the frequency domain by the equation of IEC
/// 61672-1:2013, annex E, which is exact up to the Nyquist frequency; filters by the bilinear transform are not.
[[nodiscard]] double weightedLevel(std::span<const float> sound, int sampleRate);

/// The A-weighting at a frequency in Hz, as a factor of the power; 1 at 1 kHz.
[[nodiscard]] double weightingA(double frequency) noexcept;

/// Returns the level at the ear (dB SPL, or dB(A) of an A-weighted level) of a level re full scale.
[[nodiscard]] double heardLevel(const SoundCalibration& calibration, double level) noexcept;

/// Whether this program was built with libebur128.
[[nodiscard]] bool knowsLoudness() noexcept;

/// The tone to calibrate with: a sine of 1 kHz with the calibration's level, with fades of 50 ms.
[[nodiscard]] std::vector<float> calibrationTone(const SoundCalibration& calibration, double seconds, int sampleRate);

} // namespace pacini::study
