#pragma once

// Parameters of sweep analysis.

#include <pacini/foundation/Result.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace pacini
{

/// Parameters of sweep analysis.
struct MeasurementParams
{
    std::vector<double> fullScale = {1.0}; ///< m/s^2 of a sample of 1: one for all channels, or one for each
    double smoothing = 1.0 / 12.0;         ///< octaves over which power is averaged, 0 to 2
    std::size_t points = 240;              ///< of the result, evenly in octaves, 8 to 10000
    double lowFrequency = 1.0;             ///< Hz, first point; not below the sweep's lowest frequency
    double highFrequency = 200000.0;       ///< Hz, last point; not above the sweep's highest frequency
    int harmonics = 5;                     ///< highest order measured, 1 (none) to 9
    double driftWarning = 20.0;            ///< ppm of clock drift above which a warning is given
    double driftLimit = 2000.0;            ///< ppm above which the recording is refused, up to 5000
    double wantedSnr = 10.0;               ///< dB, a warning names where less is reached
    bool equalized = false; ///< the sweep went through an equaliser, so that a flat channel is no sign of a wrong one
    bool operator==(const MeasurementParams&) const = default;
};

/// Checks every number; ErrorCode::invalidArgument with its path, such as `fullScale[1]`. `channels` is the number of
/// channels recorded.
[[nodiscard]] inline Result<void> validate(const MeasurementParams& params, std::size_t channels)
{
    const auto within = [](double value, double low, double high)
    {
        return value >= low && value <= high; // not for NaN
    };
    const auto wrong = [](std::string where, const char* message) -> Result<void>
    {
        return Error{ErrorCode::invalidArgument, std::move(where), message};
    };
    if (params.fullScale.size() != 1 && params.fullScale.size() != channels)
        return wrong("fullScale", "must be one value, or one for each channel");
    for (std::size_t i = 0; i < params.fullScale.size(); ++i)
        if (!within(std::abs(params.fullScale[i]), 1e-6, 1e6))
            return wrong("fullScale[" + std::to_string(i) + "]", "must be 0.000001 to 1000000 m/s^2");
    if (!within(params.smoothing, 0.0, 2.0))
        return wrong("smoothing", "must be 0 to 2 octaves");
    if (params.points < 8 || params.points > 10000)
        return wrong("points", "must be 8 to 10000");
    if (!within(params.lowFrequency, 0.1, 200000.0))
        return wrong("lowFrequency", "must be 0.1 to 200000 Hz");
    if (!within(params.highFrequency, 1.1 * params.lowFrequency, 200000.0))
        return wrong("highFrequency", "must be 1.1 times lowFrequency to 200000 Hz");
    if (params.harmonics < 1 || params.harmonics > 9)
        return wrong("harmonics", "must be 1 to 9");
    if (!within(params.driftWarning, 0.0, 5000.0))
        return wrong("driftWarning", "must be 0 to 5000 ppm");
    if (!within(params.driftLimit, 0.0, 5000.0))
        return wrong("driftLimit", "must be 0 to 5000 ppm");
    if (!within(params.wantedSnr, -100.0, 200.0))
        return wrong("wantedSnr", "must be -100 to 200 dB");
    return {};
}

} // namespace pacini
