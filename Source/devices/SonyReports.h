#pragma once

// Output reports for the two motors of DualShock 4 and DualSense.

#include "devices/MotorLevels.h"

#include <array>
#include <cstddef>

namespace pacini::devices
{

inline constexpr std::size_t dualShock4UsbSize = 32;
inline constexpr std::size_t dualSenseUsbSize = 48;
inline constexpr std::size_t sonyBluetoothSize = 78;

/// Report 0x05: the motors only; the light stays as it is. [any]
[[nodiscard]] std::array<std::byte, dualShock4UsbSize> dualShock4UsbReport(const MotorLevels& motors) noexcept;

/// Report 0x11 with its checksum. `pollInterval` is the time between the controller's own reports in ms, brought into
/// 0..63; Linux uses 4. [any]
[[nodiscard]] std::array<std::byte, sonyBluetoothSize> dualShock4BluetoothReport(const MotorLevels& motors,
                                                                                 int pollInterval = 4) noexcept;

/// Signal source of the DualSense's voice coils, which can only follow one at a time.
enum class DualSenseMode
{
    audioHaptics,   ///< its audio channels 3 and 4; levels are not sent
    rumble,         ///< motors as of old, for every firmware
    improvedRumble, ///< the closer likeness of firmware 2.24 and later
};

/// Report 0x02: the motors only. [any]
[[nodiscard]] std::array<std::byte, dualSenseUsbSize> dualSenseUsbReport(const MotorLevels& motors,
                                                                         DualSenseMode mode) noexcept;

/// Report 0x31 with its checksum; of `sequence`, which counts up by one for each report, the lower four bits are
/// sent. [any]
[[nodiscard]] std::array<std::byte, sonyBluetoothSize>
dualSenseBluetoothReport(const MotorLevels& motors, DualSenseMode mode, unsigned sequence) noexcept;

} // namespace pacini::devices
