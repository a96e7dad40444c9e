#pragma once

// A straightforward player of .tact files: one motor.

#include "io/formats/players/VoicePlayer.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace pacini::test
{

/// The left forearm's motor at `frequency` Hz.
inline std::vector<float> playTact(const std::string& text, double frequency, double fs)
{
    const auto root = nlohmann::json::parse(text);
    const auto& effect = root.at("project").at("tracks").at(0).at("effects").at(0);
    const double end = root.at("durationMillis").get<double>() / 1000.0;
    PlayerPoints amplitude{{0.0, 0.0}};
    for (const auto& feedback : effect.at("modes").at("ForearmL").at("dotMode").at("feedback"))
    {
        const double from = feedback.at("startTime").get<double>() / 1000.0;
        const double to = feedback.at("endTime").get<double>() / 1000.0;
        const double level = feedback.at("pointList").at(0).at("intensity").get<double>();
        amplitude.insert(amplitude.end(), {{from, 0.0}, {from, level}, {to, level}, {to, 0.0}});
    }
    amplitude.emplace_back(end, 0.0);
    return playVoice(amplitude, {{0.0, frequency}}, end, fs);
}

} // namespace pacini::test
