#include "io/formats/VoiceExport.h"

#include "io/formats/FormatLosses.h"
#include "io/formats/RootCurve.h"

#include <pacini/simplify/AnchoredCurve.h>
#include <pacini/simplify/HatBasis.h>
#include <pacini/simplify/Refit.h>
#include <pacini/synthesis/ClipAdaptation.h>
#include <pacini/synthesis/SingleVoice.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pacini
{

namespace
{
constexpr double shortest = 0.01; // s

/// `curve` at both sides of every time of `dense`: visit(time, exact, approximate).
template <typename Visit>
void compare(const Curve& dense, const Curve& curve, Visit visit)
{
    forEachPlace(dense, curve,
                 [&](std::size_t m, const HatPlace& place) { visit(dense[m].time, dense[m].value, place.of(curve)); });
}

/// Frequencies in Hz become 0 to 1.
Curve normalised(const SingleVoice& voice, const NormalisedRange& range, LossList& losses)
{
    LossTrack track(
        LossKind::frequency,
        fmt::format("frequencies outside of {:.0f} to {:.0f} Hz are limited to this range", range.low, range.high));
    Curve curve = voice.frequency;
    CurveReader amplitude(voice.amplitude);
    for (Breakpoint& point : curve)
    {
        const double to = std::clamp(point.value, range.low, range.high);
        const double octaves = std::abs(std::log2(std::max(point.value, 1.0) / std::max(to, 1.0)));
        if (amplitude.at(point.time) > leastAmplitude && octaves > 0.01)
            track.add(point.time, octaves);
        point.value = range.normalisedOf(to);
    }
    losses.append(track);
    return curve;
}

/// Each point's share of the time, so that many near points count no more than one.
std::vector<double> timeShares(const Curve& curve)
{
    std::vector<double> shares(curve.size(), 0.0);
    for (std::size_t i = 1; i < curve.size(); ++i)
    {
        const double half = 0.5 * (curve[i].time - curve[i - 1].time);
        shares[i - 1] += half;
        shares[i] += half;
    }
    return shares;
}

/// The dense curve as few points, one at each event. Where the density does not allow to say all, what is ducked under
/// an emphasis counts less, and the points get the values that fit best: between anchors in the valleys of a roll the
/// lines would else be far too low.
Curve fewPoints(const Curve& level, const std::vector<Transient>& events, const EmphasisPlayer* player,
                const AnchoredCurveParams& params)
{
    std::vector<double> weights = timeShares(level), times;
    std::size_t i = 0;
    for (const Transient& event : events)
    {
        times.push_back(event.time);
        while (i < level.size() && level[i].time <= event.time)
            ++i;
        for (; player && i < level.size() && level[i].time < event.time + player->lengthOf(event.sharpness); ++i)
            weights[i] *= player->ducking * player->ducking;
    }
    Curve curve = anchoredCurve(level, times, params, weights);
    if (curve.size() < params.count)
        return curve; // all is said
    curve = refit(level, curve, weights, {.lowest = 0.0});
    for (Breakpoint& point : curve)
        point.value = std::min(point.value, 1.0);
    return curve;
}

/// An emphasis may not be weaker than its point.
void lowerToEvents(Curve& level, const std::vector<Transient>& events)
{
    auto point = level.begin();
    for (const Transient& event : events)
    {
        while (point != level.end() && point->time < event.time)
            ++point;
        for (; point != level.end() && point->time == event.time; ++point)
            point->value = std::min(point->value, event.amplitude);
    }
}

std::size_t pointCount(double perSecond, double duration)
{
    return std::max<std::size_t>(2, static_cast<std::size_t>(std::floor(perSecond * duration)));
}

constexpr double halfStep = 0.5 * leastAmplitude; // of 8 bits

/// Sets the level to few points of a dense one, and adds what that loses.
void fewLevels(ExportVoice& result, const Curve& level, const EmphasisPlayer* player, LevelScale scale,
               double pointsPerSecond)
{
    result.level = fewPoints(level, result.events, player, {pointCount(pointsPerSecond, result.duration), halfStep});
    if (player)
        lowerToEvents(result.level, result.events);
    LossTrack track(LossKind::points,
                    fmt::format("{:g} amplitude points per second are too few to keep the curve", pointsPerSecond));
    compare(level, result.level,
            [&](double time, double exact, double kept)
            {
                const double error =
                    scale == LevelScale::root ? std::abs(kept * kept - exact * exact) : std::abs(kept - exact);
                track.add(time, error > leastAmplitude ? error : 0.0);
            });
    result.losses.append(track);
}

/// Likewise the frequency, of which the loud parts count most.
void fewFrequencies(ExportVoice& result, const Curve& frequency, const Curve& amplitude, const NormalisedRange& range,
                    double pointsPerSecond)
{
    std::vector<double> weights = timeShares(frequency);
    CurveReader level(amplitude);
    for (std::size_t i = 0; i < frequency.size(); ++i)
    {
        const double a = level.at(frequency[i].time);
        const double hertz = std::max(range.hertzOf(frequency[i].value), 1.0);
        weights[i] *= (a * a + 1e-6) / (hertz * hertz);
    }
    result.frequency = anchoredCurve(frequency, {}, {pointCount(pointsPerSecond, result.duration), halfStep}, weights);
    LossTrack track(LossKind::frequency,
                    fmt::format("{:g} frequency points per second are too few to keep the curve", pointsPerSecond));
    CurveReader loudness(amplitude);
    compare(frequency, result.frequency,
            [&](double time, double exact, double kept)
            {
                constexpr double semitone = 1.0 / 12.0; // of an octave
                const double error =
                    std::abs(std::log2(std::max(range.hertzOf(kept), 1.0) / std::max(range.hertzOf(exact), 1.0)));
                track.add(time, error > semitone && loudness.at(time) > leastAmplitude ? error : 0.0);
            });
    result.losses.append(track);
}
} // namespace

ExportVoice exportVoice(const Clip& clip, const ExportParams& params, const VoiceFormat& format)
{
    const NormalisedRange range = normalisedRangeOf(params.profile, format.range);
    SingleVoice voice = params.profile
                            ? singleVoiceOf(adaptClip(clip, *params.profile, {true, false, false, 0_dB, {}}).clip,
                                            range.low, range.high)
                            : singleVoiceOf(clip, range.low, range.high);
    ExportVoice result;
    result.name = params.name.empty() ? clip.name : params.name;
    result.duration = std::max(clip.duration, shortest);
    result.losses.addOneVoice(clip, voice);
    result.losses.addMarkers(clip);
    result.losses.limit(voice.amplitude, 1.0);
    result.losses.limit(voice.events, 1.0);
    if (clip.duration < shortest)
        result.losses.add(LossKind::length, 0.0, clip.duration, shortest - clip.duration, "becomes 10 ms long");

    const auto whole = [&](Curve curve, double otherwise)
    {
        if (curve.empty())
            curve = {{0.0, otherwise}};
        return detail::overWholeTime(std::move(curve), result.duration);
    };
    voice.amplitude = whole(std::move(voice.amplitude), 0.0);
    const Curve level = format.scale == LevelScale::root ? rootOf(voice.amplitude) : voice.amplitude;
    const Curve frequency = whole(normalised(voice, range, result.losses), 0.5);
    const bool keepsPoints = isSingleVoice(clip);
    const EmphasisPlayer* player = keepsPoints || format.events.ducking == 1.0 ? nullptr : &format.events;
    for (Transient& event : voice.events)
        event.time = std::clamp(event.time, 0.0, result.duration);
    result.events = keepsPoints ? std::move(voice.events)
                                : emphasesOf(std::move(voice.events), voice.amplitude, format.events, result.losses);
    std::vector<double> eventTimes;
    for (Transient& event : result.events)
    {
        if (format.scale == LevelScale::root)
            event.amplitude = std::sqrt(event.amplitude);
        eventTimes.push_back(event.time);
    }

    if (keepsPoints && !params.amplitudePoints)
        result.level = detail::withAnchors(level, eventTimes).curve;
    else
        fewLevels(result, level, player, format.scale, params.amplitudePoints.value_or(format.amplitudePoints));
    if (keepsPoints && !params.frequencyPoints)
        result.frequency = frequency;
    else
        fewFrequencies(result, frequency, voice.amplitude, range,
                       params.frequencyPoints.value_or(format.frequencyPoints));
    return result;
}

} // namespace pacini
