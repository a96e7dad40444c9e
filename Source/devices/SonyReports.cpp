#include "devices/SonyReports.h"

#include "devices/Crc32.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <span>

// Sources for all offsets and flags: Linux, hid-playstation.c; SDL, SDL_hidapi_ps4.c and SDL_hidapi_ps5.c.

namespace pacini::devices
{

namespace
{
// On Bluetooth the header of the transport counts as the first byte of an output report.
constexpr std::byte outputHeader{0xA2};

void sign(std::span<std::byte> report) noexcept
{
    const auto content = report.first(report.size() - 4);
    const std::uint32_t sum = crc32(content, crc32(std::span(&outputHeader, 1)));
    for (std::size_t i = 0; i < 4; ++i)
        report[content.size() + i] = static_cast<std::byte>(sum >> (8 * i) & 0xFF);
}

// The state starts with a mask; three bytes on stand the motors.
void setDualShock4(std::span<std::byte> state, const MotorLevels& motors) noexcept
{
    state[0] = std::byte{0x01}; // rumble is what this report sets
    state[3] = motorByte(motors.weak, 255);
    state[4] = motorByte(motors.strong, 255);
}

void setDualSense(std::span<std::byte> state, const MotorLevels& motors, DualSenseMode mode) noexcept
{
    if (mode == DualSenseMode::audioHaptics)
        return;
    constexpr std::byte insteadOfAudio{0x02};
    constexpr std::byte emulation{0x01};
    state[0] = insteadOfAudio;
    if (mode == DualSenseMode::improvedRumble)
        state[38] = std::byte{0x04};
    else
        state[0] |= emulation;
    state[2] = motorByte(motors.weak, 255);
    state[3] = motorByte(motors.strong, 255);
}
} // namespace

std::array<std::byte, dualShock4UsbSize> dualShock4UsbReport(const MotorLevels& motors) noexcept
{
    std::array<std::byte, dualShock4UsbSize> report{};
    report[0] = std::byte{0x05};
    setDualShock4(std::span(report).subspan(1), motors);
    return report;
}

std::array<std::byte, sonyBluetoothSize> dualShock4BluetoothReport(const MotorLevels& motors, int pollInterval) noexcept
{
    std::array<std::byte, sonyBluetoothSize> report{};
    report[0] = std::byte{0x11};
    report[1] = static_cast<std::byte>(0xC0 | std::clamp(pollInterval, 0, 0x3F)); // HID data, with checksum
    setDualShock4(std::span(report).subspan(3), motors);
    sign(report);
    return report;
}

std::array<std::byte, dualSenseUsbSize> dualSenseUsbReport(const MotorLevels& motors, DualSenseMode mode) noexcept
{
    std::array<std::byte, dualSenseUsbSize> report{};
    report[0] = std::byte{0x02};
    setDualSense(std::span(report).subspan(1), motors, mode);
    return report;
}

std::array<std::byte, sonyBluetoothSize> dualSenseBluetoothReport(const MotorLevels& motors, DualSenseMode mode,
                                                                  unsigned sequence) noexcept
{
    std::array<std::byte, sonyBluetoothSize> report{};
    report[0] = std::byte{0x31};
    report[1] = static_cast<std::byte>((sequence & 0xFu) << 4);
    report[2] = std::byte{0x10}; // what follows is the controller's state
    setDualSense(std::span(report).subspan(3), motors, mode);
    sign(report);
    return report;
}

Report dualSenseSamplesReport(const PcmBlock& block, DualSenseSamples form, unsigned sequence) noexcept
{
    const bool isLong = form == DualSenseSamples::report36;
    std::array<std::byte, Report::largest> bytes{};
    const std::span<std::byte> report = std::span(bytes).first(isLong ? 398 : 142);
    std::size_t at = 0;
    const auto put = [&](std::initializer_list<int> values)
    {
        for (const int value : values)
            report[at++] = static_cast<std::byte>(value);
    };
    put({isLong ? 0x36 : 0x32, static_cast<int>((sequence & 0xFu) << 4)});
    // A session of haptics alone; its last byte counts.
    put({0x91, 7, 0xFE, 0, 0, 0, 0, 0xFF, static_cast<int>(sequence & 0xFFu)});
    if (isLong)
    {
        constexpr int stateBytes = 0x3F;
        put({0x90, stateBytes}); // without flags: nothing is changed
        at += stateBytes;
    }
    put({0x92, static_cast<int>(2 * dualSenseStream.samples)});
    for (std::size_t i = 0; i < dualSenseStream.samples; ++i)
        for (const std::int16_t sample : {block.left[i], block.right[i]})
            report[at++] = static_cast<std::byte>(std::lround(sample * (127.0 / 32767.0)));
    sign(report);
    return Report(report);
}

} // namespace pacini::devices
