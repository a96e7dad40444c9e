#pragma once

// Straightforward players of Android's effects in the JSON that is written for them.

#include "io/formats/players/VoicePlayer.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace pacini::test
{

/// Constant steps of a motor at `frequency` Hz.
inline std::vector<float> playAndroidWaveform(const std::string& text, double frequency, double fs)
{
    const auto effect = nlohmann::json::parse(text).at("waveform");
    PlayerPoints amplitude;
    double time = 0.0;
    for (std::size_t i = 0; i < effect.at("timings").size(); ++i)
    {
        const double level = effect.at("amplitudes").at(i).get<double>() / 255.0;
        amplitude.emplace_back(time, level);
        time += effect.at("timings").at(i).get<double>() / 1000.0;
        amplitude.emplace_back(time, level);
    }
    return playVoice(amplitude, {{0.0, frequency}}, time, fs);
}

/// Straight lines from 0 through the control points; `low` and `high` are the frequencies of sharpness 0 and 1.
inline std::vector<float> playAndroidEnvelope(const std::string& text, bool isBasic, double low, double high, double fs)
{
    const auto effect = nlohmann::json::parse(text).at(isBasic ? "basicEnvelope" : "waveformEnvelope");
    const auto hertz = [&](const nlohmann::json& value)
    {
        return isBasic ? low + (high - low) * value.get<double>() : value.get<double>();
    };
    PlayerPoints amplitude{{0.0, 0.0}};
    PlayerPoints frequency{{0.0, hertz(effect.at(isBasic ? "initialSharpness" : "initialFrequencyHz"))}};
    double time = 0.0;
    for (const auto& point : effect.at("controlPoints"))
    {
        time += point.at("durationMs").get<double>() / 1000.0;
        amplitude.emplace_back(time, point.at(isBasic ? "intensity" : "amplitude").get<double>());
        frequency.emplace_back(time, hertz(point.at(isBasic ? "sharpness" : "frequencyHz")));
    }
    return playVoice(amplitude, frequency, time, fs);
}

} // namespace pacini::test
