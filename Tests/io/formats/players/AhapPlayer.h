#pragma once

// A straightforward player of AHAP files: continuous events are sinusoids of 65 to 300 Hz, transients two periods of
// one, amplitudes the squares of intensities; parameters and curves act on all events of a file.

#include "io/formats/players/HapticPlayer.h"

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

struct AhapEvent
{
    double time = 0.0, duration = 0.0, intensity = 1.0, sharpness = 0.5;
    bool transient = false;
};

/// A file as a player sees it.
struct AhapPattern
{
    std::vector<AhapEvent> events;
    std::vector<PlayerCurve> intensity, sharpness; ///< curves in absolute times, by start
};

inline AhapPattern parseAhap(const std::string& text)
{
    AhapPattern pattern;
    const auto file = nlohmann::json::parse(text);
    for (const auto& entry : file.at("Pattern"))
        if (entry.contains("Event"))
        {
            const auto& event = entry["Event"];
            AhapEvent read;
            read.time = event.at("Time").get<double>();
            read.duration = event.value("EventDuration", 0.0);
            read.transient = event.at("EventType") == "HapticTransient";
            for (const auto& parameter : event.at("EventParameters"))
                (parameter.at("ParameterID") == "HapticIntensity" ? read.intensity : read.sharpness) =
                    parameter.at("ParameterValue").get<double>();
            pattern.events.push_back(read);
        }
        else
        {
            const auto& curve = entry.at("ParameterCurve");
            PlayerCurve points;
            for (const auto& point : curve.at("ParameterCurveControlPoints"))
                points.emplace_back(curve.at("Time").get<double>() + point.at("Time").get<double>(),
                                    point.at("ParameterValue").get<double>());
            (curve.at("ParameterID") == "HapticIntensityControl" ? pattern.intensity : pattern.sharpness)
                .push_back(std::move(points));
        }
    return pattern;
}

/// The value of the last curve that has begun.
inline double controlAt(const std::vector<PlayerCurve>& curves, double time, double otherwise)
{
    const auto next = std::upper_bound(curves.begin(), curves.end(), time,
                                       [](double t, const PlayerCurve& curve) { return t < curve.front().first; });
    return next == curves.begin() ? otherwise : playerValue(*std::prev(next), time, otherwise);
}

/// Adds what one file plays to `samples`, which are at `fs` Hz.
inline void playAhap(const AhapPattern& pattern, double fs, std::vector<float>& samples)
{
    double phase = 0.0;
    for (const AhapEvent& event : pattern.events)
    {
        const auto hertz = [&](double time)
        {
            return 65.0 + 235.0 * std::clamp(event.sharpness + controlAt(pattern.sharpness, time, 0.0), 0.0, 1.0);
        };
        const auto strength = [&](double time)
        {
            return std::pow(event.intensity * controlAt(pattern.intensity, time, 1.0), 2.0);
        };
        if (event.transient)
            phase = 0.0;
        const double length = event.transient ? 2.0 / hertz(event.time) : event.duration;
        for (auto n = static_cast<std::size_t>(std::ceil(event.time * fs)); n < samples.size(); ++n)
        {
            const double time = static_cast<double>(n) / fs;
            if (time >= event.time + length)
                break;
            const double level = strength(event.transient ? event.time : time);
            samples[n] += static_cast<float>(level * std::sin(2.0 * std::numbers::pi * phase));
            phase += hertz(event.transient ? event.time : time) / fs;
        }
    }
}

inline void playAhap(const std::string& text, double fs, std::vector<float>& samples)
{
    playAhap(parseAhap(text), fs, samples);
}

} // namespace pacini::test
