#pragma once

// CRC-32, the checksum at the end of Bluetooth reports.

#include <cstddef>
#include <cstdint>
#include <span>

namespace pacini::devices
{

/// CRC-32 of ISO-HDLC (Ethernet, zip): reflected polynomial 0xEDB88320, start and final value all ones. Bit by bit:
/// 80 bytes per report do not need a table. `before` is the checksum of what came before, 0 at the start.
[[nodiscard]] constexpr std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0) noexcept
{
    std::uint32_t state = ~before;
    for (const std::byte byte : bytes)
    {
        state ^= std::to_integer<std::uint32_t>(byte);
        for (int bit = 0; bit < 8; ++bit)
            state = (state >> 1) ^ ((state & 1u) != 0 ? 0xEDB88320u : 0u);
    }
    return ~state;
}

} // namespace pacini::devices
