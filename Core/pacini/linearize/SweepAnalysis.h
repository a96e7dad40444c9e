#pragma once

// Sweep analysis: the whole way from a recording of sweeps to responses.

#include <pacini/foundation/Fft.h>
#include <pacini/foundation/SplitRealFft.h>
#include <pacini/linearize/GroupDelay.h>
#include <pacini/linearize/LagWindow.h>
#include <pacini/linearize/LevelAnalysis.h>
#include <pacini/linearize/RecordingChecks.h>
#include <pacini/linearize/ResponseChecks.h>
#include <pacini/linearize/SweepLocator.h>
#include <pacini/linearize/SweepMeasurement.h>
#include <pacini/linearize/SweepTiming.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini
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

/// The lowest and the highest frequency of which recordings tell the response, Hz. Errors: see analyseSweeps().
[[nodiscard]] inline Result<std::pair<double, double>> measuredRange(std::span<const std::vector<float>> channels,
                                                                     double recordingRate, const SweepParams& params,
                                                                     const MeasurementParams& measurement)
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
        return Error{ErrorCode::invalidArgument, "measurement.lowFrequency",
                     "leaves no frequency of the sweep's range"};
    return std::pair(low, high);
}

/// Notes the drift of the clocks and the frames that were lost. Errors: invalidData at `clock`.
[[nodiscard]] inline Result<void> warnOfTiming(const SweepTiming& timing, const MeasurementParams& measurement,
                                               double recordingRate, SweepMeasurement& result)
{
    if (timing.driftKnown)
    {
        result.driftPpm = 1e6 * timing.drift;
        const double ppm = std::abs(*result.driftPpm);
        const std::string text = std::to_string(std::lround(*result.driftPpm)) + " ppm";
        if (ppm > measurement.driftLimit)
            return Error{ErrorCode::invalidData, "clock",
                         "player and recorder differ by " + text +
                             "; use one device for both, or correct its sample rate"};
        if (ppm > measurement.driftWarning)
            result.warnings.push_back({MeasurementDefect::clockDrift, "clock",
                                       "player and recorder differ by " + text + "; the result is corrected for it"});
    }
    for (const DelayStep& step : timing.steps)
        result.warnings.push_back({MeasurementDefect::droppedFrames, secondsText(timing.arrival(step.time)),
                                   std::to_string(std::lround(std::abs(step.seconds) * recordingRate)) + " frames " +
                                       (step.seconds < 0.0 ? "are missing" : "too many") +
                                       " about here; use larger buffers and measure again"});
    return {};
}

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
    const auto range = measuredRange(channels, recordingRate, params, measurement);
    if (!range)
        return range.error();
    const auto [low, high] = *range;
    const double recordedSeconds = static_cast<double>(channels.front().size()) / recordingRate;
    const SweepSchedule schedule = makeSweepSchedule(params);
    const double needed = static_cast<double>(schedule.sweeps.back().startFrame - schedule.sweeps.front().startFrame) /
                              params.sampleRate +
                          params.duration;
    if (recordedSeconds < 0.99 * needed) // clocks differ
        return Error{ErrorCode::truncated, "channels",
                     "last " + secondsText(recordedSeconds) + ", the sweeps last " + secondsText(needed) +
                         "; record until the end"};

    SweepMeasurement result;
    warnOfChannels(channels, recordingRate, result.warnings);
    std::vector<double> scale(channels.size());
    for (std::size_t c = 0; c < scale.size(); ++c)
        scale[c] = measurement.fullScale[measurement.fullScale.size() == 1 ? 0 : c];
    const auto rate = static_cast<int>(recordingRate);

    const auto coarse = reduceRate(channels, rate, params.highFrequency, 2.5, scale);
    const auto position = locateSweeps(coarse, schedule, params.sampleRate, measuringSweep(params));
    // Noise reaches 2; a response that is spread over more than the ringing of anything asks for a closer look.
    constexpr double leastContrast = 5.0;
    if (position.contrast < leastContrast || position.focus < 0.7)
        if (const auto likelier = likelierRate(coarse, schedule, params, recordingRate, position))
            return Error{ErrorCode::invalidData, "sampleRate",
                         "is " + std::to_string(rate) + " Hz, but the recording was made at " +
                             std::to_string(std::lround(*likelier)) + " Hz"};
    const Error nothing{ErrorCode::invalidData, "channels",
                        "contain no sweep above the noise; check cables, levels and the settings of the sweep"};
    if (position.contrast < leastContrast)
        return nothing;

    const SweepTiming timing = timeSweeps(coarse, params, schedule, position);
    if (timing.driftKnown && std::abs(timing.drift) > 1.5 * widestDrift)
        return nothing; // further apart than was looked for: markers were taken for what is noise
    for (std::size_t k = 0; k < schedule.sweeps.size(); ++k)
    {
        const double start = static_cast<double>(schedule.sweeps[k].startFrame) / params.sampleRate;
        constexpr double slack = 0.01; // s, what the position of the strongest moment leaves open
        if (timing.arrival(start) < -slack || timing.arrival(start + params.duration) > recordedSeconds + slack)
            return Error{ErrorCode::truncated, "sweeps[" + std::to_string(k) + "]",
                         "is not completely in the recording: it lasts from " + secondsText(timing.arrival(start)) +
                             " to " + secondsText(timing.arrival(start + params.duration)) + ", the recording " +
                             secondsText(recordedSeconds)};
    }
    if (auto bearable = warnOfTiming(timing, measurement, recordingRate, result); !bearable)
        return bearable.error();

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
        result.impulseResponse = strongestDirection(responses.impulses, recording.rate);
        const double arrival = strongestLag(result.impulseResponse);
        result.latency = timing.start + arrival;
        result.groupDelay = groupDelay(result.impulseResponse, arrival, frequency, measurement.smoothing);
        warnOfResponses(responses.linear, params, measurement.equalized, result.warnings);
    }
    warnOfSnr(result.levels[result.main].snr, measurement.wantedSnr, result.warnings);
    return result;
}

} // namespace pacini
