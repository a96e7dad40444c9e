#pragma once

// Tick spacing of a time ruler.

#include <pacini/clip/edits/RangeEdits.h>
#include <pacini/foundation/RoundStep.h>

#include <array>
#include <cmath>

namespace pacini
{

/// Between two lines with a time stand this many without.
inline constexpr int partsOfTick = 5;

/// A round number of seconds between two times of a ruler, so that they are at least 90 pixels apart.
[[nodiscard]] inline double tickStep(double secondsPerPixel)
{
    constexpr double leastTickDistance = 90.0; // pixels
    const double least = secondsPerPixel * leastTickDistance;
    constexpr std::array<double, 6> minutes{60.0, 120.0, 300.0, 600.0, 1800.0, 3600.0};
    if (least > 30.0)
    {
        for (double step : minutes)
            if (step >= least)
                return step;
        return 3600.0 * std::ceil(least / 3600.0);
    }
    return RoundStep::from(least).size();
}

/// All lines of a ruler.
[[nodiscard]] inline TimeGrid rulerGrid(double secondsPerPixel)
{
    return {tickStep(secondsPerPixel) / partsOfTick, 0.0, 1.0};
}

} // namespace pacini
