#pragma once

// HID devices with built-in waveforms: the waveforms that a device lists, and the choice of those that play a clip.

#include "devices/HidDescriptor.h"
#include "devices/WaveformReport.h"

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace pacini::devices
{

/// A number that the device tells by a feature report.
struct ToldNumber
{
    HidField field;
    std::size_t bytes = 0; ///< of its report, with the report's number
};

/// One entry of a device's list of waveforms.
struct ListedWaveform
{
    std::uint16_t ordinal = 0;          ///< 3 or above
    ToldNumber usage;                   ///< which waveform it is, as a number of the haptic page
    std::optional<ToldNumber> duration; ///< ms
};

/// A haptic device as its descriptor tells it.
struct WaveformDevice
{
    WaveformTrigger trigger; ///< no waveform is chosen yet
    std::vector<ListedWaveform> listed;
};

/// The simple haptic controller in a report descriptor: an output report by which waveforms are triggered, and the
/// feature reports by which their list can be asked for. Nothing when there is none that can be played on, such as a
/// touchpad that only lets its own clicks be made stronger. Errors: those of parseHidDescriptor(). Sources: USB-IF, HID
/// Usage Tables 1.3, 17; Microsoft, Input Device Haptics Implementation Guide. [any]
[[nodiscard]] Result<std::optional<WaveformDevice>> waveformDevice(std::span<const std::byte> descriptor);

/// Asks a device for the feature report of a number: its bytes, the number first.
using FeatureReader = std::function<Result<std::vector<std::byte>>(std::uint8_t report, std::size_t bytes)>;

/// The trigger with waveforms chosen from those that the device lists. The rule is ours: an event is a click, or else a
/// press, or else a hover, or else the first listed waveform that ends by itself; without any, an event is a short
/// piece of a lasting waveform. What lasts is a buzz and a rumble, or one of them for both; if a duration above 0 is
/// listed for it, it must be triggered again after that. Other waveforms that do not end, such as those of ink, are not
/// played. Only what the descriptor leaves open is asked for; a duration that the device does not tell counts as 0.
/// Errors: `io`: the device does not tell its waveforms, or none of them can be played. [worker]
[[nodiscard]] Result<WaveformTrigger> chosenWaveforms(const WaveformDevice& device, const FeatureReader& read);

/// A made-up haptic device: an event, a buzz and a rumble, intensities in hundredths. For lists of what would be sent.
[[nodiscard]] constexpr WaveformTrigger standardTrigger() noexcept
{
    return {.report = 1,
            .bytes = 6,
            .waveform = {.bit = 0, .bits = 8, .least = 1, .most = 5},
            .intensity = {.bit = 8, .bits = 8, .least = 0, .most = 100},
            .repeats = {.bit = 16, .bits = 8, .least = 0, .most = 255},
            .period = {.bit = 24, .bits = 16, .least = 0, .most = 1000},
            .cutoff = {},
            .event = 3,
            .buzz = 4,
            .rumble = 5,
            .eventTime = Seconds(0.020),
            .buzzTime = {},
            .rumbleTime = {}};
}

} // namespace pacini::devices
