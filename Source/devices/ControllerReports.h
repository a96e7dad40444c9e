#pragma once

// Output protocol of each kind of controller or other haptic device: its reports and their timing.

#include "devices/KnownControllers.h"
#include "devices/MotorCurve.h"
#include "devices/MotorLevels.h"
#include "devices/PcmBlock.h"
#include "devices/Report.h"
#include "devices/ReportSink.h"
#include "devices/SonyReports.h"
#include "devices/SteamReports.h"
#include "devices/SwitchReports.h"
#include "devices/WaveformReport.h"

#include <pacini/foundation/Units.h>

#include <optional>
#include <variant>
#include <vector>

namespace pacini::devices
{

/// Kind and connection of a controller, which decide its reports; an unknown connection counts as a cable.
struct ControllerModel
{
    ControllerHaptics haptics = ControllerHaptics::hdRumble;
    Transport transport = Transport::unknown;
    WaveformTrigger trigger{};                         ///< of waveforms: those of the device that is open
    bool oldRumble = false;                            ///< of a DualSense: its firmware is older than 2.24
    DualSenseSamples samples = DualSenseSamples::none; ///< of a DualSense on Bluetooth
    bool operator==(const ControllerModel&) const = default;
};

/// What every door plays on a controller unless it is told otherwise: samples where it takes them. [any]
[[nodiscard]] ControllerModel usualModel(ControllerHaptics haptics, Transport transport) noexcept;

/// The samples that a controller is sent instead of levels; nothing for others. [any]
[[nodiscard]] std::optional<SampleStream> sampleStream(const ControllerModel& model) noexcept;

/// State that a controller plays: SidesRumble for HD rumble, WaveformState for waveforms, PcmBlock where there is a
/// sampleStream(), MotorLevels for the others.
using RumbleState = std::variant<SidesRumble, MotorLevels, WaveformState, PcmBlock>;

/// Whether a state is to be sent even if it is the one that was sent before. [any]
[[nodiscard]] bool beginsAnew(const RumbleState& state) noexcept;

/// The state in which nothing moves. [any]
[[nodiscard]] RumbleState silentState(const ControllerModel& model) noexcept;

/// Timing of the packets to a controller.
struct Pacing
{
    Seconds interval;          ///< from packet to packet, at least
    Seconds refresh;           ///< a state that has not changed is sent again after this time
    Seconds quietAfter{0.300}; ///< silence is repeated for this long, then not sent any more
    int ahead = 0;             ///< packets that are sent before their time, to play from the controller's memory
    int lastSilent = 2;        ///< silent packets after the last one
    bool operator==(const Pacing&) const = default;
};

/// HD rumble: every 15 ms, as a Switch does; the controller stops by itself when it hears nothing for long. Motors keep
/// their level: changes at most every 10 ms (Sony) or 16 ms (Xbox, whose firmware can crash on reports less than 10 ms
/// apart), repeats twice a second, well within the 2.55 s of an Xbox report. None needs anything sent while it is
/// silent. Waveforms: at most every 20 ms, which a pen's radio keeps up with and which is no shorter than most clicks;
/// what lasts is triggered again twice a second, as devices may cut it off after one. Sources: dekuNukem,
/// Nintendo_Switch_Reverse_Engineering; Linux, hid-nintendo.c; xpadneo, rumble throttle; for waveforms ours.
///
/// A DualSense on Bluetooth plays samples as they come, and may repeat the last without some silent ones after them.
/// A Steam Controller plays samples from a memory of unknown size: as many reports as one of the sources sends ahead,
/// 8, or on Bluetooth, where they are eight times as long, 2. Every report is sent, but after silence none until
/// something sounds. Rumble of a Steam Deck may end by itself, as that of the Steam Controller does after 50 ms, for
/// which SDL repeats it every 40 ms. [any]
[[nodiscard]] Pacing pacingOf(const ControllerModel& model) noexcept;

/// A report and the time to wait before the next.
struct TimedReport
{
    Report report;
    Seconds pause;
};

/// The curves by which the levels of MotorLevels become numbers of reports, for a controller that has motors. [any]
[[nodiscard]] const MotorCurves& motorCurves(const ControllerModel& model) noexcept;

/// What must be sent before the first packet. HD rumble has to be enabled. On a cable, a Pro
/// Controller also listens to reports only after a handshake, and for good only after it is told not to fall back to
/// Bluetooth; if a driver has done this already, once more does no harm. A Steam
/// Controller starts to play samples. [worker]
[[nodiscard]] std::vector<TimedReport> openingReports(const ControllerModel& model);

/// What must be sent when something sounds after silence that was not sent: where packets are sent ahead, as many
/// silent ones, so that the next has its time. [worker]
[[nodiscard]] std::vector<TimedReport> resumingReports(const ControllerModel& model);

/// The report of a state, which is the one of the controller's kind. Of `counter`, the number of all reports sent
/// before, some reports hold a part. [any]
[[nodiscard]] Report reportOf(const ControllerModel& model, const RumbleState& state, unsigned counter) noexcept;

/// What is sent after the last silent packet: a DualSense is given back to its audio, a Steam Controller plays no more
/// samples. [worker]
[[nodiscard]] std::vector<TimedReport> closingReports(const ControllerModel& model, unsigned counter);

/// What silences a controller should the program crash. [worker]
[[nodiscard]] StopReports stopReports(const ControllerModel& model) noexcept;

} // namespace pacini::devices
