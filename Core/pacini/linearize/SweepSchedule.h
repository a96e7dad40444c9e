#pragma once

// Schedule of a sweep measurement: when which sweep is played.

#include <pacini/foundation/Units.h>
#include <pacini/linearize/Sweep.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace pacini
{

/// One sweep of the schedule.
struct ScheduledSweep
{
    std::size_t startFrame = 0;
    std::size_t levelIndex = 0; ///< into SweepParams::levels
    double level = 0.0;         ///< dB re full scale
    int repeat = 0;             ///< 0 to repeats - 1
    bool operator==(const ScheduledSweep&) const = default;
};

/// Order of a measurement: pause, marker, pause, then each sweep and a pause, marker, pause.
struct SweepSchedule
{
    std::vector<ScheduledSweep> sweeps;      ///< in the order of playing: all repeats of a level, then the next level
    std::optional<std::size_t> firstMarker;  ///< frame of its start
    std::optional<std::size_t> secondMarker; ///< frame of its start
    double markerLevel = 0.0;                ///< dB re full scale: that of the loudest sweep
    std::size_t frames = 0;                  ///< of everything
    bool operator==(const SweepSchedule&) const = default;
};

/// The schedule of valid `params`; every start falls on a whole frame.
[[nodiscard]] inline SweepSchedule makeSweepSchedule(const SweepParams& params)
{
    const auto frames = [&](double seconds)
    {
        return static_cast<std::size_t>(std::lround(seconds * params.sampleRate));
    };
    const std::size_t pause = frames(params.pause);
    SweepSchedule schedule;
    schedule.markerLevel = *std::max_element(params.levels.begin(), params.levels.end());
    std::size_t at = pause;
    const auto play = [&](double seconds)
    {
        const std::size_t start = at;
        at += frames(seconds) + pause;
        return start;
    };
    if (params.markerDuration > 0.0)
        schedule.firstMarker = play(params.markerDuration);
    for (std::size_t i = 0; i < params.levels.size(); ++i)
        for (int repeat = 0; repeat < params.repeats; ++repeat)
            schedule.sweeps.push_back({play(params.duration), i, params.levels[i], repeat});
    if (params.markerDuration > 0.0)
        schedule.secondMarker = play(params.markerDuration);
    schedule.frames = at;
    return schedule;
}

/// All samples of a measurement, as they are played and as they go into a WAV file; or what is wrong with `params`.
[[nodiscard]] inline Result<std::vector<float>> makeSweepSignal(const SweepParams& params)
{
    if (auto valid = validate(params); !valid)
        return valid.error();
    const SweepSchedule schedule = makeSweepSchedule(params);
    std::vector<float> signal(schedule.frames, 0.0f);
    const auto put = [&](const std::vector<float>& samples, std::size_t start, double level)
    {
        const double gain = Decibels(level).gain();
        for (std::size_t n = 0; n < samples.size(); ++n)
            signal[start + n] = static_cast<float>(gain * static_cast<double>(samples[n]));
    };
    const auto sweep = sampleSweep(measuringSweep(params), params.sampleRate);
    for (const ScheduledSweep& s : schedule.sweeps)
        put(sweep, s.startFrame, s.level);
    if (schedule.firstMarker && schedule.secondMarker)
    {
        const auto marker = sampleSweep(markerSweep(params), params.sampleRate);
        put(marker, *schedule.firstMarker, schedule.markerLevel);
        put(marker, *schedule.secondMarker, schedule.markerLevel);
    }
    return signal;
}

} // namespace pacini
