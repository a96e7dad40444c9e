#pragma once

// Live controls of a play.

#include <pacini/synthesis/Roles.h>

namespace pacini
{

/// The live controls of a play as they were set last.
struct PlayControls
{
    double gain = 1.0, intensity = 1.0, pan = 0.5, delay = 0.0, transposition = 0.0, speed = 1.0;
    PerRole<double> roles{1.0};
    double textureSpeed = 0.0, textureForce = 1.0; ///< of a texture, 0 to 1
};

} // namespace pacini
