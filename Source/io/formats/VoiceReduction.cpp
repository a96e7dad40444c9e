#include "io/formats/VoiceReduction.h"

#include "io/formats/RootCurve.h"

#include <pacini/foundation/SizeInMemory.h>
#include <pacini/simplify/AnchoredCurve.h>
#include <pacini/simplify/HatBasis.h>
#include <pacini/simplify/Refit.h>
#include <pacini/simplify/Simplify.h>
#include <pacini/synthesis/ClipAdaptation.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pacini
{

namespace
{
constexpr double shortest = 0.01; // s

/// The clip with its frequencies moved into the range of `profile`; nothing without one.
std::optional<Clip> movedClip(const Clip& clip, const std::optional<Profile>& profile)
{
    AdaptationParams onlyFrequencies;
    onlyFrequencies.voices = false;
    onlyFrequencies.dynamicRange = false;
    onlyFrequencies.maxBoost = 0_dB;
    onlyFrequencies.strength = 0.0;
    return profile ? std::optional(adaptClip(clip, *profile, onlyFrequencies).clip) : std::nullopt;
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
                    fmt::format("frequencies are limited to {:.0f} to {:.0f} Hz", range.low, range.high));
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

/// Events weaker by `gain`, but not weaker than their points.
void weaken(std::vector<Transient>& events, const Curve& level, double gain)
{
    auto point = level.begin();
    for (Transient& event : events)
    {
        while (point != level.end() && point->time < event.time)
            ++point;
        const double least = point != level.end() && point->time == event.time ? point->value : 0.0;
        event.amplitude = std::max(gain * event.amplitude, std::min(least, event.amplitude));
    }
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

/// The transients for the events of a clip of several bands. `beside` are its events as strong as they are beside the
/// voice `amplitude`.
std::vector<Transient> transientsOf(const std::vector<Transient>& events, const std::vector<Transient>& beside,
                                    const Curve& amplitude, const EmphasisPlayer& player, EventExport how,
                                    LossList& losses)
{
    std::vector<Transient> shown, emphases;
    std::string why;
    if (how == EventExport::merged)
    {
        shown = emphases = emphasesOf(beside, amplitude, player);
        why = "dropped: already covered by the amplitude curve";
    }
    else
    {
        std::vector<double> beyond;
        for (const std::size_t i : separated(events, player.separation))
            if (events[i].amplitude > 0.0)
            {
                shown.push_back(events[i]);
                beyond.push_back(beside[i].amplitude);
            }
        emphases = emphasisOfEach(shown, beyond, amplitude, player);
        why = fmt::format("dropped: a stronger event is less than {:g} ms away", 1000.0 * player.separation);
    }
    losses.addOmitted(events, shown, why);
    return emphases;
}

std::size_t pointCount(double perSecond, double duration)
{
    return std::clamp<std::size_t>(sizeInMemory(std::floor(perSecond * duration)), 2, limits::points);
}

constexpr double halfStep = 0.5 * leastAmplitude; // of 8 bits

/// Sets the level to few points of a dense one, `more` beside those per second, and adds what that loses.
void fewLevels(NormalisedVoice& result, const Curve& level, const EmphasisPlayer* player, LevelScale scale,
               double pointsPerSecond, double more)
{
    const std::size_t count = pointCount(pointsPerSecond, result.duration) + static_cast<std::size_t>(more);
    result.level = fewPoints(level, result.events, player, {count, halfStep});
    if (player)
        lowerToEvents(result.level, result.events);
    LossTrack track(LossKind::points,
                    fmt::format("limited to {:g} amplitude points/s; detail is lost", pointsPerSecond));
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
void fewFrequencies(NormalisedVoice& result, const Curve& frequency, const Curve& amplitude,
                    const NormalisedRange& range, double pointsPerSecond)
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
                    fmt::format("limited to {:g} frequency points/s; detail is lost", pointsPerSecond));
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

SingleVoice oneVoice(const Clip& clip, const std::optional<Profile>& profile, double otherwise)
{
    const std::optional<Clip> moved = movedClip(clip, profile);
    SingleVoice voice = singleVoiceOf(moved ? *moved : clip);
    if (voice.frequency.empty())
        voice.frequency = {{0.0, otherwise}};
    if (voice.amplitude.empty())
        voice.amplitude = {{0.0, 0.0}, {clip.duration, 0.0}};
    std::erase_if(voice.events, [](const Transient& event) { return event.amplitude <= 0.0; });
    return voice;
}

Clip clipOfVoice(SingleVoice voice)
{
    Clip clip;
    clip.duration = voice.duration;
    clip.transients = std::move(voice.events);
    const bool silent = std::all_of(voice.amplitude.begin(), voice.amplitude.end(),
                                    [](const Breakpoint& point) { return point.value == 0.0; });
    if (silent)
        return clip;
    Band band;
    band.amplitude = std::move(voice.amplitude);
    const auto lower = [](const Breakpoint& a, const Breakpoint& b)
    {
        return a.value < b.value;
    };
    const auto [lowest, highest] = std::minmax_element(voice.frequency.begin(), voice.frequency.end(), lower);
    band.lowFrequency = lowest->value;
    band.highFrequency = highest->value;
    band.centreFrequency = std::clamp(std::sqrt(lowest->value * highest->value), lowest->value, highest->value);
    if (band.lowFrequency < band.highFrequency)
        band.pitch = std::move(voice.frequency);
    clip.bands.push_back(std::move(band));
    return clip;
}

double burstLength(const std::vector<Transient>& events, std::size_t i, double burst)
{
    const double gap = i + 1 < events.size() ? events[i + 1].time - events[i].time : burst;
    return gap < burst ? 0.6 * gap : burst;
}

std::vector<double> strengthOf(const SingleVoice& voice, double step, double burst)
{
    std::vector<double> strength(static_cast<std::size_t>(std::ceil(voice.duration / step - 1e-9)));
    CurveReader amplitude(voice.amplitude);
    for (std::size_t n = 0; n < strength.size(); ++n)
        strength[n] = amplitude.at((static_cast<double>(n) + 0.5) * step);
    for (std::size_t i = 0; i < voice.events.size(); ++i)
    {
        const Transient& event = voice.events[i];
        const double length = burstLength(voice.events, i, burst);
        // The nearest step: the one that it falls into may begin almost a step too early.
        const auto first = static_cast<std::size_t>(std::llround(event.time / step));
        const auto last = std::max(first + 1, static_cast<std::size_t>(std::llround((event.time + length) / step)));
        for (std::size_t n = first; n < std::min(last, strength.size()); ++n)
            strength[n] = std::hypot(strength[n], event.amplitude);
    }
    return strength;
}

Curve thinned(const Curve& curve, double pointsPerSecond, double duration)
{
    SimplifyParams params;
    params.count = std::min(sizeInMemory(std::ceil(pointsPerSecond * std::max(duration, 0.1))), limits::points) + 1;
    const auto simple = simplify(curve, params);
    return simple ? *simple : curve;
}

ReducedVoice reducedVoice(const Clip& clip, const ExportParams& params, double otherwise)
{
    ReducedVoice result{oneVoice(clip, params.profile, otherwise), {}};
    addVoiceLosses(result.losses, clip, result.voice);
    result.losses.addText(clip, true);
    result.losses.limit(result.voice.amplitude, 1.0);
    return result;
}

ReducedVoice reducedStrength(const Clip& clip, const ExportParams& params, double otherwise)
{
    ReducedVoice result{oneVoice(clip, params.profile, otherwise), {}};
    addStrengthLosses(result.losses, clip, result.voice);
    result.losses.addText(clip, true);
    result.losses.limit(result.voice.amplitude, 1.0);
    result.losses.limit(result.voice.events, 1.0);
    return result;
}

NormalisedVoice normalisedVoice(const Clip& clip, const ExportParams& params, const VoiceFormat& format)
{
    const NormalisedRange range = normalisedRangeOf(params.profile, format.range);
    NormalisedVoice result;
    result.name = params.name.empty() ? clip.name : params.name;
    result.duration = std::max(clip.duration, shortest);
    const std::optional<Clip> moved = movedClip(clip, params.profile);
    result.wasSingle = isSingleVoice(clip);
    SingleVoice voice = singleVoiceOf(moved ? *moved : clip, range.low, range.high);
    addVoiceLosses(result.losses, clip, voice);
    result.losses.addMarkers(clip);
    result.losses.limit(voice.amplitude, 1.0);
    result.losses.limit(voice.events, 1.0);
    if (clip.duration < shortest)
        result.losses.add(LossKind::length, 0.0, clip.duration, shortest - clip.duration, "extended to 10 ms");

    const auto whole = [&](Curve curve, double otherwise)
    {
        if (curve.empty())
            curve = {{0.0, otherwise}};
        return detail::overWholeTime(std::move(curve), result.duration);
    };
    voice.amplitude = whole(std::move(voice.amplitude), 0.0);
    const Curve level = format.scale == LevelScale::root ? rootOf(voice.amplitude) : voice.amplitude;
    const Curve frequency = whole(normalised(voice, range, result.losses), 0.5);
    const bool keepsPoints = result.wasSingle;
    const EmphasisPlayer* player = keepsPoints || format.events.ducking == 1.0 ? nullptr : &format.events;
    std::vector<Transient> events = clip.transients;
    for (std::vector<Transient>* list : {&events, &voice.events})
        for (Transient& event : *list)
            event.time = std::clamp(event.time, 0.0, result.duration);
    result.events = keepsPoints ? std::move(voice.events)
                                : transientsOf(events, voice.events, voice.amplitude, format.events,
                                               params.events.value_or(usualEvents), result.losses);
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
        fewLevels(result, level, player, format.scale, params.amplitudePoints.value_or(format.amplitudePoints),
                  params.amplitudePoints ? 0.0 : format.pointsPerEvent * static_cast<double>(result.events.size()));
    if (!keepsPoints && params.events.value_or(usualEvents) == EventExport::transients)
        weaken(result.events, result.level, format.eventLevel);
    if (keepsPoints && !params.frequencyPoints)
        result.frequency = frequency;
    else
        fewFrequencies(result, frequency, voice.amplitude, range,
                       params.frequencyPoints.value_or(format.frequencyPoints));
    return result;
}

} // namespace pacini
