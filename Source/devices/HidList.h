#pragma once

// The game controllers that are connected.

#include "devices/KnownControllers.h"

#include <pacini/foundation/Result.h>

#include <string>
#include <vector>

namespace pacini::devices
{

struct Controller
{
    std::string name; ///< as the controller gives it, UTF-8; may be empty
    ControllerHaptics haptics = ControllerHaptics::hdRumble;
    Transport transport = Transport::unknown;
    std::string path; ///< what the system calls it
};

/// The connected controllers of controllerHaptics(), sorted by path, each once. Listing needs no right to open them.
/// Errors: `io` when this was built without hidapi, or the system does not list its devices. [worker]
[[nodiscard]] Result<std::vector<Controller>> connectedControllers();

} // namespace pacini::devices
