#pragma once

// Edits of a stretch of time on chosen lanes: gain, fades, inversion, pitch, timing, chance. Pure functions; each
// result passes validate() when the clip did: ranges are put in order and limited to the clip, parameters are clamped
// as stated, values to what their lane may hold. Where a range ends inside the clip, curves step.

#include <pacini/clip/edits/CurveSection.h>
#include <pacini/foundation/Random.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace pacini
{

/// Scope of a range edit.
struct EditScope
{
    TimeRange range{0.0, limits::duration};
    bool allLanes = true;
    std::vector<Lane> lanes; ///< when not all; those that the clip does not have are ignored
    bool transients = true;
    bool operator==(const EditScope&) const = default;
};

namespace detail
{
[[nodiscard]] inline bool isInside(TimeRange range, double time) noexcept
{
    return time >= range.from && time <= range.to;
}

/// Calls edit(lane, curve) for every lane of the scope.
template <typename F>
void forLanes(Clip& clip, const EditScope& scope, F&& edit)
{
    for (const Lane& lane : scope.allLanes ? lanesOf(clip) : scope.lanes)
        if (Curve* curve = curveOf(clip, lane))
            edit(lane, *curve);
}

/// Calls edit(transient) for every transient of the scope.
template <typename F>
void forTransients(Clip& clip, const EditScope& scope, TimeRange range, F&& edit)
{
    if (!scope.transients)
        return;
    for (Transient& event : clip.transients)
        if (isInside(range, event.time))
            edit(event);
}

[[nodiscard]] inline double limitedTo(ValueRange range, double value) noexcept
{
    return clampTo(value, range.low, range.high);
}

/// Sorts events by time; the sort is stable.
template <typename Events>
void sortByTime(Events& events)
{
    std::stable_sort(events.begin(), events.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
}
} // namespace detail

/// Amplifies amplitudes by `decibels` (-200 to 200; -200 is silence). Frequencies are left alone. A clip whose envelope
/// is not in the scope keeps its total level: the bands are levelled to it when it is played.
[[nodiscard]] inline Clip amplify(Clip clip, const EditScope& scope, double decibels)
{
    const double limited = clampTo(decibels, -200.0, 200.0);
    const double factor = limited <= -200.0 ? 0.0 : Decibels(limited).gain();
    const TimeRange range = withinClip(scope.range, clip.duration);
    detail::forLanes(clip, scope,
                     [&](Lane lane, Curve& curve)
                     {
                         if (!isFrequency(lane.kind))
                             curve = mapValues(curve, range, clip.duration, {},
                                               [&](const Breakpoint& p)
                                               { return detail::limitedTo(laneRange(lane.kind), factor * p.value); });
                     });
    detail::forTransients(clip, scope, range,
                          [&](Transient& event)
                          { event.amplitude = std::min(factor * event.amplitude, limits::amplitude); });
    return clip;
}

/// Whether a fade begins or ends with silence.
enum class FadeDirection
{
    in, ///< from silence
    out ///< to silence
};

/// Shape of a fade's gain over time.
enum class FadeShape
{
    linear, ///< of amplitude
    smooth, ///< raised cosine
    square  ///< square of the linear one: slow at the silent end, about even in loudness
};

/// The gain (0-1) of a fade-in at 0-1 of its time.
[[nodiscard]] inline double fadeGain(FadeShape shape, double x) noexcept
{
    switch (shape)
    {
    case FadeShape::linear:
        return x;
    case FadeShape::smooth:
        return 0.5 - 0.5 * std::cos(std::numbers::pi * x);
    case FadeShape::square:
        return x * x;
    }
    return x;
}

/// Fades amplitudes over the whole range. A line times a fade is a parabola or worse: lines are split into at least 32
/// pieces over the range, which holds it within 1/4000 of full scale. A range without length changes nothing.
[[nodiscard]] inline Clip fade(Clip clip, const EditScope& scope, FadeDirection direction,
                               FadeShape shape = FadeShape::linear)
{
    const TimeRange range = withinClip(scope.range, clip.duration);
    const double length = range.to - range.from;
    if (!(length > 0.0))
        return clip;
    const auto gainAt = [&](double time)
    {
        const double x = clampTo((time - range.from) / length, 0.0, 1.0);
        return fadeGain(shape, direction == FadeDirection::in ? x : 1.0 - x);
    };
    detail::forLanes(clip, scope,
                     [&](Lane lane, Curve& curve)
                     {
                         if (!isFrequency(lane.kind))
                             curve = mapValues(curve, range, clip.duration, {length / 32.0},
                                               [&](const Breakpoint& p) { return p.value * gainAt(p.time); });
                     });
    detail::forTransients(clip, scope, range, [&](Transient& event) { event.amplitude *= gainAt(event.time); });
    return clip;
}

/// Turns curves upside down: amplitudes about half of full drive (1 - value, from 0), frequencies about the geometric
/// mean of their lowest and highest value in the range. Transients: sharpness becomes 1 - sharpness.
[[nodiscard]] inline Clip invert(Clip clip, const EditScope& scope)
{
    const TimeRange range = withinClip(scope.range, clip.duration);
    detail::forLanes(clip, scope,
                     [&](Lane lane, Curve& curve)
                     {
                         double low = limits::frequency;
                         double high = 1e-3;
                         for (const Breakpoint& p : curve)
                             if (detail::isInside(range, p.time))
                             {
                                 low = std::min(low, std::max(p.value, 1e-3));
                                 high = std::max(high, p.value);
                             }
                         if (isFrequency(lane.kind) && low > high)
                             low = high = std::max(1e-3, valueAt(curve, range.from));
                         curve = mapValues(curve, range, clip.duration, {},
                                           [&](const Breakpoint& p)
                                           {
                                               return detail::limitedTo(laneRange(lane.kind),
                                                                        isFrequency(lane.kind)
                                                                            ? low * high / std::max(p.value, 1e-3)
                                                                            : 1.0 - p.value);
                                           });
                     });
    detail::forTransients(clip, scope, range, [](Transient& event) { event.sharpness = 1.0 - event.sharpness; });
    return clip;
}

/// Shifts the pitch of a whole clip by -96 to 96 semitones: band and noise edges, centres, pitches, centroid; all are
/// clamped to their ranges.
[[nodiscard]] inline Clip transpose(Clip clip, double semitones)
{
    const double ratio = std::exp2(clampTo(semitones, -96.0, 96.0) / 12.0);
    const auto shift = [&](double& frequency, double lowest)
    {
        frequency = clampTo(ratio * frequency, lowest, limits::frequency);
    };
    for (Band& band : clip.bands)
    {
        for (double* frequency : {&band.lowFrequency, &band.centreFrequency, &band.highFrequency})
            shift(*frequency, 0.0);
        for (Breakpoint& p : band.pitch)
            shift(p.value, laneRange(LaneKind::pitch).low);
    }
    for (NoiseBand& band : clip.noise)
    {
        shift(band.lowFrequency, 0.0);
        shift(band.highFrequency, 0.0);
    }
    for (Breakpoint& p : clip.centroid)
        shift(p.value, 0.0);
    return clip;
}

/// Time grid for quantising events.
struct TimeGrid
{
    double step = 0.1;     ///< s, above 0; other values quantise nothing
    double origin = 0.0;   ///< s: one of the lines
    double strength = 1.0; ///< 0 (nothing) to 1 (onto the line)
    bool operator==(const TimeGrid&) const = default;
};

/// A time pulled to the nearest line of a grid; not limited to any clip. Two times keep their order up to rounding.
[[nodiscard]] inline double quantised(double time, const TimeGrid& grid) noexcept
{
    if (!(grid.step > 0.0) || !std::isfinite(grid.step) || !std::isfinite(grid.origin))
        return time;
    const double line = grid.origin + grid.step * std::round((time - grid.origin) / grid.step);
    return time + clampTo(grid.strength, 0.0, 1.0) * (line - time);
}

/// Pulls the times of points and transients of the range to a grid. Points do not pass those outside the range.
[[nodiscard]] inline Clip quantiseTimes(Clip clip, const EditScope& scope, const TimeGrid& grid)
{
    const TimeRange range = withinClip(scope.range, clip.duration);
    detail::forLanes(clip, scope,
                     [&](Lane, Curve& curve)
                     {
                         double before = 0.0;
                         for (std::size_t i = 0; i < curve.size(); ++i)
                         {
                             if (!detail::isInside(range, curve[i].time))
                             {
                                 before = curve[i].time;
                                 continue;
                             }
                             std::size_t next = i + 1;
                             while (next < curve.size() && detail::isInside(range, curve[next].time))
                                 ++next;
                             const double after = next < curve.size() ? curve[next].time : clip.duration;
                             for (; i < next; ++i)
                             {
                                 // Two times can reach one line with different last bits: none may pass another.
                                 before = clampTo(quantised(curve[i].time, grid), before, std::max(before, after));
                                 curve[i].time = before;
                             }
                             --i;
                         }
                     });
    detail::forTransients(clip, scope, range,
                          [&](Transient& event)
                          { event.time = clampTo(quantised(event.time, grid), 0.0, clip.duration); });
    detail::sortByTime(clip.transients);
    return clip;
}

/// Random deviations that humanise() adds, each uniform within plus or minus the value.
struct Humanisation
{
    double time = 0.0;  ///< s, 0 to 1
    double level = 0.0; ///< dB, 0 to 24
    double pitch = 0.0; ///< semitones, 0 to 12
    std::uint64_t seed = 0;
    bool operator==(const Humanisation&) const = default;
};

/// Moves times, levels and pitches of points and transients by chance, the same for one seed on every machine. A
/// lane's chance does not depend on which other lanes are in the scope. Points move at most half the way to their
/// neighbours, so that shapes stay; transients may pass each other.
[[nodiscard]] inline Clip humanise(Clip clip, const EditScope& scope, const Humanisation& amount)
{
    const TimeRange range = withinClip(scope.range, clip.duration);
    const double time = clampTo(amount.time, 0.0, 1.0);
    const double level = clampTo(amount.level, 0.0, 24.0);
    const double pitch = clampTo(amount.pitch, 0.0, 12.0);
    const auto chance = [&](std::uint64_t stream)
    {
        return Random(Random(amount.seed + 0x9E3779B97F4A7C15ull * (stream + 1)).next());
    };
    detail::forLanes(clip, scope,
                     [&](Lane lane, Curve& curve)
                     {
                         Random random = chance(8 * lane.index + static_cast<std::uint64_t>(lane.kind));
                         const Curve before = curve;
                         for (std::size_t i = 0; i < before.size(); ++i)
                         {
                             const Breakpoint& p = before[i];
                             const double shift = random.uniform(-time, time);
                             const double turn = random.uniform(-1.0, 1.0);
                             if (!detail::isInside(range, p.time))
                                 continue;
                             const double low = i > 0 ? 0.5 * (before[i - 1].time + p.time) : 0.0;
                             const double high =
                                 i + 1 < before.size() ? 0.5 * (p.time + before[i + 1].time) : clip.duration;
                             curve[i].time = time > 0.0 ? clampTo(p.time + shift, low, std::max(low, high)) : p.time;
                             const double ratio = isFrequency(lane.kind) ? std::exp2(pitch * turn / 12.0)
                                                                         : Decibels(level * turn).gain();
                             curve[i].value = detail::limitedTo(laneRange(lane.kind), ratio * p.value);
                         }
                     });
    Random random = chance(7);
    detail::forTransients(clip, scope, range,
                          [&](Transient& event)
                          {
                              event.time = clampTo(event.time + random.uniform(-time, time), 0.0, clip.duration);
                              const double ratio = Decibels(level * random.uniform(-1.0, 1.0)).gain();
                              event.amplitude = std::min(ratio * event.amplitude, limits::amplitude);
                          });
    detail::sortByTime(clip.transients);
    return clip;
}

} // namespace pacini
