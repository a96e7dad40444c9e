#pragma once

// Conversion of the onsets of a sound to the transients of a clip.

#include <pacini/analysis/Onset.h>
#include <pacini/clip/Clip.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace pacini
{

/// Transients for `onsets`, scaled by `gain`, amplitudes within 0-1. An event is felt as strong as its part in the
/// range of touch, or as half its full band where it is brighter than that: a bright click has no low part of its own,
/// and shall be felt. Where that half exceeds full drive, all of it is scaled down alike, so that bright events keep
/// their ratios.
[[nodiscard]] inline std::vector<Transient> transientsFrom(std::span<const Onset> onsets, double gain)
{
    constexpr double brightShare = 0.5;
    double strongest = 1.0;
    for (const Onset& onset : onsets)
        strongest = std::max(strongest, brightShare * gain * onset.amplitude);
    std::vector<Transient> transients;
    transients.reserve(onsets.size());
    for (const Onset& onset : onsets)
    {
        const double bright = brightShare * gain * onset.amplitude / strongest;
        transients.push_back(
            {onset.time, std::clamp(std::max(gain * onset.lowAmplitude, bright), 0.0, 1.0), onset.sharpness});
    }
    return transients;
}

/// Events that follow each other faster than the skin's and the actuator's memory stay apart only when nothing sounds
/// between them: wherever two `onsets` are less than `reach` s apart, `envelope` (a frame every `step` s) is held down
/// to its valley between them, and the pulses of the events carry what is above it.
inline void holdDownBetween(std::span<const Onset> onsets, double reach, double step, std::span<float> envelope)
{
    const auto frameOf = [&](double time)
    {
        return std::min(envelope.size(), static_cast<std::size_t>(std::max(0.0, std::ceil(time / step))));
    };
    for (std::size_t i = 0; i + 1 < onsets.size(); ++i)
    {
        if (onsets[i + 1].time - onsets[i].time >= reach)
            continue;
        // The envelope's window of two steps sees an event one step early.
        const std::size_t first = frameOf(onsets[i].time - step);
        const std::size_t end = frameOf(onsets[i + 1].time - step);
        float valley = std::numeric_limits<float>::max();
        for (std::size_t f = first; f < end; ++f)
            valley = std::min(valley, envelope[f]);
        for (std::size_t f = first; f < end; ++f)
            envelope[f] = valley;
    }
}

} // namespace pacini
