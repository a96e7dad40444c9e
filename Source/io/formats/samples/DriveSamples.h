#pragma once

// The drive signal within full scale, for formats that are samples.

#include "io/formats/LossList.h"

#include <vector>

namespace pacini
{

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
