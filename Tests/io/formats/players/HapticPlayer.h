#pragma once

// A straightforward player of .haptic files, as the renderer for voice coils of the Meta haptics SDK is described: one
// sinusoid that follows both curves, and for each emphasis an oscillator of its own, while which the sinusoid is
// ducked.

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace pacini::test
{

struct HapticPlayerSettings
{
    double sampleRate = 8000.0; ///< Hz
    double low = 55.0;          ///< Hz at a frequency of 0
    double high = 200.0;        ///< Hz at 1
    double ducking = 0.5;       ///< gain of the sinusoid during an emphasis
    double dull = 55.0;         ///< Hz of the dullest emphasis, a sine
    double crisp = 165.0;       ///< Hz of the crispest, a square
    double dullLength = 0.0364; ///< s
    double crispLength = 0.0121;
};

/// A list of points as (time, value) pairs, read without the reader under test.
using PlayerCurve = std::vector<std::pair<double, double>>;

inline double playerValue(const PlayerCurve& curve, double time, double otherwise)
{
    if (curve.empty())
        return otherwise;
    if (time <= curve.front().first)
        return curve.front().second;
    for (std::size_t low = 0, high = curve.size();;)
    {
        // The last point at or before the time.
        const std::size_t middle = (low + high) / 2;
        if (high - low > 1)
        {
            (curve[middle].first <= time ? low : high) = middle;
            continue;
        }
        if (low + 1 == curve.size())
            return curve[low].second;
        const auto [t0, v0] = curve[low];
        const auto [t1, v1] = curve[low + 1];
        return v0 + (v1 - v0) * (time - t0) / (t1 - t0);
    }
}

struct HapticEmphasis
{
    double time = 0.0, amplitude = 0.0, sharpness = 0.0;
};

/// A file as a player sees it.
struct HapticSignal
{
    PlayerCurve amplitude, frequency; ///< 0 to 1
    std::vector<HapticEmphasis> emphases;
};

inline HapticSignal parseHaptic(const std::string& text)
{
    const auto file = nlohmann::json::parse(text);
    const auto& envelopes = file.at("signals").at("continuous").at("envelopes");
    HapticSignal signal;
    for (const auto& point : envelopes.at("amplitude"))
    {
        signal.amplitude.emplace_back(point.at("time").get<double>(), point.at("amplitude").get<double>());
        if (point.contains("emphasis"))
            signal.emphases.push_back({signal.amplitude.back().first, point["emphasis"].at("amplitude").get<double>(),
                                       point["emphasis"].at("frequency").get<double>()});
    }
    if (envelopes.contains("frequency"))
        for (const auto& point : envelopes["frequency"])
            signal.frequency.emplace_back(point.at("time").get<double>(), point.at("frequency").get<double>());
    return signal;
}

inline std::vector<float> playHaptic(const HapticSignal& signal, const HapticPlayerSettings& settings = {})
{
    const auto& [amplitude, frequency, emphases] = signal;
    const double fs = settings.sampleRate;
    std::vector<float> samples(static_cast<std::size_t>(std::ceil(amplitude.back().first * fs)));
    std::vector<double> pulses(samples.size(), 0.0);
    std::vector<bool> active(samples.size(), false);
    for (std::size_t e = 0; e < emphases.size(); ++e)
    {
        const auto& [time, strength, sharpness] = emphases[e];
        const double hertz = settings.dull + (settings.crisp - settings.dull) * sharpness;
        const double length = settings.dullLength + (settings.crispLength - settings.dullLength) * sharpness;
        double end = time + length;
        if (e + 1 < emphases.size()) // the next one takes over
            end = std::min(end, emphases[e + 1].time);
        for (auto n = static_cast<std::size_t>(std::ceil(time * fs)); n < samples.size(); ++n)
        {
            const double t = static_cast<double>(n) / fs - time;
            if (t + time >= end)
                break;
            const double sine = std::sin(2.0 * std::numbers::pi * hertz * t);
            const double square = sine >= 0.0 ? 1.0 : -1.0;
            pulses[n] = strength * (sine + sharpness * (square - sine));
            active[n] = true;
        }
    }
    double phase = 0.0;
    for (std::size_t n = 0; n < samples.size(); ++n)
    {
        const double time = static_cast<double>(n) / fs;
        const double level = playerValue(amplitude, time, 0.0) * (active[n] ? settings.ducking : 1.0);
        samples[n] = static_cast<float>(level * std::sin(2.0 * std::numbers::pi * phase) + pulses[n]);
        phase += (settings.low + (settings.high - settings.low) * playerValue(frequency, time, 0.5)) / fs;
        phase -= std::floor(phase);
    }
    return samples;
}

inline std::vector<float> playHaptic(const std::string& text, const HapticPlayerSettings& settings = {})
{
    return playHaptic(parseHaptic(text), settings);
}

} // namespace pacini::test
