#pragma once

// Sinks and sources of a PulseAudio server, or of PipeWire in its place.

#include "live/SoundPort.h"

#include <pacini/foundation/Result.h>

#include <memory>
#include <string>
#include <vector>

namespace pacini::live
{

struct PulseDevice
{
    std::string name; ///< as PULSE_SINK and PULSE_SOURCE take it
    std::string description;
    int channels = 0;
    int card = -1; ///< ALSA's number of it; -1: none
};

/// The sources of the server, monitors too, or its sinks. Errors: io, when libpulse is missing or no server answers
/// within 3 s. [message]
[[nodiscard]] Result<std::vector<PulseDevice>> pulseDevices(bool sources);

/// Opens a sink of four channels at 48 kHz, the last two of which play what is made; the first are silent. Errors: io.
/// [message]
[[nodiscard]] Result<std::unique_ptr<SoundPort>> openPulseSurround(const std::string& sink);

} // namespace pacini::live
