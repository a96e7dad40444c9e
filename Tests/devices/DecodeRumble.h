#pragma once

// Decoder of the bytes of HD Rumble, to tell what a controller plays.

#include "devices/HdRumble.h"

#include <cstddef>
#include <optional>

namespace pacini::devices
{

/// What the bytes play, unsafe amplitudes included; nothing when a frequency or an amplitude has no entry in the
/// tables.
inline std::optional<RumbleTones> decodeRumble(const RumbleBytes& bytes) noexcept
{
    const auto at = [&](std::size_t i)
    {
        return std::to_integer<int>(bytes[i]);
    };
    const int highFrequency = (at(1) & 1) << 8 | at(0);
    const int lowFrequency = at(2) & 0x7F;
    if (highFrequency == 0 || highFrequency % 4 != 0 || lowFrequency == 0 || (at(3) & 0xC0) != 0x40)
        return std::nullopt;
    const int low = (at(3) & 0x3F) << 1 | at(2) >> 7;
    return RumbleTones{{rumbleFrequency(highFrequency / 4 + 0x60), rumbleAmplitude(at(1) >> 1)},
                       {rumbleFrequency(lowFrequency + 0x40), rumbleAmplitude(low)}};
}

} // namespace pacini::devices
