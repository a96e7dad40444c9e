#pragma once

// Average amplitude and pitch of each band of a clip over a short stretch of time.

#include "devices/HdRumble.h"

#include <pacini/clip/Clip.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace pacini::devices
{

/// One tone per band of a valid clip for the stretch of `length` seconds that starts at `start`: the root mean square
/// of the amplitude and the energy-weighted mean of the logarithm of the pitch, from 16 instants at equal distances.
/// A peak shorter than a packet is so heard in proportion to its energy instead of by chance. Outside the clip all is
/// silent. A silent band has its centre frequency. [worker]
[[nodiscard]] inline std::vector<RumbleTone> bandTones(const Clip& clip, Seconds start, Seconds length)
{
    constexpr int instants = 16;
    std::vector<RumbleTone> tones;
    tones.reserve(clip.bands.size());
    for (const Band& band : clip.bands)
    {
        double energy = 0.0;
        double weightedLog = 0.0;
        for (int i = 0; i < instants; ++i)
        {
            const double time = start.value + length.value * (i + 0.5) / instants;
            if (time < 0.0 || time > clip.duration)
                continue;
            const double amplitude = valueAt(band.amplitude, time);
            const double pitch = band.pitch.empty() ? band.centreFrequency : valueAt(band.pitch, time);
            energy += amplitude * amplitude;
            weightedLog += amplitude * amplitude * std::log(pitch);
        }
        const double pitch = energy > 0.0 ? std::exp(weightedLog / energy) : band.centreFrequency;
        tones.push_back({Hertz(pitch), std::sqrt(energy / instants)});
    }
    return tones;
}

} // namespace pacini::devices
