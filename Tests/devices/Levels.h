#pragma once

// Levels of drives and of what devices are sent, and how alike they are.

#include "devices/ControllerReports.h"
#include "devices/DecodeReport.h"
#include "devices/DecodeRumble.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <variant>
#include <vector>

namespace pacini::test
{

/// Levels of squares in steps of 1 ms, smoothed by a window of Hann, half as high as in its middle 25 ms beside it: a
/// box would let pass the ripple of the squares of low tones, which no level has.
inline std::vector<double> smoothed(const std::vector<double>& squares)
{
    constexpr int reach = 50;
    std::vector<double> levels;
    for (int i = 0; i < static_cast<int>(squares.size()); ++i)
    {
        double sum = 0.0;
        for (int k = std::max(i - reach, 0); k <= std::min(i + reach, static_cast<int>(squares.size()) - 1); ++k)
            sum += squares[static_cast<std::size_t>(k)] * (1.0 + std::cos(std::numbers::pi * (k - i) / reach));
        levels.push_back(std::sqrt(sum / (2.0 * reach)));
    }
    return levels;
}

/// The square of the level that a state means, of motors by the bytes of its report.
inline double squareOf(const devices::ControllerModel& model, const devices::RumbleState& state)
{
    if (const auto* sides = std::get_if<devices::SidesRumble>(&state))
    {
        const devices::RumbleTones tones = devices::decodeRumble(sides->left).value();
        return tones.high.amplitude * tones.high.amplitude + tones.low.amplitude * tones.low.amplitude;
    }
    if (std::holds_alternative<devices::MotorLevels>(state))
    {
        const devices::MotorLevels motors = toldLevels(model, devices::reportOf(model, state, 0));
        return motors.strong * motors.strong + motors.weak * motors.weak;
    }
    const auto& waveform = std::get<devices::WaveformState>(state);
    return waveform.intensity * waveform.intensity;
}

inline double correlation(const std::vector<double>& a, const std::vector<double>& b)
{
    double sumA = 0.0, sumB = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
    const auto n = static_cast<double>(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        sumA += a[i];
        sumB += b[i];
        aa += a[i] * a[i];
        bb += b[i] * b[i];
        ab += a[i] * b[i];
    }
    return (ab - sumA * sumB / n) / std::sqrt((aa - sumA * sumA / n) * (bb - sumB * sumB / n));
}

} // namespace pacini::test
