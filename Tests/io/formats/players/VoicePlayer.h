#pragma once

// What the players of one-voice formats share: a sinusoid along points.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace pacini::test
{

using PlayerPoints = std::vector<std::pair<double, double>>; // s, value

/// Reads points at times that move forward: straight between them, held outside.
class PointReader
{
public:
    explicit PointReader(const PlayerPoints& pointsToRead) : points(pointsToRead) {}

    double at(double time)
    {
        while (next < points.size() && points[next].first <= time)
            ++next;
        if (next == 0)
            return points.front().second;
        if (next == points.size())
            return points.back().second;
        const auto& [t0, v0] = points[next - 1];
        const auto& [t1, v1] = points[next];
        return v0 + (v1 - v0) * (time - t0) / (t1 - t0);
    }

private:
    const PlayerPoints& points;
    std::size_t next = 0;
};

inline std::vector<float> playVoice(const PlayerPoints& amplitude, const PlayerPoints& frequency, double seconds,
                                    double fs)
{
    std::vector<float> samples(static_cast<std::size_t>(std::lround(seconds * fs)));
    PointReader level(amplitude), hertz(frequency);
    double phase = 0.0;
    for (std::size_t n = 0; n < samples.size(); ++n)
    {
        const double t = static_cast<double>(n) / fs;
        samples[n] = static_cast<float>(level.at(t) * std::sin(2.0 * std::numbers::pi * phase));
        phase += hertz.at(t) / fs;
    }
    return samples;
}

/// Adds `periods` of a sine from `start` s on.
inline void addPulse(std::vector<float>& samples, double start, double level, double frequency, double periods,
                     double fs)
{
    const auto first = static_cast<std::size_t>(std::lround(start * fs));
    const auto length = static_cast<std::size_t>(std::lround(periods / frequency * fs));
    for (std::size_t n = first; n < std::min(first + length, samples.size()); ++n)
        samples[n] += static_cast<float>(
            level * std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(n - first) / fs));
}

} // namespace pacini::test
