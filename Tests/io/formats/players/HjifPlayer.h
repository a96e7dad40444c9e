#pragma once

// A straightforward player of HJIF files, from what is known of the reference synthesiser.

#include "VoicePlayer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace pacini::test
{

/// The first channel: the sum of its bands, cut to -1..1 after each, times its gain. Transients are two periods within
/// 22 ms whatever their frequency says; waves have straight amplitudes and chirps between keyframes and are silent
/// after the last.
inline std::vector<float> playHjif(const std::string& text, double fs)
{
    using Json = nlohmann::json;
    constexpr double tau = 2.0 * std::numbers::pi;
    const Json root = Json::parse(text);
    const double ticks = root.at("timescale").get<double>();
    const Json& channel = root.at("perceptions").at(0).at("channels").at(0);
    const double seconds = channel.at("sample_count").get<double>() / channel.at("frequency_sampling").get<double>();
    std::vector<double> sum(static_cast<std::size_t>(std::lround(seconds * fs)));
    const auto frameOf = [&](double tick)
    {
        return std::min(static_cast<std::size_t>(std::ceil(std::max(tick / ticks * fs - 1e-9, 0.0))), sum.size());
    };
    for (const Json& band : channel.at("bands"))
    {
        for (const Json& effect : band.at("effects"))
        {
            const double position = effect.at("position").get<double>();
            if (band.at("band_type") == "Transient")
            {
                const double length = 0.022;
                const double level = effect.at("keyframes").at(0).at("amplitude_modulation").get<double>();
                for (std::size_t n = frameOf(position); n < frameOf(position + length * ticks); ++n)
                    sum[n] += level * std::sin(2.0 * tau * (static_cast<double>(n) / fs - position / ticks) / length);
                continue;
            }
            PlayerPoints amplitude, frequency;
            for (const Json& keyframe : effect.at("keyframes"))
            {
                const double at = position + keyframe.at("relative_position").get<double>();
                if (keyframe.contains("amplitude_modulation"))
                    amplitude.emplace_back(at, keyframe.at("amplitude_modulation").get<double>());
                if (keyframe.contains("frequency_modulation"))
                    frequency.emplace_back(at, keyframe.at("frequency_modulation").get<double>());
            }
            PointReader level(amplitude), hertz(frequency);
            double phase = effect.at("phase").get<double>();
            const double end = position + effect.at("keyframes").back().at("relative_position").get<double>();
            for (std::size_t n = frameOf(position); n < frameOf(end); ++n)
            {
                const double t = static_cast<double>(n) / fs * ticks;
                sum[n] += level.at(t) * std::sin(phase);
                phase += tau * hertz.at(t) / fs;
            }
        }
        for (double& sample : sum)
            sample = std::clamp(sample, -1.0, 1.0);
    }
    std::vector<float> samples;
    for (const double sample : sum)
        samples.push_back(static_cast<float>(channel.at("gain").get<double>() * sample));
    return samples;
}

} // namespace pacini::test
