#pragma once

// G.711 mu-law: 16-bit samples in 8 bits.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace pacini::devices
{

/// The code of a sample; 0 becomes FF. Eight segments whose steps double; full scale is reached at 32635, beyond which
/// samples are cut. Source: ITU-T G.711, table 2a, for 14 bits, of which 16-bit samples have two more. [any]
[[nodiscard]] constexpr std::byte muLawByte(std::int16_t sample) noexcept
{
    constexpr int bias = 132; // 33 of 14 bits: moves the segments to powers of two
    constexpr int clip = 32635;
    const int value = sample;
    const auto magnitude = static_cast<unsigned>(std::min(value < 0 ? -value : value, clip) + bias);
    const auto segment = static_cast<unsigned>(std::bit_width(magnitude)) - 8u;
    const unsigned step = magnitude >> (segment + 3u) & 0xFu;
    const unsigned sign = value < 0 ? 0x80u : 0u;
    return static_cast<std::byte>(~(sign | segment << 4u | step) & 0xFFu);
}

} // namespace pacini::devices
