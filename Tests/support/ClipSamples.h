#pragma once

// Clips to test with.

#include <pacini/clip/PackedClip.h>
#include <pacini/foundation/Random.h>

namespace pacini::test
{

/// A curve with random gaps and values; `steps` lets points share a time.
inline Curve randomCurve(Random& random, double duration, std::size_t points, double low, double high, bool steps)
{
    Curve curve;
    for (std::size_t i = 0; i < points; ++i)
        curve.push_back({random.uniform(0.0, duration), random.uniform() < 0.1 ? low : random.uniform(low, high)});
    std::sort(curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    if (steps && curve.size() > 2)
        curve[1].time = curve[0].time;
    return curve;
}

/// One band at `hertz`, `level` for all of the time.
inline Clip steadyClip(double hertz, double level, double seconds)
{
    Clip clip;
    clip.duration = seconds;
    clip.bands = {{hertz, hertz, hertz, 0, {{0.0, level}}, {}}};
    return clip;
}

/// A valid clip of any shape, on no grid.
inline Clip randomClip(std::uint64_t seed)
{
    Random random(seed);
    Clip clip;
    clip.duration = random.uniform(0.0, 5.0);
    if (random.uniform() < 0.5)
    {
        clip.source = {"sound " + std::to_string(seed) + ".wav", 48000.0, 2};
        clip.duration = std::round(clip.duration * 48000.0) / 48000.0;
        clip.name = random.uniform() < 0.5 ? "sound " + std::to_string(seed) : "h\u00e4mmer = 1\n2";
    }
    clip.encoder = {
        {"method", std::string("a2vt")}, {"gain", random.uniform(0.0, 4.0)}, {"normalise", random.uniform() < 0.5}};
    const auto points = [&](double most)
    {
        return static_cast<std::size_t>(random.uniform(0.0, most));
    };
    // The order in which a compiler works out arguments is its own; this one is ours.
    const auto curve = [&](double mostPoints, double low, double high, double chanceOfSteps)
    {
        const bool steps = chanceOfSteps > 0.0 && random.uniform() < chanceOfSteps;
        const std::size_t count = points(mostPoints);
        return randomCurve(random, clip.duration, count, low, high, steps);
    };
    clip.envelope = curve(40.0, 0.0, 1.0, 0.3);
    clip.centroid = curve(10.0, 30.0, 900.0, 0.0);
    for (std::size_t k = points(9.0); k > 0; --k)
    {
        Band band;
        band.lowFrequency = random.uniform(10.0, 500.0);
        band.centreFrequency = band.lowFrequency * 1.1;
        band.highFrequency = band.lowFrequency * 1.3;
        band.priority = static_cast<int>(points(8.0));
        band.amplitude = curve(60.0, 0.0, 1.2, 0.3);
        band.pitch = curve(5.0, 20.0, 1000.0, 0.0);
        clip.bands.push_back(band);
    }
    for (const Breakpoint& p : randomCurve(random, clip.duration, points(20.0), 0.0, 1.0, true))
        clip.transients.push_back({p.time, p.value, random.uniform()});
    if (random.uniform() < 0.3)
        clip.noise.push_back({100.0, 200.5, curve(10.0, 0.0, 0.5, 0.0)});
    if (random.uniform() < 0.3)
        clip.markers = {{0.0, "start"}, {clip.duration, std::string("e\0nd\1", 5)}};
    return clip;
}

} // namespace pacini::test
