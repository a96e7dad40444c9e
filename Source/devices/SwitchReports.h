#pragma once

// The output reports that carry HD rumble to a Joy-Con or a Pro Controller.

#include "devices/HdRumble.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace pacini::devices
{

/// HD rumble of both sides. A single Joy-Con listens to its own.
struct SidesRumble
{
    RumbleBytes left = neutralRumble;
    RumbleBytes right = neutralRumble;
    bool operator==(const SidesRumble&) const = default;
};

/// Report 0x10, rumble only. Of `counter`, which counts up by one for each report of either kind, the lower four bits
/// are sent. Linux sends one at most every 50 ms, SDL every 30 ms; SDL adds zeros up to 49 bytes on Bluetooth and 64 on
/// a cable. Source: dekuNukem, Nintendo_Switch_Reverse_Engineering, bluetooth_hid_notes.md. [any]
[[nodiscard]] inline std::array<std::byte, 10> switchRumbleReport(unsigned counter, const SidesRumble& rumble) noexcept
{
    const auto& [left, right] = rumble;
    return {std::byte{0x10}, static_cast<std::byte>(counter & 0xFu),
            left[0],         left[1],
            left[2],         left[3],
            right[0],        right[1],
            right[2],        right[3]};
}

/// Report 0x01, which carries a subcommand besides: 0x48 turns rumble on or off. To be sent once before the first
/// rumble. Source: as above, bluetooth_hid_subcommands_notes.md. [any]
[[nodiscard]] inline std::array<std::byte, 12> switchEnableRumbleReport(unsigned counter, bool enabled,
                                                                        const SidesRumble& rumble = {}) noexcept
{
    std::array<std::byte, 12> report{};
    const auto rumbleOnly = switchRumbleReport(counter, rumble);
    std::copy(rumbleOnly.begin(), rumbleOnly.end(), report.begin());
    report[0] = std::byte{0x01};
    report[10] = std::byte{0x48};
    report[11] = enabled ? std::byte{0x01} : std::byte{0x00};
    return report;
}

} // namespace pacini::devices
