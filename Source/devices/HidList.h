#pragma once

// Enumeration of the connected game controllers and other haptic devices.

#include "devices/KnownControllers.h"
#include "devices/WaveformDevice.h"

#include <pacini/foundation/Result.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pacini::devices
{

struct Controller
{
    std::string name; ///< as the controller gives it, UTF-8; may be empty
    ControllerHaptics haptics = ControllerHaptics::hdRumble;
    Transport transport = Transport::unknown;
    std::string path;                          ///< what the system calls it
    std::optional<WaveformDevice> waveforms{}; ///< for ControllerHaptics::waveforms
    std::uint16_t product = 0;                 ///< USB number
};

/// The connected controllers of controllerHaptics() and the devices of waveformDevice(), sorted by path, each once. On
/// Linux, listing needs no right to open them; on other systems only devices that are haptic as a whole are looked
/// into, such as mice, as the system keeps touchpads for itself. Errors: `io` when this was built without hidapi, or
/// the system does not list its devices. [worker]
[[nodiscard]] Result<std::vector<Controller>> connectedControllers();

} // namespace pacini::devices
