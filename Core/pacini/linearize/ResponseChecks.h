#pragma once

// Plausibility checks of responses: detect faults of their recordings.

#include <pacini/linearize/LevelAnalysis.h>
#include <pacini/linearize/RecordingChecks.h>
#include <pacini/linearize/ResponseSmoothing.h>
#include <pacini/linearize/Sweep.h>
#include <pacini/linearize/SweepMeasurement.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

/// A frequency with its unit, for messages: `23.5 Hz`, `440 Hz`.
[[nodiscard]] inline std::string hertzText(double f)
{
    return f < 100.0
               ? std::to_string(std::lround(f * 10.0) / 10) + "." + std::to_string(std::lround(f * 10.0) % 10) + " Hz"
               : std::to_string(std::lround(f)) + " Hz";
}

/// Channels with noise only, and channels that carry the drive: nothing mechanical moves at the same acceleration from
/// the lowest to the highest frequency, unless it is equalized.
inline void warnOfResponses(std::span<const NoisyPower> channels, const SweepParams& params, bool equalized,
                            std::vector<MeasurementWarning>& warnings)
{
    constexpr double octaves = 1.0 / 6.0;
    for (std::size_t c = 0; c < channels.size(); ++c)
    {
        const bool known =
            std::any_of(warnings.begin(), warnings.end(),
                        [&](const MeasurementWarning& warning) {
                            return warning.code == MeasurementDefect::silentChannel && warning.where == channelPath(c);
                        });
        if (known)
            continue;
        const SmoothedPower power(channels[c].frequency, channels[c].power);
        const SmoothedPower noise(channels[c].frequency, channels[c].noise);
        std::vector<double> ratio;
        double least = std::numeric_limits<double>::max();
        double most = 0.0;
        for (const double f : logSpaced(1.2 * params.lowFrequency, params.highFrequency / 1.2, 60))
        {
            const double p = power.at(f, octaves);
            ratio.push_back(p / std::max(noise.at(f, octaves), 1e-300));
            least = std::min(least, p);
            most = std::max(most, p);
        }
        std::nth_element(ratio.begin(), ratio.begin() + 30, ratio.end());
        if (ratio[30] < 2.0)
            warnings.push_back(
                {MeasurementDefect::noiseChannel, channelPath(c),
                 "has noise but no response; turn its axis along the movement, or connect the sensor to this input"});
        else if (!equalized && ratio[30] > 100.0 && most < std::pow(10.0, 0.1) * least)
            warnings.push_back({MeasurementDefect::loopback, channelPath(c),
                                "is flat within 1 dB: it contains the drive, not a movement"});
    }
}

/// Warns of ranges with a low signal-to-noise ratio, one warning for each.
inline void warnOfSnr(const FrequencyResponse& snr, double wanted, std::vector<MeasurementWarning>& warnings)
{
    for (std::size_t i = 0; i < snr.size();)
    {
        if (snr.level[i] >= wanted)
        {
            ++i;
            continue;
        }
        std::size_t end = i;
        double least = snr.level[i];
        for (; end < snr.size() && snr.level[end] < wanted; ++end)
            least = std::min(least, snr.level[end]);
        std::string range = "at every frequency";
        if (i == 0 && end < snr.size())
            range = "below " + hertzText(snr.frequency[end]);
        else if (i > 0)
            range = end == snr.size()
                        ? "above " + hertzText(snr.frequency[i - 1])
                        : "from " + hertzText(snr.frequency[i]) + " to " + hertzText(snr.frequency[end - 1]);
        warnings.push_back({MeasurementDefect::lowSnr, range,
                            "the signal is down to " + std::to_string(std::lround(least)) +
                                " dB over the noise; drive harder, or play longer or more sweeps"});
        i = end;
    }
}

} // namespace pacini
