#include "io/formats/VoiceExport.h"

#include "io/formats/FormatLosses.h"

#include <pacini/simplify/AnchoredCurve.h>
#include <pacini/simplify/HatBasis.h>
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

/// Cuts the curve into pieces whose roots differ by at most twice the root of the tolerance: between the ends r0 and r1
/// of a line, the square of the mean root is off by (r1 - r0)^2 / 4.
template <typename ToRoot, typename FromRoot>
Curve bent(const Curve& curve, ToRoot toRoot, FromRoot fromRoot)
{
    const double longest = 2.0 * std::sqrt(leastAmplitude) * (1.0 + 1e-6);
    Curve result;
    for (std::size_t i = 0; i < curve.size(); ++i)
    {
        if (i > 0 && curve[i].time > curve[i - 1].time)
        {
            const double r0 = toRoot(curve[i - 1].value), r1 = toRoot(curve[i].value);
            const auto pieces = std::ceil(std::abs(r1 - r0) / longest);
            for (double k = 1.0; k < pieces; k += 1.0)
            {
                // The place on the line of the curve where the root is r.
                const double r = r0 + (r1 - r0) * k / pieces;
                const auto [at, value] = fromRoot(r, curve[i - 1], curve[i]);
                result.push_back({at, value});
            }
        }
        result.push_back({curve[i].time, fromRoot(toRoot(curve[i].value), curve[i], curve[i]).value});
    }
    return result;
}

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
    LossTrack track(LossKind::frequency,
                    fmt::format("frequencies outside of {:.0f} to {:.0f} Hz move to its ends", range.low, range.high));
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

/// Leaves out events that the voice reaches by itself. Players make room for an emphasis by ducking the voice, or play
/// it on top: either hides the onset that is there already, which cost up to 9 points of HTS in single sounds.
void dropReached(std::vector<Transient>& events, LossList& losses)
{
    for (const Transient& event : events)
        if (event.amplitude <= 0.0)
            losses.add(LossKind::event, event.time, 0.0, 0.0,
                       "events that the amplitude reaches by itself are left out");
    std::erase_if(events, [](const Transient& event) { return event.amplitude <= 0.0; });
}

std::size_t pointCount(double perSecond, double duration)
{
    return std::max<std::size_t>(2, static_cast<std::size_t>(std::floor(perSecond * duration)));
}
} // namespace

Curve rootOf(const Curve& amplitude)
{
    return bent(
        amplitude, [](double a) { return std::sqrt(std::max(a, 0.0)); },
        [](double r, const Breakpoint& from, const Breakpoint& to)
        {
            const double rise = to.value - from.value;
            const double place = rise != 0.0 ? std::clamp((r * r - from.value) / rise, 0.0, 1.0) : 0.0;
            return Breakpoint{from.time + place * (to.time - from.time), r};
        });
}

Curve squareOf(const Curve& level)
{
    return bent(
        level, [](double r) { return r; },
        [](double r, const Breakpoint& from, const Breakpoint& to)
        {
            const double rise = to.value - from.value;
            const double place = rise != 0.0 ? std::clamp((r - from.value) / rise, 0.0, 1.0) : 0.0;
            return Breakpoint{from.time + place * (to.time - from.time), r * r};
        });
}

ExportVoice exportVoice(const Clip& clip, const ExportParams& params, const VoiceFormat& format)
{
    constexpr double tolerance = 0.5 * leastAmplitude;
    const NormalisedRange range = normalisedRangeOf(params.profile, format.range);
    SingleVoice voice = params.profile
                            ? singleVoiceOf(adaptClip(clip, *params.profile, {true, false, false, 0.0, {}}).clip)
                            : singleVoiceOf(clip);
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
    if (!keepsPoints)
        dropReached(voice.events, result.losses);
    result.events = std::move(voice.events);
    std::vector<double> eventTimes;
    for (Transient& event : result.events)
    {
        event.time = std::clamp(event.time, 0.0, result.duration);
        if (!keepsPoints)
        {
            // Players must not show an event weaker than the voice around it.
            event.amplitude = std::max(event.amplitude, valueAt(voice.amplitude, event.time));
            event.sharpness = format.events.normalisedOf(100.0 * std::pow(2.8, event.sharpness));
        }
        if (format.scale == LevelScale::root)
            event.amplitude = std::sqrt(event.amplitude);
        eventTimes.push_back(event.time);
    }

    if (keepsPoints && !params.amplitudePoints)
        result.level = detail::withAnchors(level, eventTimes).curve;
    else
    {
        const double rate = params.amplitudePoints.value_or(format.amplitudePoints);
        result.level =
            anchoredCurve(level, eventTimes, {pointCount(rate, result.duration), tolerance}, timeShares(level));
        LossTrack track(LossKind::points, fmt::format("{:g} points per second of amplitude do not say all", rate));
        compare(level, result.level,
                [&](double time, double exact, double kept)
                {
                    const double error = format.scale == LevelScale::root ? std::abs(kept * kept - exact * exact)
                                                                          : std::abs(kept - exact);
                    track.add(time, error > leastAmplitude ? error : 0.0);
                });
        result.losses.append(track);
    }
    if (keepsPoints && !params.frequencyPoints)
        result.frequency = frequency;
    else
    {
        const double rate = params.frequencyPoints.value_or(format.frequencyPoints);
        std::vector<double> weights = timeShares(frequency);
        CurveReader amplitude(voice.amplitude);
        for (std::size_t i = 0; i < frequency.size(); ++i)
        {
            const double a = amplitude.at(frequency[i].time);
            const double hertz = std::max(range.hertzOf(frequency[i].value), 1.0);
            weights[i] *= (a * a + 1e-6) / (hertz * hertz);
        }
        result.frequency = anchoredCurve(frequency, {}, {pointCount(rate, result.duration), tolerance}, weights);
        LossTrack track(LossKind::frequency, fmt::format("{:g} points per second of frequency do not say all", rate));
        CurveReader loudness(voice.amplitude);
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
    return result;
}

} // namespace pacini
