#pragma once

// Loop unrolling: a loop as one long clip.

#include <pacini/clip/Clip.h>
#include <pacini/synthesis/Variation.h>
#include <pacini/synthesis/VariationSeed.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace pacini
{

namespace detail
{
/// Appends the first `length` seconds of `pass`, shifted by `at`; a step joins it to the existing points.
inline void appendPass(Curve& curve, const Curve& pass, double length, double at)
{
    if (pass.empty())
        return;
    curve.push_back({at, pass.front().value});
    for (const Breakpoint& point : pass)
        if (point.time > 0.0 && point.time < length)
            curve.push_back({at + point.time, point.value});
    curve.push_back({at + length, valueAt(pass, std::min(length, pass.back().time))});
}
} // namespace detail

/// The first `length` seconds of a clip (above 0), `passes` times one after the other, each with its own variation.
/// Sinusoids run on over the joints, so that a loop does not click; curves step there.
[[nodiscard]] inline Clip unrollLoop(const Clip& clip, double length, std::size_t passes,
                                     const VariationParams& variation)
{
    Clip result = clip;
    result.duration = length * static_cast<double>(passes);
    result.markers.clear();
    result.envelope.clear();
    result.centroid.clear();
    result.transients.clear();
    for (Band& band : result.bands)
    {
        band.amplitude.clear();
        band.pitch.clear();
    }
    for (NoiseBand& band : result.noise)
        band.amplitude.clear();
    for (std::size_t pass = 0; pass < passes; ++pass)
    {
        const double at = length * static_cast<double>(pass);
        VariationParams own = variation;
        own.seed = seedOfPlay(variation.seed, pass);
        const Clip varied = vary(clip, own);
        detail::appendPass(result.envelope, varied.envelope, length, at);
        detail::appendPass(result.centroid, varied.centroid, length, at);
        for (std::size_t k = 0; k < result.bands.size(); ++k)
        {
            detail::appendPass(result.bands[k].amplitude, varied.bands[k].amplitude, length, at);
            detail::appendPass(result.bands[k].pitch, varied.bands[k].pitch, length, at);
        }
        for (std::size_t k = 0; k < result.noise.size(); ++k)
            detail::appendPass(result.noise[k].amplitude, varied.noise[k].amplitude, length, at);
        for (Transient event : varied.transients)
            if (event.time < length)
            {
                event.time += at;
                result.transients.push_back(event);
            }
    }
    return result;
}

} // namespace pacini
