#pragma once

// What a packet to a controller holds: tones by which the drive signal is described, and an event that begins in it.

#include "devices/HdRumble.h"

#include <optional>
#include <vector>

namespace pacini::devices
{

/// An event as a motor or a waveform plays it.
struct EventPulse
{
    double level = 0.0;     ///< 0..1
    double sharpness = 0.0; ///< 0 dull, 1 crisp
};

struct PacketContent
{
    std::vector<RumbleTone> tones; ///< the event is a part of them
    std::optional<EventPulse> event;
};

} // namespace pacini::devices
