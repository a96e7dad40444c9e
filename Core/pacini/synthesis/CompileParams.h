#pragma once

// Parameters of the scene compiler.

#include <pacini/synthesis/AdaptationParams.h>
#include <pacini/synthesis/DecoderChoice.h>

namespace pacini
{

/// Parameters of the scene compiler.
struct CompileParams
{
    double tolerance = -60.0;    ///< dB below the scene's energy that may be lost by leaving things out
    bool leaveOut = true;        ///< false plays everything, for comparison
    double sampleRate = 48000.0; ///< Hz, 2000 to 768000, of the players to come; levels of the equaliser depend on it
    DecoderChoice decoder;
    bool adapt = true; ///< fit clips to the actuator; false plays them as they are
    AdaptationParams adaptation;
    bool operator==(const CompileParams&) const = default;
};

} // namespace pacini
