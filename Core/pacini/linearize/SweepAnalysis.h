#pragma once

// From a recording of sweeps to responses: the whole way.

#include <pacini/linearize/LevelAnalysis.h>
#include <pacini/linearize/RecordingChecks.h>
#include <pacini/linearize/SweepLocator.h>
#include <pacini/linearize/SweepTiming.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

namespace detail
{
/// The channels' impulse responses along the direction of most energy: the eigenvector of their 3 x 3 covariance, with
/// the sign of its largest component.
[[nodiscard]] inline ImpulseResponse strongestDirection(std::span<const ResponseCut> channels, double rate)
{
    const auto n = static_cast<Eigen::Index>(channels.size());
    Eigen::MatrixXd covariance(n, n);
    for (Eigen::Index a = 0; a < n; ++a)
        for (Eigen::Index b = 0; b < n; ++b)
        {
            const auto& x = channels[static_cast<std::size_t>(a)].samples;
            const auto& y = channels[static_cast<std::size_t>(b)].samples;
            double sum = 0.0;
            for (std::size_t i = 0; i < x.size(); ++i)
                sum += x[i] * y[i];
            covariance(a, b) = sum;
        }
    Eigen::VectorXd direction = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(covariance).eigenvectors().col(n - 1);
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    if (direction(largest) < 0.0)
        direction = -direction;
    ImpulseResponse out{rate, static_cast<std::size_t>(-channels.front().firstLag), {}};
    out.samples.assign(channels.front().samples.size(), 0.0);
    for (Eigen::Index c = 0; c < n; ++c)
        for (std::size_t i = 0; i < out.samples.size(); ++i)
            out.samples[i] += direction(c) * channels[static_cast<std::size_t>(c)].samples[i];
    return out;
}

/// The lag, s, of the largest envelope (magnitude of the analytic signal), between samples by a parabola.
[[nodiscard]] inline double strongestLag(const ImpulseResponse& response)
{
    const std::size_t size = nextFastFftSize(2 * response.samples.size());
    SplitFft<double> fft(size);
    SplitArray<double> time(size);
    SplitArray<double> bins(size);
    std::copy(response.samples.begin(), response.samples.end(), time.re.begin());
    fft.forward(time.re.data(), time.im.data(), bins.re.data(), bins.im.data());
    for (std::size_t k = size / 2 + 1; k < size; ++k)
        bins.re[k] = bins.im[k] = 0.0;
    fft.inverse(bins.re.data(), bins.im.data(), time.re.data(), time.im.data());
    const auto envelope = [&](std::size_t i)
    {
        return std::hypot(time.re[i], time.im[i]);
    };
    std::size_t best = 0;
    for (std::size_t i = 1; i < response.samples.size(); ++i)
        if (envelope(i) > envelope(best))
            best = i;
    double fraction = 0.0;
    if (best > 0 && best + 1 < response.samples.size())
    {
        const double bend = envelope(best - 1) - 2.0 * envelope(best) + envelope(best + 1);
        if (bend < 0.0)
            fraction = 0.5 * (envelope(best - 1) - envelope(best + 1)) / bend;
    }
    return (static_cast<double>(best) + fraction - static_cast<double>(response.origin)) / response.sampleRate;
}

[[nodiscard]] inline std::string hertzText(double f)
{
    return f < 100.0
               ? std::to_string(std::lround(f * 10.0) / 10) + "." + std::to_string(std::lround(f * 10.0) % 10) + " Hz"
               : std::to_string(std::lround(f)) + " Hz";
}

/// Channels with noise only, and channels that carry the drive: nothing mechanical moves at the same acceleration from
/// the lowest to the highest frequency.
inline void warnOfResponses(std::span<const NoisyPower> channels, const SweepParams& params,
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
            warnings.push_back({MeasurementDefect::noiseChannel, channelPath(c),
                                "has noise but no response; check which input the sensor is connected to"});
        else if (ratio[30] > 100.0 && most < std::pow(10.0, 0.1) * least)
            warnings.push_back({MeasurementDefect::loopback, channelPath(c),
                                "is flat within 1 dB: it carries the drive, not a movement"});
    }
}

/// Where the signal stands out too little, one warning for each range.
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
} // namespace detail

/// Analyses what 1 to 3 channels recorded of makeSweepSignal(params): an accelerometer's axes in any orientation, or a
/// microphone. `recordingRate` is a whole number of Hz, which may differ from that of the playback. The recording may
/// start and end whenever, as long as every sweep is in it.
///
/// Errors: those of the parameters (`sweep.` or `measurement.` before their path) and of checkRecording();
/// invalidArgument at `sampleRate` for one that cannot hold the sweep, invalidData there for a recording that was made
/// at another rate than it is said to be; invalidData at `channels` without any sweep in it; truncated at `sweeps[k]`
/// for one that is not in the recording as a whole; invalidData at `clock` for a drift beyond measurement.driftLimit.
[[nodiscard]] inline Result<SweepMeasurement> analyseSweeps(std::span<const std::vector<float>> channels,
                                                            double recordingRate, const SweepParams& params,
                                                            const MeasurementParams& measurement = {})
{
    const auto within = [](Error error, const char* prefix)
    {
        error.where = prefix + error.where;
        return error;
    };
    if (auto valid = validate(params); !valid)
        return within(valid.error(), "sweep.");
    if (auto valid = checkRecording(channels); !valid)
        return valid.error();
    if (auto valid = validate(measurement, channels.size()); !valid)
        return within(valid.error(), "measurement.");
    if (!(recordingRate >= 2000.0 && recordingRate <= 384000.0) || recordingRate != std::floor(recordingRate))
        return Error{ErrorCode::invalidArgument, "sampleRate", "must be a whole number of 2000 to 384000 Hz"};
    if (params.highFrequency > 0.45 * recordingRate)
        return Error{ErrorCode::invalidArgument, "sampleRate", "is too low for the sweep's highest frequency"};
    const double low = std::max(measurement.lowFrequency, params.lowFrequency);
    const double high = std::min(measurement.highFrequency, params.highFrequency);
    if (!(high > 1.05 * low))
        return Error{ErrorCode::invalidArgument, "measurement.lowFrequency", "leaves nothing of the sweep's range"};
    const double recordedSeconds = static_cast<double>(channels.front().size()) / recordingRate;
    if (recordedSeconds < params.duration)
        return Error{ErrorCode::truncated, "channels",
                     "last " + secondsText(recordedSeconds) + ", one sweep lasts " + secondsText(params.duration)};

    SweepMeasurement result;
    warnOfChannels(channels, recordingRate, result.warnings);
    std::vector<double> scale(channels.size());
    for (std::size_t c = 0; c < scale.size(); ++c)
        scale[c] = measurement.fullScale[measurement.fullScale.size() == 1 ? 0 : c];
    const auto rate = static_cast<int>(recordingRate);
    const SweepSchedule schedule = makeSweepSchedule(params);

    const auto coarse = reduceRate(channels, rate, params.highFrequency, 2.5, scale);
    const auto position = locateSweeps(coarse, schedule, params.sampleRate, measuringSweep(params));
    // Noise reaches 2; a response that is spread over more than the ringing of anything asks for a closer look.
    constexpr double leastContrast = 5.0;
    if (position.contrast < leastContrast || position.focus < 0.7)
        if (const auto likelier = likelierRate(coarse, schedule, params, recordingRate, position))
            return Error{ErrorCode::invalidData, "sampleRate",
                         "is " + std::to_string(rate) + " Hz, but the recording was made at " +
                             std::to_string(std::lround(*likelier)) + " Hz"};
    if (position.contrast < leastContrast)
        return Error{ErrorCode::invalidData, "channels",
                     "hold no sweep that stands out of the noise; check cables, levels and the sweep's settings"};

    const SweepTiming timing = timeSweeps(coarse, params, schedule, position);
    for (std::size_t k = 0; k < schedule.sweeps.size(); ++k)
    {
        const double start = static_cast<double>(schedule.sweeps[k].startFrame) / params.sampleRate;
        constexpr double slack = 0.01; // s, what the position of the strongest moment leaves open
        if (timing.arrival(start) < -slack || timing.arrival(start + params.duration) > recordedSeconds + slack)
            return Error{ErrorCode::truncated, "sweeps[" + std::to_string(k) + "]",
                         "is not in the recording as a whole: it lasts from " + secondsText(timing.arrival(start)) +
                             " to " + secondsText(timing.arrival(start + params.duration)) + ", the recording " +
                             secondsText(recordedSeconds)};
    }
    if (timing.driftKnown)
    {
        result.driftPpm = 1e6 * timing.drift;
        const double ppm = std::abs(*result.driftPpm);
        const std::string text = std::to_string(std::lround(*result.driftPpm)) + " ppm";
        if (ppm > measurement.driftLimit)
            return Error{ErrorCode::invalidData, "clock",
                         "player and recorder differ by " + text + "; use one device for both, or set its rate right"};
        if (ppm > measurement.driftWarning)
            result.warnings.push_back({MeasurementDefect::clockDrift, "clock",
                                       "player and recorder differ by " + text + "; the result is corrected for it"});
    }
    for (const DelayStep& step : timing.steps)
        result.warnings.push_back({MeasurementDefect::droppedFrames, secondsText(timing.arrival(step.time)),
                                   std::to_string(std::lround(std::abs(step.seconds) * recordingRate)) + " frames " +
                                       (step.seconds < 0.0 ? "are missing" : "too many") +
                                       " about here; use larger buffers and measure again"});

    const double highest = std::min(measurement.harmonics * params.highFrequency, 0.45 * recordingRate);
    const auto recording = reduceRate(channels, rate, highest, 2.12, scale);
    const auto quiet = quietTimes(params, schedule, timing, recordedSeconds);
    std::vector<NoiseSpectrum> noise;
    for (std::size_t c = 0; c < channels.size(); ++c)
        noise.emplace_back(recording, c, quiet);
    const auto frequency = logSpaced(low, high, measurement.points);
    result.main =
        static_cast<std::size_t>(std::max_element(params.levels.begin(), params.levels.end()) - params.levels.begin());
    for (std::size_t i = 0; i < params.levels.size(); ++i)
    {
        const auto responses =
            analyseLevel(recording, params, schedule, timing, noise, i, measurement.harmonics, highest);
        result.levels.push_back(summariseLevel(responses, params.levels[i], frequency, measurement.smoothing, highest));
        if (i != result.main)
            continue;
        result.impulseResponse = detail::strongestDirection(responses.impulses, recording.rate);
        result.latency = timing.start + detail::strongestLag(result.impulseResponse);
        detail::warnOfResponses(responses.linear, params, result.warnings);
    }
    detail::warnOfSnr(result.levels[result.main].snr, measurement.wantedSnr, result.warnings);
    return result;
}

} // namespace pacini
