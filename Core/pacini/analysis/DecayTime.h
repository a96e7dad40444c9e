#pragma once

// Time constants: times as numbers of frames and as poles of a one-pole smoother.

#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/SizeInMemory.h>
#include <pacini/foundation/Units.h>

#include <cmath>
#include <cstddef>

namespace pacini
{

/// Meaning of a time constant.
enum class DecayDefinition
{
    percent99, ///< after this time 99 % of a step is done
    percent63, ///< after this time 63 % (1 - 1/e) of a step is done
};

/// Number of frames of a duration, to the nearest integer (Weber 2020, Eq. 4.5). Ties go up, also when the value in
/// seconds has been rounded down by its last digit. NaN and negative times give 0; the largest count is 2^53, or that
/// of std::size_t.
[[nodiscard]] inline std::size_t roundedFrames(Seconds time, double fs) noexcept
{
    const double frames = time.frames(fs);
    return sizeInMemory(std::floor(clampTo(frames + frames * 1e-12, 0.0, 0x1.0p53) + 0.5));
}

/// The pole of the one-pole smoother for a time of `frames` (Weber 2020, Eq. 4.6); 0 for 0 frames.
[[nodiscard]] inline double decayCoefficient(double frames, DecayDefinition decay) noexcept
{
    if (!(frames > 0.0))
        return 0.0;
    return decay == DecayDefinition::percent99 ? std::pow(0.01, 1.0 / frames) : std::exp(-1.0 / frames);
}

} // namespace pacini
