#pragma once

// A sound and a clip that the benchmarks share.

#include <pacini/analysis/Encoder.h>
#include <pacini/foundation/Random.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace pacini::benchmarks
{

/// `seconds` of struck tones over a little noise, five strokes per second: neither silence nor all noise, since the
/// time of simplifiers and coders depends on what they get.
inline std::vector<float> strokes(double seconds, double fs)
{
    Random random(1);
    std::vector<float> samples(static_cast<std::size_t>(seconds * fs));
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
        const double t = static_cast<double>(i) / fs;
        const double sinceStroke = std::fmod(t, 0.2);
        const double turn = 2.0 * std::numbers::pi * t;
        const double tones = std::sin(turn * 60.0) + 0.7 * std::sin(turn * (180.0 + 20.0 * std::sin(t))) +
                             0.5 * std::sin(turn * 440.0) + 0.3 * std::sin(turn * 910.0);
        samples[i] = static_cast<float>(0.4 * std::exp(-15.0 * sinceStroke) * tones + 0.01 * (random.uniform() - 0.5));
    }
    return samples;
}

/// What the encoder makes of ten seconds of it.
inline Clip strokesClip()
{
    Encoder encoder{EncoderParams{}};
    encoder.start(48000, 1);
    encoder.push(strokes(10.0, 48000.0));
    return encoder.finish();
}

} // namespace pacini::benchmarks
