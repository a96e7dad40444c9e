#pragma once

// Weights of the evidence for a voice.

#include <pacini/analysis/VoiceFeatures.h>

#include <array>

namespace pacini
{

/// Weights of VoiceFeatures for log odds of a voice, by logistic regression (ridge 0.001) over an hour of recorded
/// and synthetic speech, music, effects and mixes of these; Resources/docs/quality.md says of which, and what became of
/// sounds that had no part in it.
// clang-format off
inline constexpr std::array<double, voiceFeatures> voiceWeights{
    // of late
    0.387, 0.206, -0.663, -0.109, -0.452, -0.758, 0.811, 0.197, -0.583,
    -0.847, -0.691, 0.65, 1.1, 0.364, -0.0892, -1.81, 1.18,
    // mean
    0.0602, 0.162, -0.341, -0.000743, -0.45, -1.13, 2.33, -0.594, 0.778,
    0.563, -2.1, -0.399, 0.399, 0.229, 0.676, -5.74, -1.19,
    // standard deviation
    -0.234, 4.29, 3.16, 2.67, -2.19, -1.94, -0.0175, -2.18, 5.14,
    -0.165, 1.96, -0.326, 2.53, -2.39, 0.142, 2.75, 1.09,
    // beginning of the sound
    1.84};
// clang-format on

inline constexpr double voiceBias = -4.27;

} // namespace pacini
