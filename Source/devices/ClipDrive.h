#pragma once

// Drive signal of a part of a clip, as `pacini render` makes it, for whatever plays it on a controller or a phone.

#include "devices/DriveRumble.h"

#include <pacini/actuator/Profile.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/Units.h>

namespace pacini::devices
{

/// A part of a clip, once or over and over. from < to, both within the clip.
struct PlayRange
{
    Seconds from;
    Seconds to;
    bool loop = false;
};

/// One channel of the drive signal of a valid clip, at a sample rate in Hz; silence after its end. `profile`: the
/// actuator that it is made for, which is no motor; null: the drive as it is. [worker]
[[nodiscard]] DriveRenderer clipDrive(const Clip& clip, const PlayRange& range, Decibels gain, double sampleRate,
                                      const Profile* profile = nullptr);

} // namespace pacini::devices
