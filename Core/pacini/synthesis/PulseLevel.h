#pragma once

// Pulse level: level of an event's pulse beside the bands.

#include <pacini/clip/Clip.h>

#include <algorithm>
#include <cmath>

namespace pacini
{

/// The amplitude of an event's pulse where bands are levelled to `envelope`: it tops what they reach up to the event's
/// own amplitude, so that no energy is played twice. 0 when they reach it by themselves. The envelope is a mean over 10
/// ms: bands peak at up to twice its value.
[[nodiscard]] inline double pulseLevel(const Curve& envelope, const Transient& event) noexcept
{
    double reached = 0.0;
    for (const double after : {0.0, 0.005, 0.010})
        reached = std::max(reached, 2.0 * valueAt(envelope, event.time + after));
    return std::sqrt(std::max(event.amplitude * event.amplitude - reached * reached, 0.0));
}

} // namespace pacini
