#pragma once

// Conversion of a clip to the states of a controller (HD rumble, motors, waveforms, samples), packet after packet.

#include "devices/ClipPackets.h"
#include "devices/ControllerReports.h"
#include "devices/DriveRumble.h"
#include "devices/PacketStates.h"
#include "devices/RumbleSource.h"

#include <cstdint>
#include <optional>

namespace pacini::devices
{

/// Converter of a clip to states of a controller, asked for one packet after another. A controller that plays samples
/// gets the drive signal, on both sides.
class ClipRumble : public RumbleSource
{
public:
    ClipRumble(Clip clip, const PlayRange& range, Decibels intensity, const ControllerModel& controller);

    /// After the end come those in which the last sound fades out, then nothing. [worker]
    [[nodiscard]] std::optional<RumbleState> at(std::int64_t packet) override;

private:
    ControllerModel model;
    ClipPackets packets;
    PacketStates states;
    std::optional<DriveRumble> drive; ///< for samples
};

} // namespace pacini::devices
