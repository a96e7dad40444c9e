#pragma once

// The output report of Xbox controllers on Bluetooth.

#include "devices/MotorLevels.h"

#include <array>
#include <cstddef>

namespace pacini::devices
{

/// The small motors behind the triggers, levels 0..1 like the others.
struct TriggerLevels
{
    double left = 0.0;
    double right = 0.0;
    bool operator==(const TriggerLevels&) const = default;
};

/// Report 0x03, levels in steps of 1 %: all four motors on, for as long as one report can ask for (2.55 s, repeated
/// 235 times), until the next report. All levels at 0 stop the motors. Source: SDL, SDL_hidapi_xboxone.c. [any]
[[nodiscard]] inline std::array<std::byte, 9> xboxBluetoothReport(const MotorLevels& motors,
                                                                  const TriggerLevels& triggers = {}) noexcept
{
    constexpr int full = 100;
    return {std::byte{0x03},
            std::byte{0x0F}, // which motors
            motorByte(triggers.left, full),
            motorByte(triggers.right, full),
            motorByte(motors.strong, full),
            motorByte(motors.weak, full),
            std::byte{0xFF},  // duration, 10 ms
            std::byte{0x00},  // delay, 10 ms
            std::byte{0xEB}}; // repetitions
}

} // namespace pacini::devices
