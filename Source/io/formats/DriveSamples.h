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

/// `list` of numbers, `write(x)` each, in lines of `perLine` after four spaces.
template <typename List, typename Write>
[[nodiscard]] std::string numbersInLines(const List& list, std::size_t perLine, Write write)
{
    std::string text;
    std::size_t i = 0;
    for (const auto& value : list)
    {
        text += i == 0 ? "\n    " : i % perLine == 0 ? ",\n    " : ", ";
        text += write(value);
        ++i;
    }
    return text;
}

} // namespace pacini
