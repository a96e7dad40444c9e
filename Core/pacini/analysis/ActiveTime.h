#pragma once

// Active duration of a sound: breakpoints per second are counted on this time only.

#include <pacini/analysis/DecayTime.h>
#include <pacini/analysis/Normalise.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace pacini
{

/// How "the amount of time above a threshold" (Weber 2020, section 4.3) is counted.
enum class ActiveTimeReading
{
    blocks,  ///< whole blocks whose peak is above it
    samples, ///< samples above it: literal, but every zero crossing counts as silence
};

/// Threshold and block length of the active time.
struct ActiveTimeParams
{
    Decibels threshold{-75.0}; ///< re 1, exceeded
    Seconds block{0.010};
    ActiveTimeReading reading = ActiveTimeReading::blocks;
    bool operator==(const ActiveTimeParams&) const = default;
};

/// The time during which the signal is above the threshold; fs in Hz. 0 for silence and for an empty signal; the last
/// block counts with the length that it has.
[[nodiscard]] inline Seconds activeTime(std::span<const float> signal, double fs,
                                        const ActiveTimeParams& params = {}) noexcept
{
    const std::size_t block =
        params.reading == ActiveTimeReading::samples ? 1 : std::max<std::size_t>(1, roundedFrames(params.block, fs));
    const double threshold = params.threshold.gain();
    std::size_t frames = 0;
    for (std::size_t begin = 0; begin < signal.size(); begin += block)
    {
        const auto part = signal.subspan(begin, std::min(block, signal.size() - begin));
        if (peakOf(part) > threshold)
            frames += part.size();
    }
    return Seconds(static_cast<double>(frames) / fs);
}

} // namespace pacini
