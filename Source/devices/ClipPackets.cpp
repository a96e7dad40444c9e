#include "devices/ClipPackets.h"

#include <pacini/synthesis/PulseLevel.h>
#include <pacini/synthesis/TransientPulse.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pacini::devices
{

namespace
{
bool isStronger(const EventPulse& a, const EventPulse& b) noexcept
{
    return a.tone.amplitude != b.tone.amplitude ? a.tone.amplitude > b.tone.amplitude : a.level > b.level;
}
} // namespace

ClipPackets::ClipPackets(Clip clipToPlay, const PlayRange& rangeToPlay, double gainToPlay, Seconds packetInterval)
    : clip(std::move(clipToPlay)),
      range(rangeToPlay),
      length(rangeToPlay.to.value - rangeToPlay.from.value),
      gain(gainToPlay),
      interval(packetInterval.value)
{
}

std::optional<std::int64_t> ClipPackets::count() const noexcept
{
    if (range.loop)
        return std::nullopt;
    // The last one is nearest to an event at the very end.
    return static_cast<std::int64_t>(std::floor(length / interval + 0.5)) + 1;
}

PacketContent ClipPackets::at(std::int64_t packet)
{
    const double start = static_cast<double>(packet) * interval;
    const double until = start + 0.5 * interval;
    PacketContent content{bandsBetween(start, start + interval), strongestBetween(eventsUntil, until)};
    eventsUntil = until;
    return content;
}

std::vector<RumbleTone> ClipPackets::bandsBetween(double start, double end) const
{
    double share = 1.0;
    double from = start;
    double to = std::min(end, length);
    if (range.loop)
    {
        from = std::fmod(start, length);
        to = std::min(from + interval, length);
        const double anew = std::min(from + interval - length, length);
        if (anew > to - from)
        {
            from = 0.0;
            to = anew;
        }
    }
    else
        share = std::max(to - from, 0.0) / interval;
    auto tones = bandTones(clip, Seconds(range.from.value + from), Seconds(std::max(to - from, 0.0)));
    for (RumbleTone& tone : tones)
        tone.amplitude *= gain * std::sqrt(share);
    return tones;
}

std::optional<EventPulse> ClipPackets::strongestBetween(double start, double end) const
{
    std::optional<EventPulse> strongest;
    const auto& events = clip.transients;
    const auto isBefore = [](const Transient& event, double time)
    {
        return event.time < time;
    };
    // The passes through the range that the stretch touches; it is longer than two only when packets were left out.
    const double last = range.loop ? std::floor(end / length) : 0.0;
    for (double pass = std::max(last - 1.0, 0.0); pass <= last; ++pass)
    {
        const double origin = range.from.value - pass * length;
        const double from = std::max(start + origin, range.from.value);
        const double to = end + origin;
        for (auto event = std::lower_bound(events.begin(), events.end(), from, isBefore); event != events.end();
             ++event)
        {
            // A loop ends before its end, where it starts anew.
            if (event->time >= to || (range.loop ? event->time >= range.to.value : event->time > range.to.value))
                break;
            const EventPulse pulse = pulseOf(static_cast<std::size_t>(event - events.begin()));
            if (pulse.level > 0.0 && (!strongest || isStronger(pulse, *strongest)))
                strongest = pulse;
        }
    }
    return strongest;
}

EventPulse ClipPackets::pulseOf(std::size_t event) const
{
    const auto& events = clip.transients;
    double gap = std::numeric_limits<double>::infinity();
    if (event > 0)
        gap = events[event].time - events[event - 1].time;
    if (event + 1 < events.size())
        gap = std::min(gap, events[event + 1].time - events[event].time);
    constexpr double fs = 48000.0; // any: only the frequency is used
    const Pulse pulse = makePulse({}, events[event].sharpness, gap, fs, 1.0);
    return {{Hertz(pulse.cyclesPerFrame * fs), gain * pulseLevel(clip.envelope, events[event])},
            gain * events[event].amplitude,
            events[event].sharpness};
}

} // namespace pacini::devices
