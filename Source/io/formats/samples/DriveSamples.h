#pragma once

// Rendered drive signal of a clip, for formats that are samples.

#include "io/formats/LossList.h"

#include <pacini/actuator/Profile.h>
#include <pacini/actuator/Strength.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>

#include <optional>
#include <vector>

namespace pacini
{

/// The drive signal of the clip at `sampleRate` Hz (2000 to 768000), made for `profile` with `strength` (see
/// fitActuator) when there is one. Errors: those of renderScene().
[[nodiscard]] Result<std::vector<float>> driveSignal(const Clip& clip, double sampleRate,
                                                     const std::optional<Profile>& profile,
                                                     double strength = standardStrength);

/// The drive signal within full scale.
struct DriveSamples
{
    int sampleRate = 0;         ///< Hz
    std::vector<float> samples; ///< -1 to 1
    LossList losses;
};

/// The samples of `clip` at params.sampleRate, or else `usualRate`. Errors: invalidArgument (`sampleRate` outside 2000
/// to 48000 Hz), those of driveSignal().
[[nodiscard]] Result<DriveSamples> driveSamples(const Clip& clip, const ExportParams& params, int usualRate);

} // namespace pacini
