#include "devices/TouchPlan.h"

#include "devices/ClipDrive.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace pacini::devices
{

namespace
{
constexpr double touchRate = 8000.0; // Hz
constexpr std::size_t stepFrames = 40;
constexpr double step = static_cast<double>(stepFrames) / touchRate; // s
constexpr double meanTime = 0.015;  // s, over which the level is a mean: a push is no shorter
constexpr double leastLevel = 0.05; // of full drive
constexpr double fullLevel = 0.75;
constexpr double longestPause = 0.2;  // s
constexpr double latestEvent = 0.010; // s

class Planner
{
public:
    /// Goes on to `time`; `level` is that of the drive there.
    void follow(double time, double level, const std::vector<Transient>& events)
    {
        for (; next < events.size() && events[next].time <= time; ++next)
            if (events[next].amplitude > 0.0)
                begin(events[next].time);
        const bool eventIsNear = next < events.size() && events[next].time < time + touchLength.value + touchGap.value;
        if (level < leastLevel || eventIsNear)
            return;
        const double pause = std::clamp(touchLength.value * (1.0 / level - 1.0), touchGap.value, longestPause);
        if (level >= fullLevel && time >= lastEnd && time < lastEnd + touchGap.value && !plan.touches.empty())
            plan.touches.back().end = lastEnd = time + touchLength.value; // it stays on
        else if (time >= lastEnd + pause)
            push(time);
    }

    TouchPlan plan;

private:
    void begin(double event)
    {
        ++plan.events;
        const double earliest = lastEnd + touchGap.value;
        if (earliest - event > latestEvent)
            ++plan.leftOut;
        else
            push(std::max(event, earliest));
    }

    void push(double start)
    {
        lastEnd = start + touchLength.value;
        plan.touches.push_back({start, lastEnd});
    }

    std::size_t next = 0;           ///< event
    double lastEnd = -longestPause; ///< s: of the last push
};
} // namespace

TouchPlan touchPlan(const Clip& clip)
{
    const double end = std::min(clip.duration, longestTouched.value);
    if (!(end > 0.0))
        return {};
    const DriveRenderer drive = clipDrive(clip, {Seconds(0.0), Seconds(end)}, 0_dB, touchRate);
    std::vector<float> samples(stepFrames);
    std::span<float> output = samples;
    Planner planner;
    double square = 0.0;
    for (std::int64_t i = 0; static_cast<double>(i) * step < end; ++i)
    {
        drive(std::span<const std::span<float>>(&output, 1));
        double power = 0.0;
        for (const float sample : samples)
            power += 2.0 * static_cast<double>(sample) * static_cast<double>(sample) / static_cast<double>(stepFrames);
        square += (power - square) * -std::expm1(-step / meanTime);
        planner.follow(static_cast<double>(i) * step, std::min(std::sqrt(square), 1.0), clip.transients);
    }
    for (Touch& touch : planner.plan.touches)
        touch.end = std::max(std::min(touch.end, end), touch.start + touchLength.value);
    return std::move(planner.plan);
}

} // namespace pacini::devices
