#pragma once

// Loudness and sharpness of a sound over time.

#include <pacini/evaluate/SourcePreparation.h>
#include <pacini/foundation/Result.h>
#include <pacini/foundation/Units.h>
#include <pacini/hearing/Loudness.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// One value each 2 ms.
struct HeardTrack
{
    static constexpr double rate = LoudnessMeter::rate; ///< Hz
    std::vector<float> loudness;                        ///< sone
    std::vector<float> sharpness;                       ///< acum, 0 in silence
};

namespace detail
{
/// The ear's memory makes loudness late by as much (best of 0 to 20 ms, over all ratings); frames of 2 ms.
inline constexpr std::size_t loudnessDelay = 3;

/// Mean square of the strongest 100 ms of `x`, or of all of it when it is shorter.
[[nodiscard]] inline double strongestPower(std::span<const float> x, double sampleRate) noexcept
{
    const std::size_t length = std::min(x.size(), static_cast<std::size_t>(0.1 * sampleRate));
    constexpr std::size_t steps = 10; // of the window
    const std::size_t hop = std::max<std::size_t>(1, length / steps);
    std::vector<double> sums;
    for (std::size_t i = 0; i + hop <= x.size(); i += hop)
    {
        double sum = 0.0;
        for (const float v : x.subspan(i, hop))
            sum += static_cast<double>(v) * static_cast<double>(v);
        sums.push_back(sum);
    }
    double strongest = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < sums.size(); ++i)
    {
        sum += sums[i] - (i >= steps ? sums[i - steps] : 0.0);
        strongest = std::max(strongest, sum / static_cast<double>(hop * std::min(i + 1, steps)));
    }
    return strongest;
}
} // namespace detail

/// What is heard of a mono sound at `sampleRate` Hz whose strongest 100 ms are played at `level` (dB SPL). Samples that
/// are not finite count as 0. `hop` as LoudnessMeter has it; levels each ms instead of half of it move a predicted
/// match by .01 of 100 and take two thirds of the time (`pacini bench match`). ErrorCode::invalidArgument for rates
/// that resample() does not take.
[[nodiscard]] inline Result<HeardTrack> heardTrack(std::span<const float> samples, int sampleRate,
                                                   Decibels level = Decibels(75.0),
                                                   std::size_t hop = 2 * LoudnessMeter::standardHop)
{
    auto pressure = resampleFinite(samples, sampleRate, static_cast<int>(LoudnessMeter::sampleRate));
    if (!pressure)
        return pressure.error();
    const double power = detail::strongestPower(*pressure, LoudnessMeter::sampleRate);
    HeardTrack track;
    if (!(power > 0.0))
        return track;
    const double gain = 20e-6 * level.gain() / std::sqrt(power);
    for (float& p : *pressure)
        p = static_cast<float>(gain * static_cast<double>(p));
    const auto keep = [&](double total, const LoudnessPattern& pattern)
    {
        track.loudness.push_back(static_cast<float>(total));
        track.sharpness.push_back(static_cast<float>(pattern.sharpness));
    };
    LoudnessMeter meter(hop);
    meter.process(*pressure, keep);
    meter.finish(keep);
    return track;
}

} // namespace pacini
