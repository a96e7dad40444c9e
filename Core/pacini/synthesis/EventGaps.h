#pragma once

// Gaps before events, which make an event stand out of its surroundings.

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Portable.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

namespace pacini
{

/// Parameters of the gaps. Skin detects a new event by the rise of the level within some 10 ms, the memory of skin and
/// actuator (gap detection: G. Gescheider, "Auditory and cutaneous temporal resolution of successive brief stimuli",
/// 1967). The values were found by trial on the annotated recordings of the corpus.
struct EventGapParams
{
    double rise = 22.0;   ///< dB by which the level is to rise from the gap to the event; softer events get it as far
                          ///< as the range below allows
    double enough = 17.0; ///< dB of rise within `reach` before an event that needs no gap
    double range = 30.0;  ///< dB below the strongest moment of the clip; weaker parts are not felt beside it
    double hold = 0.003;  ///< s for which the gap is open
    double fade = 0.002;  ///< opening time before the gap, s
    double least = 4.0;   ///< dB by which an event rises by itself at least: softer ones are texture, such as rain, and
                          ///< gaps before each would be felt instead of it
    double strongShare = 0.6;   ///< of the clip's strongest moment: events of that amplitude are not taken for texture
    double strongLeast = 3.0;   ///< instead of `least`, for them
    double strongHold = 0.0035; ///< instead of `hold`, for them
    double reach = 0.012;       ///< s
    double attack = 0.001;      ///< time in which the level returns after the event's time, s
    /// Between events closer than `train` s that rise by at least `trainRise` dB, pulses carry the level: the gap is
    /// silent and lasts as long as their ringing allows.
    double train = 0.045, trainRise = 10.0;
    double trainHold = 0.45; ///< of the time since the event before, instead of `hold`
    double trainFade = 0.2;  ///< instead of `fade`
    /// The actuator rings on into the gap. The gap then stays open until the ringing is `ringRise` dB below the event,
    /// but at most for a share of the time since the event before.
    double ring = 0.0;       ///< time in which the ringing falls to 1/e, s; 0: no ringing
    double ringRise = 18.0;  ///< dB
    double ringShare = 0.35; ///< of the time since the event before
    bool operator==(const EventGapParams&) const = default;
};

namespace detail
{

inline constexpr double peakOfMean = 2.0; ///< peak of the bands relative to a mean over 10 ms

/// The largest value of a curve from `first` to `last` s; the smallest where `pick` is the minimum.
template <typename Pick>
double extremeWithin(const Curve& curve, double first, double last, Pick pick) noexcept
{
    double extreme = pick(valueAt(curve, first), valueAt(curve, last));
    for (auto p = std::lower_bound(curve.begin(), curve.end(), first,
                                   [](const Breakpoint&point, double time) { return point.time < time; });
         p != curve.end() && p->time <= last; ++p)
        extreme = pick(extreme, p->value);
    return extreme;
}

inline double largestWithin(const Curve& curve, double first, double last) noexcept
{
    return extremeWithin(curve, first, last, [](double a, double b) { return std::max(a, b); });
}

inline double smallestWithin(const Curve& curve, double first, double last) noexcept
{
    return extremeWithin(curve, first, last, [](double a, double b) { return std::min(a, b); });
}

/// How long a gap before `event`, which gets as strong as `full`, has to be open until the ringing of `envelope` is low
/// enough in it, s; 0 where that is at once.
inline double ringingOut(const Curve& envelope, const Transient& event, double full, double since,
                         const EventGapParams& params) noexcept
{
    if (!(params.ring > 0.0))
        return 0.0;
    const double before = peakOfMean * largestWithin(envelope, event.time - 4.0 * params.ring, event.time);
    const double nepers = portable::log(before / full) + params.ringRise * std::numbers::ln10 / 20.0;
    return std::clamp(params.ring * nepers, 0.0, params.ringShare * since);
}

} // namespace detail

/// Returns `envelope` (means over 10 ms; bands peak at twice its value) with a gap before each of `events`, which are
/// in order of time, except where the envelope rises enough. The level in a gap lets the event rise by `rise` dB, with
/// the strength of its amplitude or of the envelope within 10 ms after it. O(points + events log points).
[[nodiscard]] inline Curve withEventGaps(const Curve& envelope, std::span<const Transient> events,
                                         const EventGapParams& params = {})
{
    if (envelope.empty() || events.empty())
        return envelope;
    using detail::peakOfMean;
    double top = 0.0;
    for (const Breakpoint& point : envelope)
        top = std::max(top, point.value);
    for (const Transient& event : events)
        top = std::max(top, event.amplitude);
    const double unfelt = top * portable::exp10(-params.range / 20.0);
    const double ratio = portable::exp10(params.rise / 20.0);

    Curve result;
    result.reserve(envelope.size() + 5 * events.size());
    std::size_t copied = 0; // points of the envelope
    double free = -1.0;     // s, up to which the result is made
    double before = -std::numeric_limits<double>::infinity();
    for (const Transient& event : events)
    {
        const double since = event.time - before;
        before = event.time;
        const double full =
            std::max(event.amplitude, peakOfMean * detail::largestWithin(envelope, event.time, event.time + 0.010));
        const double lowest = peakOfMean * detail::smallestWithin(envelope, event.time - params.reach, event.time);
        const double rise = Decibels::fromGain((full + unfelt) / (lowest + unfelt)).value;
        const bool inTrain = since < params.train && rise >= params.trainRise;
        const bool strong = event.amplitude >= params.strongShare * top;
        const double least = strong ? params.strongLeast : params.least;
        if (!(full > 0.0) || (!inTrain && (rise < least || rise >= params.enough)))
            continue;
        const double hold = inTrain ? params.trainHold * since : strong ? params.strongHold : params.hold;
        const double open = event.time - std::max(hold, detail::ringingOut(envelope, event, full, since, params));
        const double start = open - (inTrain ? params.trainFade * since : params.fade);
        if (start <= free || event.time <= 0.0)
            continue;
        const double low = inTrain ? 0.0 : std::max(0.0, (full + unfelt) / ratio - unfelt) / peakOfMean;
        const double closed = event.time + params.attack;
        for (; copied < envelope.size() && envelope[copied].time < start; ++copied)
            result.push_back(envelope[copied]);
        while (copied < envelope.size() && envelope[copied].time <= closed)
            ++copied;
        const auto within = [&](double time, double most)
        {
            if (time >= 0.0)
                result.push_back({time, std::min(most, valueAt(envelope, time))});
        };
        const double any = std::numeric_limits<double>::max();
        within(start, any);
        within(open, low);
        within(event.time, low);
        within(closed, any);
        free = closed;
    }
    result.insert(result.end(), envelope.begin() + static_cast<std::ptrdiff_t>(copied), envelope.end());
    return result;
}

} // namespace pacini
