#pragma once

// Result of a sweep measurement: response, noise and distortion of an actuator.

#include <pacini/foundation/Result.h>
#include <pacini/linearize/FrequencyResponse.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pacini
{

/// Possible defect of a recording whose result is still usable.
enum class MeasurementDefect
{
    clipping,      ///< samples at the limit of the recording range
    droppedFrames, ///< frames got lost or came twice
    silentChannel, ///< a channel without any change
    noiseChannel,  ///< a channel with noise only
    loopback,      ///< a channel that carries the drive itself
    clockDrift,    ///< player and recorder run at different rates; has been corrected
    lowSnr,        ///< noise near the signal or above it
};

/// A defect, its place and its text.
struct MeasurementWarning
{
    MeasurementDefect code = MeasurementDefect::lowSnr;
    std::string where; ///< such as `channels[1]`
    std::string message;
    bool operator==(const MeasurementWarning&) const = default;
};

/// A harmonic over the frequency of the drive.
struct HarmonicResponse
{
    int order = 2;
    FrequencyResponse response; ///< dB re the fundamental at the same drive; as far as the recording holds the harmonic
};

/// The results of one level step. All lists have the same frequencies, harmonics fewer of them.
struct LevelMeasurement
{
    double level = 0.0;         ///< dB re full scale of the drive
    FrequencyResponse response; ///< dB re 1 m/s^2 at a drive of 1: over all axes the root of the sum of squares
    FrequencyResponse noise;    ///< dB, the level that noise alone would show as a response
    FrequencyResponse snr;      ///< dB
    std::vector<HarmonicResponse> harmonics;
    std::vector<double> distortion; ///< % of the fundamental, over all harmonics recorded
};

/// Impulse response h at lags from -origin on, along the direction in which the device moves most.
struct ImpulseResponse
{
    double sampleRate = 0.0;     ///< Hz
    std::size_t origin = 0;      ///< index of the arrival
    std::vector<double> samples; ///< m/s^2 at a drive of 1, per sample
};

/// Result of a sweep measurement.
struct SweepMeasurement
{
    std::vector<LevelMeasurement> levels; ///< in the order of SweepParams::levels
    std::size_t main = 0;                 ///< the loudest of them, which noise disturbs least
    ImpulseResponse impulseResponse;      ///< of the loudest
    std::vector<double> groupDelay;       ///< s at the frequencies of response(), after the arrival that latency means
    double latency = 0.0;           ///< s of the recorder from its first frame to the arrival of what was played first:
                                    ///< where the impulse response is strongest
    std::optional<double> driftPpm; ///< above 0 when the recorder's clock is the faster one; unknown after a single
                                    ///< sweep without markers
    std::vector<MeasurementWarning> warnings;

    [[nodiscard]] const FrequencyResponse& response() const { return levels[main].response; }
};

/// Subtracts `gain`, the level of the played sweep above its parameters, dB, from the levels.
inline void takeOut(SweepMeasurement& measurement, double gain) noexcept
{
    for (LevelMeasurement& level : measurement.levels)
        for (FrequencyResponse* one : {&level.response, &level.noise})
            for (double& value : one->level)
                value -= gain;
}

/// The largest distortion, %, from `low` to `high` Hz; 0 without points there.
[[nodiscard]] inline double largestDistortion(const LevelMeasurement& level, double low, double high) noexcept
{
    double largest = 0.0;
    for (std::size_t i = 0; i < level.distortion.size(); ++i)
        if (level.response.frequency[i] >= low && level.response.frequency[i] <= high)
            largest = std::max(largest, level.distortion[i]);
    return largest;
}

/// The strongest point of one harmonic.
struct HarmonicPeak
{
    int order = 2;
    double level = 0.0;     ///< dB re the fundamental
    double frequency = 0.0; ///< Hz, of the drive
};

/// The strongest point of each order from `low` to `high` Hz, in rising order; none for an order without points there.
[[nodiscard]] inline std::vector<HarmonicPeak> harmonicPeaks(const LevelMeasurement& level, double low, double high)
{
    std::vector<HarmonicPeak> peaks;
    for (const HarmonicResponse& harmonic : level.harmonics)
    {
        std::optional<HarmonicPeak> peak;
        for (std::size_t i = 0; i < harmonic.response.size(); ++i)
            if (const double f = harmonic.response.frequency[i];
                f >= low && f <= high && (!peak || harmonic.response.level[i] > peak->level))
                peak = {harmonic.order, harmonic.response.level[i], f};
        if (peak)
            peaks.push_back(*peak);
    }
    return peaks;
}

/// The drive, dB re full scale, from which on the largest distortion between `low` and `high` Hz is above `limit` %:
/// between the two level steps around it by a straight line of log distortion over level. Steps are followed from the
/// strongest down, since noise distorts the weakest. Nothing when the strongest step is below the limit; the weakest
/// step when all are above it.
[[nodiscard]] inline std::optional<double> driveAtDistortion(const SweepMeasurement& measurement, double limit,
                                                             double low, double high)
{
    struct Step
    {
        double level;
        double distortion;
    };
    std::vector<Step> steps;
    for (const LevelMeasurement& level : measurement.levels)
        steps.push_back({level.level, largestDistortion(level, low, high)});
    std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.level > b.level; });
    if (steps.empty() || steps.front().distortion < limit)
        return std::nullopt;
    std::size_t above = 0;
    while (above + 1 < steps.size() && steps[above + 1].distortion >= limit)
        ++above;
    if (above + 1 == steps.size() || !(steps[above + 1].distortion > 0.0) || !(limit > 0.0))
        return steps[above].level;
    const Step& upper = steps[above];
    const Step& lower = steps[above + 1];
    const double part = std::log(limit / lower.distortion) / std::log(upper.distortion / lower.distortion);
    return lower.level + part * (upper.level - lower.level);
}

} // namespace pacini
