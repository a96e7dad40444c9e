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

ControllerModel usualModel(ControllerHaptics haptics, Transport transport) noexcept
{
    ControllerModel model{haptics, transport};
    if (haptics == ControllerHaptics::dualSense && transport == Transport::bluetooth)
        model.samples = DualSenseSamples::report32;
    return model;
}

std::optional<SampleStream> sampleStream(const ControllerModel& model) noexcept
{
    if (model.haptics == ControllerHaptics::steamController)
    {
        const SteamStream stream = steamStream(model.transport);
        return SampleStream{stream.rate, stream.samples};
    }
    if (model.samples != DualSenseSamples::none)
        return dualSenseStream;
    return std::nullopt;
}

RumbleState silentState(const ControllerModel& model) noexcept
{
    if (model.haptics == ControllerHaptics::hdRumble)
        return SidesRumble{};
    if (model.haptics == ControllerHaptics::waveforms)
        return WaveformState{};
    if (sampleStream(model))
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
    case ControllerHaptics::dualSense:
        if (model.samples != DualSenseSamples::none)
            return {.interval = Seconds(static_cast<double>(dualSenseStream.samples) / dualSenseStream.rate),
                    .refresh = Seconds(0.0),
                    .lastSilent = 6};
        break;
    case ControllerHaptics::dualShock4:
        break;
    }
    return {.interval = Seconds(0.010), .refresh = twiceASecond};
}

std::vector<TimedReport> openingReports(const ControllerModel& model)
{
    if (model.haptics == ControllerHaptics::steamController)
        return steamOpening(steamStream(model.transport).format);
    if (model.samples != DualSenseSamples::none) // rumble that was left on would silence them
        return closingReports(model, 0);
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

const MotorCurves& motorCurves(const ControllerModel& model) noexcept
{
    // Eccentric masses; a DualSense's coils follow a likeness of those of a DualShock 4 (reports of users of
    // DS4Windows, #2571, #2572). "The lowest few values" of a DualShock 4 do not start a motor (MissionControl, #181).
    static constexpr MotorCurve sony{8.0 / 255.0, 1.0, 1.5};
    static constexpr MotorCurves ofSony{sony, sony};
    // Others than those of the Xbox 360 start "almost at 0" (PokeMini, #36); the heavy one has more to move.
    static constexpr MotorCurves ofXbox{{0.04, 1.0, 1.5}, {0.02, 1.0, 1.5}};
    // As of old 1 % is felt as nearly all, which no curve helps; SDL sends half of each (SDL_hidapi_ps5.c).
    static constexpr MotorCurves ofOldDualSense{{0.0, 0.5, 1.0}, {0.0, 0.5, 1.0}};
    static constexpr MotorCurves ofCoils{}; // a Steam Deck's follow what they are sent
    if (model.haptics == ControllerHaptics::xbox)
        return ofXbox;
    if (model.haptics == ControllerHaptics::dualSense && model.oldRumble)
        return ofOldDualSense;
    const bool isSony = model.haptics == ControllerHaptics::dualSense || model.haptics == ControllerHaptics::dualShock4;
    return isSony ? ofSony : ofCoils;
}

namespace
{
/// Silence for a state of another kind.
template <typename State>
const State& heldBy(const RumbleState& state) noexcept
{
    static constexpr State silent{};
    const auto* const held = std::get_if<State>(&state);
    return held != nullptr ? *held : silent;
}
} // namespace

Report reportOf(const ControllerModel& model, const RumbleState& state, unsigned counter) noexcept
{
    if (model.haptics == ControllerHaptics::hdRumble)
        return switchRumbleReport(counter, heldBy<SidesRumble>(state));
    if (model.haptics == ControllerHaptics::waveforms)
        return waveformReport(model.trigger, heldBy<WaveformState>(state));
    if (model.haptics == ControllerHaptics::steamController)
        return steamSamplesReport(steamStream(model.transport), heldBy<PcmBlock>(state));
    if (model.samples != DualSenseSamples::none)
        return dualSenseSamplesReport(heldBy<PcmBlock>(state), model.samples, counter);
    const auto& [strong, weak] = motorCurves(model);
    const auto& given = heldBy<MotorLevels>(state);
    const MotorLevels motors{strong.command(given.strong), weak.command(given.weak)};
    if (model.haptics == ControllerHaptics::xbox)
        return xboxBluetoothReport(motors);
    if (model.haptics == ControllerHaptics::steamDeck)
        return steamDeckReport(motors);
    if (model.haptics == ControllerHaptics::dualSense)
        return dualSenseReport(model.transport, motors,
                               model.oldRumble ? DualSenseMode::rumble : DualSenseMode::improvedRumble, counter);
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
        else if (model.samples != DualSenseSamples::none) // rumble silences also the samples that it still holds
            stops[i].report = dualSenseReport(model.transport, {}, DualSenseMode::improvedRumble, i);
        else
            stops[i].report = reportOf(model, silentState(model), i);
    return stops;
}

} // namespace pacini::devices
