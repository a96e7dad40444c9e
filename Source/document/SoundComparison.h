#pragma once

// Comparison of a clip with its sound: levels over time and frequency, their difference, and the scores.

#include "document/view/SpectrumAnalyzer.h"
#include "io/StoredAudio.h"

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pacini
{

/// Columns over the whole clip, rows from low to high; `[column * rows.count + row]`.
struct SoundComparison
{
    static constexpr std::size_t columns = 360;
    static constexpr double longest = 120.0; ///< s: what comes later is not compared
    static constexpr float quiet = 45.0f;    ///< dB below the loudest of the sound: nothing is said of what is softer

    SpectrumRows rows{20.0, 1000.0, 48};
    double duration = 0.0;                  ///< s
    std::vector<std::uint8_t> sound;        ///< see SpectrumLevel
    std::vector<std::uint8_t> drive;        ///< of the clip, raised to the sound's level
    std::vector<float> difference;          ///< dB, drive above sound; 0 where both are quiet
    std::vector<double> differenceOfRows;   ///< dB, mean of the magnitude where the sound is not quiet
    double gain = 0.0;                      ///< dB that the drive was raised by
    double score = 0.0, best = 0.0;         ///< HTS, and that of the sound itself
    std::optional<double> match, bestMatch; ///< as people are predicted to judge; empty for a silent sound
};

/// Renders the clip without an actuator and compares it with its sound. Errors: those of renderScene() and of Comparer,
/// and cancelled when `cancelled` has become true meanwhile. [worker]
[[nodiscard]] Result<SoundComparison> compareWithSound(const Clip& clip, const StoredAudio& audio,
                                                       const std::atomic<bool>& cancelled);

} // namespace pacini
