#include "io/formats/android/AndroidWaveform.h"

#include "io/formats/LossList.h"
#include "io/formats/VoiceReduction.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace pacini
{

namespace
{
constexpr double usualSteps = 100.0;      // per second
constexpr std::int64_t shortestStep = 10; // ms beside bursts
constexpr std::int64_t motorStop = 50;    // ms: in less a motor does not stop and start again
constexpr double burst = 0.020;           // s

/// Where the steps of a waveform meet, in ms.
std::set<std::int64_t> stepTimes(const SingleVoice& voice, std::int64_t end, std::int64_t step, bool keepsPoints)
{
    std::set<std::int64_t> times{0, end};
    if (keepsPoints)
        for (std::size_t i = 1; i < voice.amplitude.size(); ++i) // the first point is at 0
        {
            const Breakpoint &before = voice.amplitude[i - 1], &point = voice.amplitude[i];
            times.insert(std::clamp<std::int64_t>(androidTick(point.time), 0, end));
            if (before.value != point.value)
                for (std::int64_t t = androidTick(before.time) + step; t + shortestStep <= androidTick(point.time);
                     t += step)
                    times.insert(t);
        }
    else
        for (std::int64_t t = step; t + shortestStep <= end; t += step)
            times.insert(t);
    for (std::size_t i = 0; i < voice.events.size(); ++i)
    {
        const std::int64_t from = std::min(androidTick(voice.events[i].time), end);
        const auto length = std::max<std::int64_t>(1, androidTick(burstLength(voice.events, i, burst)));
        const std::int64_t to = std::min(from + length, end);
        times.erase(times.upper_bound(std::max<std::int64_t>(from - shortestStep, 0)),
                    times.lower_bound(std::min(to + shortestStep, end)));
        times.insert(from);
        times.insert(to);
    }
    return times;
}

/// Silence too short to be felt as such only makes the motor stop.
void bridgeSilences(std::vector<AndroidStep>& steps)
{
    for (std::size_t i = 1; i + 1 < steps.size(); ++i)
    {
        std::size_t after = i;
        std::int64_t silence = 0;
        for (; after < steps.size() && steps[after].amplitude == 0; ++after)
            silence += steps[after].duration;
        if (silence > 0 && silence < motorStop && after < steps.size())
            for (; i < after; ++i)
                steps[i].amplitude = 1;
        i = std::max(i, after);
    }
}

std::vector<AndroidStep> merged(const std::vector<AndroidStep>& steps)
{
    std::vector<AndroidStep> runs;
    for (const AndroidStep& next : steps)
    {
        if (!runs.empty() && runs.back().amplitude == next.amplitude)
            runs.back().duration += next.duration;
        else
            runs.push_back(next);
    }
    return runs;
}
} // namespace

std::vector<AndroidStep> androidWaveformOf(const SingleVoice& voice, std::optional<double> stepsPerSecond,
                                           bool keepsPoints)
{
    const auto end = std::max<std::int64_t>(1, androidTick(voice.duration));
    const auto step = std::max<std::int64_t>(shortestStep, androidTick(1.0 / stepsPerSecond.value_or(usualSteps)));
    CurveReader amplitude(voice.amplitude);
    const auto times = stepTimes(voice, end, step, keepsPoints);
    std::vector<AndroidStep> steps;
    std::size_t event = 0;
    for (auto from = times.begin(), to = std::next(from); to != times.end(); ++from, ++to)
    {
        // The value in the middle: a mean would smear the rise of an onset over two steps (up to 7 points of HTS).
        double level = amplitude.at(0.5 * (androidTime(*from) + androidTime(*to)));
        while (event < voice.events.size() && androidTick(voice.events[event].time) < *from)
            ++event;
        for (std::size_t i = event; i < voice.events.size() && androidTick(voice.events[i].time) == *from; ++i)
            level = std::hypot(level, voice.events[i].amplitude);
        steps.push_back({*to - *from, static_cast<int>(std::lround(255.0 * std::clamp(level, 0.0, 1.0)))});
    }
    bridgeSilences(steps);
    return merged(steps);
}

void addStepLosses(LossList& losses, const SingleVoice& voice, const std::vector<AndroidStep>& steps)
{
    std::int64_t from = 0;
    for (const AndroidStep& step : steps)
    {
        double worst = 0.0;
        const double level = step.amplitude / 255.0;
        for (const double place : {0.0, 0.5, 1.0})
        {
            const double time = androidTime(from) + place * androidTime(step.duration) - (place == 1.0 ? 1e-4 : 0.0);
            worst = std::max(worst, std::abs(std::min(valueAt(voice.amplitude, time), 1.0) - level));
        }
        if (worst > leastAmplitude)
            losses.add(LossKind::points, androidTime(from), androidTime(step.duration), worst,
                       "waveform: amplitudes and events become steps");
        from += step.duration;
    }
}

} // namespace pacini
