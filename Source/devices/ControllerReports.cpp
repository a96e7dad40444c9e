#include "devices/ControllerReports.h"

#include "devices/SonyReports.h"
#include "devices/XboxReport.h"

namespace pacini::devices
{

namespace
{
Report dualSenseReport(Transport transport, const MotorLevels& motors, DualSenseMode mode, unsigned counter) noexcept
{
    if (transport == Transport::bluetooth)
        return dualSenseBluetoothReport(motors, mode, counter);
    return dualSenseUsbReport(motors, mode);
}
} // namespace

RumbleState silentState(ControllerHaptics haptics) noexcept
{
    if (haptics == ControllerHaptics::hdRumble)
        return SidesRumble{};
    if (haptics == ControllerHaptics::waveforms)
        return WaveformState{};
    return MotorLevels{};
}

bool beginsAnew(const RumbleState& state) noexcept
{
    const auto* waveform = std::get_if<WaveformState>(&state);
    return waveform != nullptr && waveform->begins;
}

Pacing pacingOf(ControllerHaptics haptics) noexcept
{
    constexpr Seconds twiceASecond(0.5);
    switch (haptics)
    {
    case ControllerHaptics::hdRumble:
        return {.interval = Seconds(0.015), .refresh = Seconds(0.015)};
    case ControllerHaptics::xbox:
        return {.interval = Seconds(0.016), .refresh = twiceASecond};
    case ControllerHaptics::waveforms:
        return {.interval = Seconds(0.020), .refresh = twiceASecond};
    case ControllerHaptics::dualShock4:
    case ControllerHaptics::dualSense:
        break;
    }
    return {.interval = Seconds(0.010), .refresh = twiceASecond};
}

std::vector<Report> openingReports(const ControllerModel& model)
{
    if (model.haptics != ControllerHaptics::hdRumble)
        return {};
    std::vector<Report> reports;
    if (model.transport != Transport::bluetooth)
    {
        // Source: dekuNukem, Nintendo_Switch_Reverse_Engineering, USB-HID-Notes.md.
        reports.emplace_back(std::array{std::byte{0x80}, std::byte{0x02}}); // handshake
        reports.emplace_back(std::array{std::byte{0x80}, std::byte{0x04}}); // stay on the cable
    }
    reports.emplace_back(switchEnableRumbleReport(static_cast<unsigned>(reports.size()), true));
    return reports;
}

Report reportOf(const ControllerModel& model, const RumbleState& state, unsigned counter) noexcept
{
    const auto* sides = std::get_if<SidesRumble>(&state);
    if (model.haptics == ControllerHaptics::hdRumble)
        return switchRumbleReport(counter, sides != nullptr ? *sides : SidesRumble{});
    const auto* waveform = std::get_if<WaveformState>(&state);
    if (model.haptics == ControllerHaptics::waveforms)
        return waveformReport(model.trigger, waveform != nullptr ? *waveform : WaveformState{});
    const auto* given = std::get_if<MotorLevels>(&state);
    const MotorLevels motors = given != nullptr ? *given : MotorLevels{};
    if (model.haptics == ControllerHaptics::xbox)
        return xboxBluetoothReport(motors);
    if (model.haptics == ControllerHaptics::dualSense)
        return dualSenseReport(model.transport, motors, DualSenseMode::rumble, counter);
    if (model.transport == Transport::bluetooth)
        return dualShock4BluetoothReport(motors);
    return dualShock4UsbReport(motors);
}

std::vector<Report> closingReports(const ControllerModel& model, unsigned counter)
{
    if (model.haptics != ControllerHaptics::dualSense)
        return {};
    return {dualSenseReport(model.transport, {}, DualSenseMode::audioHaptics, counter)};
}

} // namespace pacini::devices
