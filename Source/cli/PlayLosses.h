#pragma once

// What a controller cannot show of a clip.

#include "devices/ClipDrive.h"
#include "devices/ControllerReports.h"
#include "io/formats/ClipFormat.h"

#include <pacini/clip/Clip.h>

#include <vector>

namespace pacini::cli
{

/// Losses of a part of a valid clip on a controller, in the words of `pacini lint`, by time from the start of the clip:
/// the drive signal is measured as it is for playing, packet after packet, and compared with what the packets say. The
/// frequency of a motor is taken as Linux takes it, 160 Hz for the heavy and 320 Hz for the light one. [worker]
[[nodiscard]] std::vector<FormatLoss> playLosses(const Clip& clip, const devices::PlayRange& range, Decibels gain,
                                                 const devices::ControllerModel& model,
                                                 const Profile* profile = nullptr);

} // namespace pacini::cli
