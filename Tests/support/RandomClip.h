#pragma once

// Clips with everything in them, for round trips.

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace pacini::test
{

/// A valid clip that uses every member; numbers have all their digits, times repeat now and then (steps).
inline Clip randomFullClip(std::uint64_t seed, std::size_t pointsPerCurve = 20)
{
    Random random(seed);
    Clip clip;
    clip.duration = random.uniform(0.1, 60.0);

    const auto times = [&](std::size_t count)
    {
        std::vector<double> all(count);
        for (double& t : all)
            t = random.uniform(0.0, clip.duration);
        std::sort(all.begin(), all.end());
        for (std::size_t i = 1; i < count; ++i)
            if (random.next() % 8 == 0)
                all[i] = all[i - 1];
        return all;
    };
    const auto curve = [&](double low, double high)
    {
        Curve points;
        for (double t : times(random.next() % (pointsPerCurve + 1)))
            points.push_back({t, random.uniform(low, high)});
        return points;
    };

    clip.name = "Zwölf \"Töne\" \\ 触覚 \xF0\x9F\x8E\xB5\n\t\x01 " + std::to_string(seed);
    clip.source = {"dir/ä\u2028.wav", 48000.0 + 0.5 * static_cast<double>(seed % 3), static_cast<int>(seed % 9)};
    clip.encoder = {{"method", std::string("a2vt")},
                    {"bands", 6.0},
                    {"adaptive", true},
                    {"", false},
                    {"threshold", random.uniform(-1e-300, 1e-300)},
                    {"largest", 1.7976931348623157e308},
                    {"smallest", 5e-324},
                    {"integer", -9007199254740993.0}};
    clip.envelope = curve(0.0, 1.0);
    clip.centroid = curve(0.0, 1000.0);
    for (std::uint64_t i = random.next() % 9; i > 0; --i)
    {
        Band band;
        band.lowFrequency = random.uniform(20.0, 900.0);
        band.centreFrequency = random.uniform(band.lowFrequency, 1000.0);
        band.highFrequency = random.uniform(band.centreFrequency, 1100.0);
        band.priority = static_cast<int>(random.next() % 20) - 3;
        band.amplitude = curve(0.0, 2.0);
        band.pitch = curve(1.0, 1000.0);
        clip.bands.push_back(band);
    }
    for (double t : times(random.next() % 10))
        clip.transients.push_back({t, random.uniform(0.0, 2.0), random.uniform()});
    for (std::uint64_t i = random.next() % 4; i > 0; --i)
    {
        const double low = random.uniform(20.0, 500.0);
        clip.noise.push_back({low, random.uniform(low, 1000.0), curve(0.0, 0.1)});
    }
    for (double t : times(random.next() % 5))
        clip.markers.push_back({t, "marker \x7F " + std::to_string(t)});
    return clip;
}

} // namespace pacini::test
