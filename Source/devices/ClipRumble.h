#pragma once

// Conversion of a clip to the states of a controller (HD rumble, motors, waveforms, samples), packet after packet.

#include "devices/ClipDrive.h"
#include "devices/ControllerReports.h"
#include "devices/DriveRumble.h"
#include "devices/RumbleSource.h"

#include <cstdint>
#include <optional>

namespace pacini::devices
{

/// Plays the drive signal of a clip as DriveRumble does, on both sides of a controller.
class ClipRumble : public RumbleSource
{
public:
    /// `profile`: see clipDrive().
    ClipRumble(const Clip& clip, const PlayRange& range, Decibels intensity, const ControllerModel& controller,
               const Profile* profile = nullptr);

    /// After the end come those in which the last sound fades out, then nothing. [worker]
    [[nodiscard]] std::optional<RumbleState> at(std::int64_t packet) override;

private:
    ControllerModel model;
    DriveRumble drive;
    std::optional<std::int64_t> count; ///< packets that hold something; nothing of a loop
};

} // namespace pacini::devices
