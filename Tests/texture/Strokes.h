#pragma once

// Made strokes over surfaces whose law is known.

#include <pacini/clip/Curve.h>
#include <pacini/foundation/Gaussian.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace pacini::test
{

/// Ridges, `perUnit` of which pass in a second at speed 1, with uneven distances, and a rough ground: all frequencies
/// are proportional to the speed, and the level to its square root.
inline std::vector<float> ridges(const Curve& speed, double seconds, double fs, std::uint64_t seed,
                                 double perUnit = 200.0)
{
    Gaussian random(seed);
    std::vector<float> samples(static_cast<std::size_t>(seconds * fs));
    double phase = 0.0;
    for (std::size_t n = 0; n < samples.size(); ++n)
    {
        const double v = valueAt(speed, static_cast<double>(n) / fs);
        phase += perUnit * v / fs + 0.02 * std::sqrt(perUnit * v / fs) * random.next();
        samples[n] =
            static_cast<float>(0.1 * std::sqrt(v) * (std::sin(2.0 * std::numbers::pi * phase) + 0.1 * random.next()));
    }
    return samples;
}

/// Noise around 150 Hz whatever the speed, with a level proportional to that.
inline std::vector<float> river(const Curve& speed, double seconds, double fs, std::uint64_t seed)
{
    Gaussian random(seed);
    const double radius = std::exp(-2.0 * std::numbers::pi * 40.0 / fs);
    const double turn = 2.0 * radius * std::cos(2.0 * std::numbers::pi * 150.0 / fs);
    std::vector<float> samples(static_cast<std::size_t>(seconds * fs));
    double one = 0.0, two = 0.0;
    for (std::size_t n = 0; n < samples.size(); ++n)
    {
        const double x = random.next() + turn * one - radius * radius * two;
        two = one;
        one = x;
        samples[n] = static_cast<float>(0.01 * valueAt(speed, static_cast<double>(n) / fs) * x);
    }
    return samples;
}

} // namespace pacini::test
