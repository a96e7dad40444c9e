#pragma once

// Voice reduction: many bands on few voices.

#include <pacini/clip/BandPriority.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/Portable.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace pacini
{

namespace detail
{
/// The times of both curves, in order, once each.
inline std::vector<double> joinedTimes(const Curve& a, const Curve& b)
{
    std::vector<double> times;
    times.reserve(a.size() + b.size());
    for (const Curve* curve : {&a, &b})
        for (const Breakpoint& point : *curve)
            times.push_back(point.time);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

/// One band of two, with phase 0: powers add, the pitch is the mean of both in octaves, weighted by power, so that
/// it is that of whichever sounds.
inline Band mergedBand(const Band& a, const Band& b)
{
    Band merged;
    merged.lowFrequency = std::min(a.lowFrequency, b.lowFrequency);
    merged.highFrequency = std::max(a.highFrequency, b.highFrequency);
    merged.centreFrequency = std::sqrt(a.centreFrequency * b.centreFrequency);
    merged.priority = std::min(a.priority, b.priority);
    CurveReader levelA(a.amplitude), levelB(b.amplitude), pitchA(a.pitch), pitchB(b.pitch);
    auto times = joinedTimes(a.amplitude, b.amplitude);
    for (const double t : joinedTimes(a.pitch, b.pitch))
        times.push_back(t);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    for (const double t : times)
    {
        const double x = levelA.at(t), y = levelB.at(t);
        const double fa = portable::log(a.pitch.empty() ? a.centreFrequency : pitchA.at(t));
        const double fb = portable::log(b.pitch.empty() ? b.centreFrequency : pitchB.at(t));
        const double power = x * x + y * y;
        merged.amplitude.push_back({t, std::sqrt(power)});
        merged.pitch.push_back({t, portable::exp(power > 0.0 ? (x * x * fa + y * y * fb) / power : 0.5 * (fa + fb))});
    }
    return merged;
}
} // namespace detail

/// Leaves at most `voices` (1 or more) bands. The least important band (the highest priority number, then the least
/// energy) repeatedly joins its neighbour in frequency, at the phase of the stronger. A band without a voice is thus
/// heard in another's, which loses less than leaving it out.
inline void mergeVoices(Clip& clip, std::size_t voices)
{
    auto& bands = clip.bands;
    std::sort(bands.begin(), bands.end(),
              [](const Band& a, const Band& b) { return a.centreFrequency < b.centreFrequency; });
    std::vector<double> energies;
    for (const Band& band : bands)
        energies.push_back(curveEnergy(band.amplitude, clip.duration));
    while (bands.size() > std::max<std::size_t>(voices, 1))
    {
        std::size_t least = 0;
        for (std::size_t i = 1; i < bands.size(); ++i)
            if (bands[i].priority > bands[least].priority ||
                (bands[i].priority == bands[least].priority && energies[i] < energies[least]))
                least = i;
        const auto distance = [&](std::size_t i)
        {
            return std::abs(portable::log(bands[i].centreFrequency / bands[least].centreFrequency));
        };
        const bool joinsLower = least > 0 && (least + 1 == bands.size() || distance(least - 1) <= distance(least + 1));
        const std::size_t first = joinsLower ? least - 1 : least;
        const double phase = bands[energies[first + 1] > energies[first] ? first + 1 : first].phase;
        bands[first] = detail::mergedBand(bands[first], bands[first + 1]);
        bands[first].phase = phase;
        energies[first] += energies[first + 1];
        bands.erase(bands.begin() + static_cast<std::ptrdiff_t>(first + 1));
        energies.erase(energies.begin() + static_cast<std::ptrdiff_t>(first + 1));
    }
}

} // namespace pacini
