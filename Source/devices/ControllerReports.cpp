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

constexpr std::array bothPairs{SteamPair::grips, SteamPair::trackpads};

std::vector<TimedReport> steamOpening(std::uint8_t format)
{
    std::vector<TimedReport> reports;
    for (const SteamPair pair : bothPairs)
        reports.push_back({steamSwitchReport(SteamSwitch::off, pair, 0), Seconds(0.0)});
    reports.back().pause = Seconds(0.010);
    for (const SteamPair pair : bothPairs)
        reports.push_back({steamSwitchReport(SteamSwitch::on, pair, format), Seconds(0.0)});
    return reports;
}

std::vector<TimedReport> steamClosing(std::uint8_t format)
{
    std::vector<TimedReport> reports;
    for (const std::uint8_t each : {format, std::uint8_t{0}})
        for (const SteamPair pair : bothPairs)
            reports.push_back({steamSwitchReport(SteamSwitch::off, pair, each), Seconds(0.0)});
    reports[1].pause = Seconds(0.150);
    return reports;
}
} // namespace

RumbleState silentState(ControllerHaptics haptics) noexcept
{
    if (haptics == ControllerHaptics::hdRumble)
        return SidesRumble{};
    if (haptics == ControllerHaptics::waveforms)
        return WaveformState{};
    if (haptics == ControllerHaptics::steamController)
        return PcmBlock{};
    return MotorLevels{};
}

bool beginsAnew(const RumbleState& state) noexcept
{
    const auto* waveform = std::get_if<WaveformState>(&state);
    return waveform != nullptr && waveform->begins;
}

Pacing pacingOf(const ControllerModel& model) noexcept
{
    constexpr Seconds twiceASecond(0.5);
    switch (model.haptics)
    {
    case ControllerHaptics::hdRumble:
        return {.interval = Seconds(0.015), .refresh = Seconds(0.015)};
    case ControllerHaptics::xbox:
        return {.interval = Seconds(0.016), .refresh = twiceASecond};
    case ControllerHaptics::waveforms:
        return {.interval = Seconds(0.020), .refresh = twiceASecond};
    case ControllerHaptics::steamController:
    {
        const SteamStream stream = steamStream(model.transport);
        return {.interval = Seconds(static_cast<double>(stream.samples) / stream.rate),
                .refresh = Seconds(0.0),
                .ahead = stream.rate > 1000 ? 8 : 2};
    }
    case ControllerHaptics::steamDeck:
        return {.interval = Seconds(0.010), .refresh = Seconds(0.040)};
    case ControllerHaptics::dualShock4:
    case ControllerHaptics::dualSense:
        break;
    }
    return {.interval = Seconds(0.010), .refresh = twiceASecond};
}

std::vector<TimedReport> openingReports(const ControllerModel& model)
{
    if (model.haptics == ControllerHaptics::steamController)
        return steamOpening(steamStream(model.transport).format);
    if (model.haptics != ControllerHaptics::hdRumble)
        return {};
    const Seconds pause = pacingOf(model).interval;
    std::vector<TimedReport> reports;
    if (model.transport != Transport::bluetooth)
    {
        // Source: dekuNukem, Nintendo_Switch_Reverse_Engineering, USB-HID-Notes.md.
        reports.push_back({std::array{std::byte{0x80}, std::byte{0x02}}, pause}); // handshake
        reports.push_back({std::array{std::byte{0x80}, std::byte{0x04}}, pause}); // stay on the cable
    }
    reports.push_back({switchEnableRumbleReport(static_cast<unsigned>(reports.size()), true), pause});
    return reports;
}

std::vector<TimedReport> resumingReports(const ControllerModel& model)
{
    if (model.haptics != ControllerHaptics::steamController)
        return {};
    // It may have ended by itself, having had nothing to play.
    std::vector<TimedReport> reports;
    for (const SteamPair pair : bothPairs)
        reports.push_back({steamSwitchReport(SteamSwitch::on, pair, steamStream(model.transport).format), {}});
    for (int i = 0; i < pacingOf(model).ahead; ++i)
        reports.push_back({reportOf(model, PcmBlock{}, 0), {}});
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
    const auto* samples = std::get_if<PcmBlock>(&state);
    if (model.haptics == ControllerHaptics::steamController)
        return steamSamplesReport(steamStream(model.transport), samples != nullptr ? *samples : PcmBlock{});
    const auto* given = std::get_if<MotorLevels>(&state);
    const MotorLevels motors = given != nullptr ? *given : MotorLevels{};
    if (model.haptics == ControllerHaptics::xbox)
        return xboxBluetoothReport(motors);
    if (model.haptics == ControllerHaptics::steamDeck)
        return steamDeckReport(motors);
    if (model.haptics == ControllerHaptics::dualSense)
    {
        if (!model.oldRumble)
            return dualSenseReport(model.transport, motors, DualSenseMode::improvedRumble, counter);
        // As of old the motors are much stronger: half of each is about as strong. Source: SDL, SDL_hidapi_ps5.c.
        return dualSenseReport(model.transport, {0.5 * motors.strong, 0.5 * motors.weak}, DualSenseMode::rumble,
                               counter);
    }
    if (model.transport == Transport::bluetooth)
        return dualShock4BluetoothReport(motors);
    return dualShock4UsbReport(motors);
}

std::vector<TimedReport> closingReports(const ControllerModel& model, unsigned counter)
{
    if (model.haptics == ControllerHaptics::steamController)
        return steamClosing(steamStream(model.transport).format);
    if (model.haptics != ControllerHaptics::dualSense)
        return {};
    return {{dualSenseReport(model.transport, {}, DualSenseMode::audioHaptics, counter), Seconds(0.0)}};
}

StopReports stopReports(const ControllerModel& model) noexcept
{
    StopReports stops;
    const std::uint8_t format = steamStream(model.transport).format;
    for (unsigned i = 0; i < stops.size(); ++i)
        if (model.haptics == ControllerHaptics::steamController)
            stops[i] = {steamSwitchReport(SteamSwitch::off, SteamPair::grips, format),
                        steamSwitchReport(SteamSwitch::off, SteamPair::trackpads, format)};
        else
            stops[i].report = reportOf(model, silentState(model.haptics), i);
    return stops;
}

} // namespace pacini::devices
