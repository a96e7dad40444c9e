#pragma once

// Output reports for the two motors of DualShock 4 and DualSense.

#include "devices/MotorLevels.h"
#include "devices/PcmBlock.h"
#include "devices/Report.h"

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

/// Reports by which a DualSense on Bluetooth is sent samples for its coils. Not tried on a device by us. Sources, whose
/// authors ran theirs: SAxense, punktfunk client, hbashton's DS4Windows (0x32), DS5Dongle (the blocks of all).
enum class DualSenseSamples
{
    none,     ///< levels instead
    report32, ///< the shortest
    report36, ///< longer, with a state block; for links on which the other is said to play nothing
};

/// 3 kHz, both sides: 32 samples in each report, every 10.667 ms. [any]
inline constexpr SampleStream dualSenseStream{3000, 32};

/// Report 0x32 (142 bytes) or 0x36 (398 bytes) with its checksum: a session block, which counts the reports, and a
/// block of signed 8-bit samples, left and right by turns. `form` is not `none`. [any]
[[nodiscard]] Report dualSenseSamplesReport(const PcmBlock& block, DualSenseSamples form, unsigned sequence) noexcept;

} // namespace pacini::devices
