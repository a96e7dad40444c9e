#pragma once

// What simulated rigs need: an actuator with a body model, and a drive for it.

#include "cli/Console.h"
#include "io/AudioFile.h"

#include <pacini/actuator/Profile.h>

#include <optional>
#include <string>

namespace pacini::cli
{

struct RigInput
{
    Profile actuator; ///< has a body, and is no motor
    AudioData drive;  ///< of one channel
};

/// Opens both. Prints warnings and errors on the console; returns none after an error.
[[nodiscard]] std::optional<RigInput> openRig(Console& console, const std::string& profile, const std::string& drive);

} // namespace pacini::cli
