#pragma once

// A straightforward player of .haps files.

#include "io/formats/players/VoicePlayer.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace pacini::test
{

/// All notes of the vibration; a transient is two periods within its 22 ms, as in MPEG's synthesiser, which is by the
/// same people.
inline std::vector<float> playHaps(const std::string& text, double seconds, double fs)
{
    const auto vibration = nlohmann::json::parse(text).at("m_vibration");
    std::vector<float> samples(static_cast<std::size_t>(std::lround(seconds * fs)));
    for (const auto& melody : vibration.at("m_melodies"))
        for (const auto& note : melody.at("m_notes"))
        {
            const auto& effect = note.at("m_hapticEffect");
            const double start = note.at("m_startingPoint").get<double>();
            const double gain = note.at("m_gain").get<double>();
            if (effect.contains("m_type"))
            {
                const double length = note.at("m_length").get<double>();
                addPulse(samples, start, gain, 2.0 / length, 2.0, fs);
                continue;
            }
            const auto pointsOf = [&](const char* name)
            {
                PlayerPoints points;
                for (const auto& keyframe : effect.at(name).at("m_keyframes"))
                    points.emplace_back(keyframe.at("m_time").get<double>(), keyframe.at("m_value").get<double>());
                return points;
            };
            const auto wave = playVoice(pointsOf("m_amplitudeModulation"), pointsOf("m_frequencyModulation"),
                                        note.at("m_length").get<double>(), fs);
            const auto first = static_cast<std::size_t>(std::lround(start * fs));
            for (std::size_t n = 0; n < std::min(wave.size(), samples.size() - first); ++n)
                samples[first + n] += static_cast<float>(gain) * wave[n];
        }
    return samples;
}

} // namespace pacini::test
