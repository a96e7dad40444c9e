#pragma once

// Sounds with known events.

#include <pacini/foundation/Random.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace pacini::test
{

/// As many samples as `seconds` at fs hold, all 0.
inline std::vector<float> silence(double seconds, double fs)
{
    return std::vector<float>(static_cast<std::size_t>(std::floor(seconds * fs + 0.5)), 0.0f);
}

/// Adds a drum stroke at `time`, which falls from 200 to 50 Hz in some 0.1 s and dies away with 0.12 s.
inline void addKick(std::vector<float>& sound, double time, double fs, double amplitude)
{
    const auto start = static_cast<std::size_t>(std::floor(time * fs + 0.5));
    double phase = 0.0;
    for (std::size_t i = 0; start + i < sound.size() && static_cast<double>(i) < 0.5 * fs; ++i)
    {
        const double t = static_cast<double>(i) / fs;
        sound[start + i] += static_cast<float>(amplitude * std::exp(-t / 0.12) * std::sin(phase));
        phase += 2.0 * std::numbers::pi * (50.0 + 150.0 * std::exp(-t / 0.03)) / fs;
    }
}

/// Adds a click at `time`: 300 Hz that dies away with 2 ms.
inline void addClick(std::vector<float>& sound, double time, double fs, double amplitude)
{
    const auto start = static_cast<std::size_t>(std::floor(time * fs + 0.5));
    for (std::size_t i = 0; start + i < sound.size() && static_cast<double>(i) < 0.02 * fs; ++i)
    {
        const double t = static_cast<double>(i) / fs;
        sound[start + i] +=
            static_cast<float>(amplitude * std::exp(-t / 0.002) * std::cos(2.0 * std::numbers::pi * 300.0 * t));
    }
}

/// Eight strokes, one every half second from 0.25 s on.
inline std::vector<float> eightKicks(double fs, double amplitude)
{
    auto sound = silence(4.5, fs);
    for (int i = 0; i < 8; ++i)
        addKick(sound, 0.25 + 0.5 * i, fs, amplitude);
    return sound;
}

/// Noise whose amplitude swells and fades between 0.08 and 0.4, `rate` times a second.
inline std::vector<float> swellingNoise(double seconds, double fs, double rate, std::uint64_t seed)
{
    auto sound = silence(seconds, fs);
    Random random(seed);
    for (std::size_t n = 0; n < sound.size(); ++n)
    {
        const double turn = 2.0 * std::numbers::pi * rate * static_cast<double>(n) / fs;
        sound[n] = static_cast<float>(random.uniform(-0.4, 0.4) * (0.6 + 0.4 * std::sin(turn)));
    }
    return sound;
}

} // namespace pacini::test
