#pragma once

// Events of a part of a clip, by the packet that starts nearest to each.

#include "devices/ClipDrive.h"

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace pacini::devices
{

/// Asked for one packet after another; events of packets that were left out come in the next.
class ClipEvents
{
public:
    /// `clip` valid, `interval` from packet to packet, above 0.
    ClipEvents(const Clip& clip, const PlayRange& range, Seconds packetInterval)
        : loopLength(range.loop ? range.to.value - range.from.value : 0.0), interval(packetInterval.value)
    {
        for (const Transient& event : clip.transients)
            if (event.amplitude > 0.0 && event.time >= range.from.value && event.time < range.to.value)
                times.push_back(event.time - range.from.value);
    }

    /// Whether an event begins with this packet. [worker]
    [[nodiscard]] bool at(std::int64_t packet) noexcept
    {
        const double from = until;
        until = (static_cast<double>(packet) + 0.5) * interval;
        return firstFrom(from) < until;
    }

private:
    /// The first event that is not before a time of playing; infinite when there is none.
    [[nodiscard]] double firstFrom(double time) const noexcept
    {
        if (times.empty())
            return HUGE_VAL;
        const double pass = loopLength > 0.0 ? std::max(std::floor(time / loopLength), 0.0) * loopLength : 0.0;
        const auto found = std::lower_bound(times.begin(), times.end(), time - pass);
        if (found != times.end())
            return *found + pass;
        return loopLength > 0.0 ? times.front() + pass + loopLength : HUGE_VAL;
    }

    std::vector<double> times; ///< s from the start of the part, rising
    double loopLength;         ///< s, 0: once
    double interval;           ///< s
    double until = 0.0;        ///< s of playing: events before have been told
};

} // namespace pacini::devices
