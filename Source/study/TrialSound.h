#pragma once

// Playback of one trial: sound, haptic signal and masking noise together, on one clock.

#include "study/Plan.h"
#include "study/Stimuli.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pacini::study
{

/// A stretch of frames.
struct FrameRange
{
    std::size_t begin = 0;
    std::size_t end = 0;
};

/// Buffers that begin at the same sample.
struct TrialSound
{
    std::vector<float> sound;             ///< for both ears
    std::vector<float> touch;             ///< drive signal of the first actuator
    std::vector<std::vector<float>> more; ///< those of the other actuators in the row
    /// Range of each stimulus of the trial, or of each consecutive part.
    std::vector<FrameRange> parts;
    std::optional<std::size_t> soundOnset, touchOnset; ///< frames until the first sample that is not zero
};

/// The whole of a trial: its stimuli one after the other with the block's pause between them. An adaptive trial's
/// interval has `level`; where the variable is the level itself, nothing is felt in the others. Errors: those of
/// StimulusMaker.
[[nodiscard]] Result<TrialSound> makeTrial(StimulusMaker& maker, const Trial& trial, std::optional<double> level,
                                           std::uint64_t maskingSeed);

/// One stimulus of a trial by itself, as pages of several play it.
[[nodiscard]] Result<TrialSound> makePart(StimulusMaker& maker, const Block& block, std::size_t stimulus,
                                          std::uint64_t maskingSeed);

} // namespace pacini::study
