#pragma once

// What a packet to a controller holds: tones by which the drive signal is described, and an event that begins in it.

#include "devices/HdRumble.h"

#include <optional>
#include <vector>

namespace pacini::devices
{

struct PacketContent
{
    std::vector<RumbleTone> tones; ///< the event is a part of them
    std::optional<double> event;   ///< its level, 0..1
};

} // namespace pacini::devices
