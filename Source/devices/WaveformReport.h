#pragma once

// Output report that plays a built-in waveform of a haptic device of HID usage page 0x0E.

#include "devices/Report.h"

#include <pacini/foundation/Units.h>

#include <cstdint>

namespace pacini::devices
{

/// Position and range of a number in a report; 0 bits if it is absent.
struct ReportField
{
    std::uint16_t bit = 0; ///< from the lowest bit of the byte after the report's number on
    std::uint8_t bits = 0; ///< 0..32
    std::int32_t least = 0;
    std::int32_t most = 0;
    bool operator==(const ReportField&) const = default;
};

/// Layout of the report that triggers waveforms, and the ordinals of those that are played, 0 for none. The device
/// repeats a waveform with a duration of 0 s until it is stopped.
struct WaveformTrigger
{
    std::uint8_t report = 0; ///< its number
    std::uint8_t bytes = 0;  ///< with the number; at most Report::largest
    ReportField waveform;    ///< an ordinal
    ReportField intensity;   ///< not every device has one: others play at full strength
    ReportField repeats;     ///< after the first
    ReportField period;      ///< ms between repeats
    ReportField cutoff;      ///< ms after which any waveform ends

    std::uint16_t event = 0;
    std::uint16_t buzz = 0;
    std::uint16_t rumble = 0;
    Seconds eventTime;
    Seconds buzzTime;
    Seconds rumbleTime;

    /// Whether it can play more than events.
    [[nodiscard]] constexpr bool lasts() const noexcept { return buzz != 0 || rumble != 0; }

    bool operator==(const WaveformTrigger&) const = default;
};

/// Ordinals that every device has. Source: USB-IF, HID Usage Tables 1.3, 17.
inline constexpr std::uint16_t ordinalNone = 1;
inline constexpr std::uint16_t ordinalStop = 2;

/// Kinds of waveforms that a device plays.
enum class Waveform
{
    stop,
    event,
    buzz,
    rumble,
};

struct WaveformState
{
    Waveform waveform = Waveform::stop;
    double intensity = 0.0; ///< 0..1; what lies outside is brought into the range, NaN to 0
    bool begins = false;    ///< it is triggered anew, even if it is what was played before
    bool operator==(const WaveformState&) const = default;
};

/// The report that triggers a state, once. Intensities are rounded to the device's steps; one that comes out at 0 stops
/// it, but an event above 0 is not rounded away. A waveform that the device has not stops it too. [any]
[[nodiscard]] Report waveformReport(const WaveformTrigger& trigger, const WaveformState& state) noexcept;

} // namespace pacini::devices
