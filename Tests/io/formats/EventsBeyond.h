#pragma once

// How many events of a clip one voice does not reach by itself.

#include <pacini/clip/Clip.h>
#include <pacini/clip/Curve.h>

#include <algorithm>
#include <cstddef>

namespace pacini::test
{

/// Events above twice the envelope at their time and 5 and 10 ms later: it is a mean, the signal peaks at twice of it.
/// Clips that are one voice without an envelope keep all.
inline std::size_t eventsBeyond(const Clip& clip)
{
    if (clip.envelope.empty())
        return clip.transients.size();
    const auto isBeyond = [&](const Transient& event)
    {
        const double peak =
            2.0 * std::max({valueAt(clip.envelope, event.time), valueAt(clip.envelope, event.time + 0.005),
                            valueAt(clip.envelope, event.time + 0.010)});
        return event.amplitude > peak;
    };
    return static_cast<std::size_t>(std::count_if(clip.transients.begin(), clip.transients.end(), isBeyond));
}

} // namespace pacini::test
