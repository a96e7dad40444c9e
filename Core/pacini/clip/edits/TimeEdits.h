#pragma once

// Edits of a whole clip's time: trim, cut, split, join, insert, repeat, reverse, stretch. Pure functions; each result
// passes validate() when the clips did. Sinusoids run on over joints, so that these do not click; curves step there.

#include <pacini/clip/edits/CurveSection.h>
#include <pacini/clip/edits/RangeEdits.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

namespace detail
{
/// Applies `edit` to every curve of a clip.
template <typename F>
void forAllCurves(Clip& clip, F&& edit)
{
    for (const Lane& lane : lanesOf(clip))
        edit(lane, *curveOf(clip, lane));
}

/// Events of [from, to), or [from, to] when the range ends with the clip, moved by -from.
template <typename Event>
[[nodiscard]] std::vector<Event> eventSection(const std::vector<Event>& events, TimeRange range, double duration)
{
    std::vector<Event> part;
    for (Event event : events)
        if (event.time >= range.from && (event.time < range.to || range.to >= duration))
        {
            event.time = std::min(event.time, range.to) - range.from;
            part.push_back(std::move(event));
        }
    return part;
}

template <typename Event>
void appendEvents(std::vector<Event>& events, const std::vector<Event>& part, double at)
{
    // validate() lets times lie a microsecond behind the clip's end.
    for (auto event = events.rbegin(); event != events.rend() && event->time > at; ++event)
        event->time = at;
    for (Event event : part)
    {
        event.time += at;
        events.push_back(std::move(event));
    }
}

/// Returns the level that an envelope would have: the root of the summed power of the bands, at all their points.
[[nodiscard]] inline Curve impliedEnvelope(const Clip& clip)
{
    std::vector<double> times = {0.0, clip.duration};
    for (const Band& band : clip.bands)
        for (const Breakpoint& p : band.amplitude)
            times.push_back(p.time);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    std::vector<double> power(times.size(), 0.0);
    for (const Band& band : clip.bands)
    {
        CurveReader reader(band.amplitude);
        for (std::size_t i = 0; i < times.size(); ++i)
        {
            const double a = reader.at(times[i]);
            power[i] += a * a;
        }
    }
    Curve envelope;
    for (std::size_t i = 0; i < times.size(); ++i)
        envelope.push_back({times[i], std::min(std::sqrt(power[i]), limits::amplitude)});
    return envelope;
}

/// Gives `clip` the bands of `other` that it lacks, silent; returns for each band of `other` its index in `clip`.
template <typename SameBand, typename List>
[[nodiscard]] std::vector<std::size_t> addMissingBands(List& bands, const List& others, SameBand&& same)
{
    std::vector<std::size_t> places;
    std::vector<bool> taken(bands.size(), false);
    for (const auto& other : others)
    {
        std::size_t k = 0;
        while (k < taken.size() && (taken[k] || !same(bands[k], other)))
            ++k;
        if (k < taken.size())
            taken[k] = true;
        else
        {
            k = bands.size();
            auto added = other;
            added.amplitude.clear();
            if constexpr (requires { added.pitch; })
            {
                added.pitch.clear();
                added.phase = 0.0;
            }
            bands.push_back(std::move(added));
        }
        places.push_back(k);
    }
    return places;
}

/// Appends curve `b` at `at`, the end of clip `a`. An empty curve is constant at `emptyA` or `emptyB`.
inline void joinCurves(Curve& a, const Curve& b, double at, double lengthOfB, double emptyA, double emptyB)
{
    if (a.empty() && b.empty())
        return;
    if (a.empty())
        a = {{0.0, emptyA}};
    cutAfter(a, at); // validate() lets times lie a microsecond behind the clip's end
    appendPoint(a, {at, valueAt(a, at)});
    Curve whole = b.empty() ? Curve{{0.0, emptyB}, {lengthOfB, emptyB}} : b;
    cutAfter(whole, lengthOfB);
    appendPoint(a, {at, whole.front().value});
    appendCurve(a, whole, at);
}
} // namespace detail

/// The part of a clip inside `range`; its time starts at 0. Events at the end of the range belong to it only where the
/// clip ends. Range clamped to the clip.
[[nodiscard]] inline Clip trimClip(Clip clip, TimeRange range)
{
    const TimeRange within = withinClip(range, clip.duration);
    detail::forAllCurves(clip, [&](Lane, Curve& curve) { curve = curveSection(curve, within); });
    clip.transients = detail::eventSection(clip.transients, within, clip.duration);
    clip.markers = detail::eventSection(clip.markers, within, clip.duration);
    clip.duration = within.to - within.from;
    return clip;
}

/// Returns both parts of a clip split at `time` (clamped to the clip).
[[nodiscard]] inline std::pair<Clip, Clip> splitClip(const Clip& clip, double time)
{
    const double at = clampTo(time, 0.0, clip.duration);
    Clip left = trimClip(clip, {0.0, at});
    if (at < clip.duration)
        return {std::move(left), trimClip(clip, {at, clip.duration})};
    Clip right = trimClip(clip, {at, at});
    right.transients.clear();
    right.markers.clear();
    return {std::move(left), std::move(right)};
}

/// Clip `b` behind clip `a`. Name, source and encoder are those of `a`. Bands of the same frequencies are continued;
/// bands that only one of them has are silent during the other. Where only one has an envelope or pitch, the other's
/// is what it would be: the power sum of its bands, the band's centre. Carriers run on from the phases of `a`.
/// tooLarge: more than 256 bands, 24 h or 50 million points in all.
[[nodiscard]] inline Result<Clip> joinClips(Clip a, const Clip& b)
{
    const double at = a.duration;
    if (a.duration + b.duration > limits::duration)
        return Error{ErrorCode::tooLarge, "duration", "would be longer than 24 hours"};
    if (breakpointCount(a) + breakpointCount(b) > limits::points)
        return Error{ErrorCode::tooLarge, "", "would have more than 50 million points"};
    if (b.duration == 0.0)
        return a;
    const bool levelled = !a.envelope.empty() || !b.envelope.empty();
    const Curve envelopeOfB = levelled && b.envelope.empty() ? detail::impliedEnvelope(b) : b.envelope;
    if (levelled && a.envelope.empty())
        a.envelope = detail::impliedEnvelope(a);
    detail::joinCurves(a.envelope, envelopeOfB, at, b.duration, 0.0, 0.0);
    detail::joinCurves(a.centroid, b.centroid, at, b.duration, b.centroid.empty() ? 0.0 : b.centroid.front().value,
                       a.centroid.empty() ? 0.0 : a.centroid.back().value);

    const auto places = detail::addMissingBands(a.bands, b.bands,
                                                [](const Band& x, const Band& y)
                                                {
                                                    return x.lowFrequency == y.lowFrequency &&
                                                           x.centreFrequency == y.centreFrequency &&
                                                           x.highFrequency == y.highFrequency;
                                                });
    const auto noisePlaces =
        detail::addMissingBands(a.noise, b.noise,
                                [](const NoiseBand& x, const NoiseBand& y)
                                { return x.lowFrequency == y.lowFrequency && x.highFrequency == y.highFrequency; });
    if (a.bands.size() > limits::bands)
        return Error{ErrorCode::tooLarge, "bands", "would be more than 256"};
    const Curve nothing;
    std::vector<const Band*> parts(a.bands.size(), nullptr);
    for (std::size_t k = 0; k < places.size(); ++k)
        parts[places[k]] = &b.bands[k];
    for (std::size_t k = 0; k < parts.size(); ++k)
    {
        Band& band = a.bands[k];
        const double centre = std::max(band.centreFrequency, laneRange(LaneKind::pitch).low);
        detail::joinCurves(band.amplitude, parts[k] != nullptr ? parts[k]->amplitude : nothing, at, b.duration, 0.0,
                           0.0);
        detail::joinCurves(band.pitch, parts[k] != nullptr ? parts[k]->pitch : nothing, at, b.duration, centre, centre);
    }
    std::vector<const NoiseBand*> noiseParts(a.noise.size(), nullptr);
    for (std::size_t k = 0; k < noisePlaces.size(); ++k)
        noiseParts[noisePlaces[k]] = &b.noise[k];
    for (std::size_t k = 0; k < noiseParts.size(); ++k)
        detail::joinCurves(a.noise[k].amplitude, noiseParts[k] != nullptr ? noiseParts[k]->amplitude : nothing, at,
                           b.duration, 0.0, 0.0);
    detail::appendEvents(a.transients, b.transients, at);
    detail::appendEvents(a.markers, b.markers, at);
    a.duration += b.duration;
    return a;
}

/// Removes a time range; the content after it moves forward.
[[nodiscard]] inline Result<Clip> cutClip(const Clip& clip, TimeRange range)
{
    const TimeRange within = withinClip(range, clip.duration);
    return joinClips(splitClip(clip, within.from).first, splitClip(clip, within.to).second);
}

/// Inserts `part` at `time` (clamped to the clip); the content after it moves back. Errors as in joinClips().
[[nodiscard]] inline Result<Clip> insertClip(const Clip& clip, double time, const Clip& part)
{
    const auto [left, right] = splitClip(clip, time);
    auto front = joinClips(left, part);
    return front ? joinClips(std::move(front).value(), right) : front;
}

/// A clip `passes` times (1 to 10 000, clamped) one after the other. Errors as in joinClips().
[[nodiscard]] inline Result<Clip> repeatClip(const Clip& clip, int passes)
{
    const int count = std::clamp(passes, 1, 10'000);
    if (clip.duration * count > limits::duration)
        return Error{ErrorCode::tooLarge, "duration", "would be longer than 24 hours"};
    if (static_cast<std::uint64_t>(breakpointCount(clip)) * static_cast<std::uint64_t>(count) > limits::points)
        return Error{ErrorCode::tooLarge, "", "would have more than 50 million points"};
    Clip result = clip;
    for (int pass = 1; pass < count; ++pass)
    {
        auto longer = joinClips(std::move(result), clip);
        if (!longer)
            return longer;
        result = std::move(longer).value();
    }
    return result;
}

/// A clip backwards. Transients keep their times' mirror images, sharpness stays.
[[nodiscard]] inline Clip reverseClip(Clip clip)
{
    const auto mirror = [&](auto& events)
    {
        for (auto& event : events)
            event.time = clampTo(clip.duration - event.time, 0.0, clip.duration);
        std::reverse(events.begin(), events.end());
    };
    detail::forAllCurves(clip, [&](Lane, Curve& curve) { mirror(curve); });
    mirror(clip.transients);
    mirror(clip.markers);
    return clip;
}

/// All times multiplied by `ratio` (0.01 to 100, clamped); pitches stay. tooLarge: longer than 24 h.
[[nodiscard]] inline Result<Clip> stretchClip(Clip clip, double ratio)
{
    const double factor = clampTo(ratio, 0.01, 100.0);
    if (clip.duration * factor > limits::duration)
        return Error{ErrorCode::tooLarge, "duration", "would be longer than 24 hours"};
    const auto scale = [&](auto& events)
    {
        for (auto& event : events)
            event.time = std::min(event.time * factor, clip.duration * factor);
    };
    detail::forAllCurves(clip, [&](Lane, Curve& curve) { scale(curve); });
    scale(clip.transients);
    scale(clip.markers);
    clip.duration *= factor;
    return clip;
}

} // namespace pacini
