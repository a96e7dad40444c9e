#pragma once

// Conversion of a drive signal that arrives in real time to the states of a controller.

#include "devices/ControllerReports.h"
#include "devices/DriveMeasure.h"
#include "devices/DriveRumble.h"
#include "devices/PacketContent.h"
#include "devices/PacketStates.h"
#include "devices/RumbleSource.h"
#include "live/LiveDrive.h"
#include "live/TrackedDrive.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace pacini::live
{

/// A packet holds whatever has arrived since the one before: no clock is compared with another, nothing drifts, and
/// nothing waits longer than for the next packet. A packet without any news repeats the tones of the last one for
/// LiveRumble::patience, as sound comes block by block. Only what plays samples is sent them at its own pace, by
/// TrackedDrive. Ends when the drive is over.
class LiveRumble : public devices::RumbleSource
{
public:
    static constexpr Seconds patience{0.060};

    /// `arriving` outlives this; `sampleRate` such as DriveRumble::takesRate().
    LiveRumble(LiveDrive& arriving, double sampleRate, const devices::ControllerModel& controller);

    [[nodiscard]] std::optional<devices::RumbleState> at(std::int64_t packet) override;

private:
    [[nodiscard]] std::size_t takeAll();

    LiveDrive& drive;
    double interval; ///< s
    devices::DriveMeasure measure;
    devices::PacketStates states;
    devices::PacketContent held;
    double idle = 0.0; ///< s
    std::int64_t last = -1;
    std::array<float, devices::DriveMeasure::blockFrames> block{};
    std::optional<TrackedDrive> tracked; ///< for samples, with the next
    std::optional<devices::DriveRumble> samples;
};

} // namespace pacini::live
