#pragma once

// Arrival times of the sweeps in a recording.

#include <pacini/linearize/ClockDrift.h>
#include <pacini/linearize/DelayTrack.h>
#include <pacini/linearize/SweepLocator.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace pacini
{

/// Arrival times of all sweeps and the drift between the clocks.
struct SweepTiming
{
    double start = 0.0;           ///< arrival of the signal played at 0 s, s of the recording
    double drift = 0.0;           ///< seconds of the recording more than one for each second of the playback
    bool driftKnown = false;      ///< false after a single sweep without markers
    std::vector<DelayStep> steps; ///< frames that are missing

    /// Returns the arrival, s of the recording, of the signal played at `playTime` s.
    [[nodiscard]] double arrival(double playTime) const noexcept
    {
        double time = start + playTime * (1.0 + drift);
        for (const DelayStep& step : steps)
            time += playTime >= step.time ? step.seconds : 0.0;
        return time;
    }

    /// Inverse of arrival(): returns the play time of the signal that arrives at `time` s of the recording.
    [[nodiscard]] double playTime(double time) const noexcept
    {
        double played = (time - start) / (1.0 + drift);
        for (const DelayStep& step : steps)
            if (played - step.seconds / (1.0 + drift) >= step.time)
                played -= step.seconds / (1.0 + drift);
        return played;
    }
};

/// `count` samples at `rate` Hz, from sample `first` of the recording on, of a sweep played at `playTime` s as the
/// recorder must have heard it: by its clock, and without the frames that it lost. What is missing on both sides of a
/// deconvolution does no harm.
[[nodiscard]] inline std::vector<double> heardSweep(const ExponentialSweep& sweep, double playTime,
                                                    const SweepTiming& timing, double rate, std::ptrdiff_t first,
                                                    std::size_t count)
{
    std::vector<double> x(count);
    for (std::size_t n = 0; n < count; ++n)
        x[n] = sweep.at(timing.playTime(static_cast<double>(first + static_cast<std::ptrdiff_t>(n)) / rate) - playTime);
    return x;
}

/// Refines a position to the arrival of each sweep: all sweeps and the second marker are compared with the first
/// marker, or with the first sweep when there are no markers. Twice, since a sweep that is taken apart by a wrong clock
/// is smeared. `recording` may have any rate that holds the sweep.
[[nodiscard]] inline SweepTiming timeSweeps(const RecordedChannels& recording, const SweepParams& params,
                                            const SweepSchedule& schedule, const SweepPosition& position)
{
    struct Played
    {
        ExponentialSweep sweep;
        double time;
    };
    const ExponentialSweep sweep = measuringSweep(params);
    std::vector<Played> played;
    if (schedule.firstMarker)
        played.push_back({markerSweep(params), static_cast<double>(*schedule.firstMarker) / params.sampleRate});
    for (const ScheduledSweep& s : schedule.sweeps)
        played.push_back({sweep, static_cast<double>(s.startFrame) / params.sampleRate});
    if (schedule.secondMarker)
        played.push_back({markerSweep(params), static_cast<double>(*schedule.secondMarker) / params.sampleRate});

    // Harmonics come earlier by L ln 2 and more and must stay out of the window, lost frames within it.
    const auto reach = [&](const ExponentialSweep& s)
    {
        return std::min({0.5, 0.35 * s.growthTime() * std::numbers::ln2, params.pause});
    };
    constexpr double nearest = 0.03; // s before the strongest moment of the reference, whose sides are short
    const double after = std::min(0.4, 0.8 * params.pause);
    const double firstSweep = static_cast<double>(schedule.sweeps.front().startFrame) / params.sampleRate;
    SweepTiming timing;
    timing.start = position.start;
    for (int pass = 0; pass < 2; ++pass)
    {
        const auto arrive = [&](const Played& p, double before, double behind)
        {
            // Half a pause is the most that a sweep can be late before it is mistaken for its neighbour.
            const double uncertain = 0.1 + (pass == 0 ? widestDrift * std::abs(p.time - firstSweep) : 0.0);
            const double expected = pass == 0 ? position.start + p.time : timing.arrival(p.time);
            return arrivedSweep(recording, p.sweep.byClock(timing.drift), p.time, expected,
                                std::min(uncertain, 0.5 * params.pause + widestDrift * p.time), before, behind);
        };
        const auto reference = arrive(played.front(), nearest, after);
        timing.start = reference.arrival - played.front().time * (1.0 + timing.drift);
        if (played.size() == 1)
            return timing;
        const auto longest = static_cast<std::size_t>(2.0 * std::max(reach(sweep), after) * recording.rate) + 2;
        DelayTrack track(reference, recording.rate, longest);
        std::vector<DelayPoint> points;
        std::vector<ArrivedSweep> all;
        for (const Played& p : played)
        {
            const double before = p.sweep.seconds() < params.duration ? nearest : reach(p.sweep);
            all.push_back(&p == &played.front() ? reference : arrive(p, before, std::max(before, after)));
            // A third of an octave at both ends belongs to bands that the sweep does not fill.
            const auto more =
                track.compare(all.back(), p.sweep, played.front().sweep, timing.drift,
                              params.lowFrequency * std::exp2(1.0 / 3.0), params.highFrequency * std::exp2(-1.0 / 3.0));
            points.insert(points.end(), more.begin(), more.end());
        }
        auto fit = fitDelays(points, 0.7 / params.sampleRate);
        if (!fit)
            return timing;
        for (DelayStep& step : fit->steps)
            for (std::size_t k = 1; k < played.size(); ++k)
            {
                const double end = played[k].time + played[k].sweep.seconds();
                if (step.time < played[k].time || step.time > end)
                    continue;
                // A band of a third of an octave on either side is what the first look is uncertain by.
                const double reachable = played[k].sweep.growthTime() * std::numbers::ln2 / 3.0;
                const double earlier = fit->steppedAt(step.time) - step.seconds;
                step.time = track.stepTime(all[k], played[k].sweep, fit->drift, earlier, step.seconds,
                                           std::max(step.time - reachable, played[k].time),
                                           std::min(step.time + reachable, end));
                break;
            }
        timing.drift = fit->drift;
        timing.driftKnown = true;
        timing.steps = fit->steps;
        timing.start = reference.arrival - played.front().time * (1.0 + timing.drift);
    }
    return timing;
}

/// The times, s of the recording, in which nothing is to be heard: the silence before the first sweep and the second
/// half of each pause.
[[nodiscard]] inline std::vector<std::pair<double, double>>
quietTimes(const SweepParams& params, const SweepSchedule& schedule, const SweepTiming& timing, double recordedSeconds)
{
    constexpr double guard = 0.03; // s: a filter's or a body's forerunner
    std::vector<std::pair<double, double>> quiet;
    double from = 0.0;
    const auto play = [&](std::size_t frame, double seconds)
    {
        const double time = static_cast<double>(frame) / params.sampleRate;
        quiet.emplace_back(from, timing.arrival(time) - guard);
        from = timing.arrival(time + seconds) + 0.5 * params.pause;
    };
    if (schedule.firstMarker)
        play(*schedule.firstMarker, params.markerDuration);
    for (const ScheduledSweep& s : schedule.sweeps)
        play(s.startFrame, params.duration);
    if (schedule.secondMarker)
        play(*schedule.secondMarker, params.markerDuration);
    quiet.emplace_back(from, from + 0.5 * params.pause);
    for (auto& [begin, end] : quiet)
    {
        begin = std::clamp(begin, 0.0, recordedSeconds);
        end = std::clamp(end, begin, recordedSeconds);
    }
    return quiet;
}

} // namespace pacini
