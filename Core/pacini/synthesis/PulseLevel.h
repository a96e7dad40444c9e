#pragma once

// Pulse level: level of an event's pulse beside the bands.

#include <pacini/clip/Clip.h>

#include <algorithm>
#include <cmath>

namespace pacini
{

/// Returns the amplitude of an event's pulse if bands are levelled to `envelope`. The pulse raises the level of the
/// bands to the event's own amplitude, so that no energy is played twice. 0 if the bands reach it by themselves. The
/// envelope is a mean over 10 ms: bands peak at up to twice its value.
[[nodiscard]] inline double pulseLevel(const Curve& envelope, const Transient& event) noexcept
{
    double reached = 0.0;
    for (const double after : {0.0, 0.005, 0.010})
        reached = std::max(reached, 2.0 * valueAt(envelope, event.time + after));
    return std::sqrt(std::max(event.amplitude * event.amplitude - reached * reached, 0.0));
}

} // namespace pacini
