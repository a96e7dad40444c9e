#pragma once

// Features of one moment of sound for onset detection: its short-time powers.

#include <array>
#include <cstddef>

namespace pacini
{

/// Short-time powers (mean squares) of one 900th of a second, averaged over the channels, so that channels never
/// cancel.
///
/// The bands are octaves below 1800 Hz and two wide bands above: up to 112, 225, 450, 900, 1800 and about 3600 Hz, and
/// all above. They overlap (12 dB per octave near the edges); only their changes matter here. For a steady tone of any
/// frequency from 12 Hz up their sum is steady too, within 1.5 dB of its mean: no half wave shows as an event.
struct OnsetFrame
{
    static constexpr double rate = 900.0; ///< frames per second, at every sample rate
    static constexpr std::size_t bandCount = 7;
    /// Centre of each band, Hz: the geometric mean of its edges.
    static constexpr std::array<double, bandCount> bandCentres{56.0, 159.0, 318.0, 636.0, 1273.0, 2546.0, 6600.0};

    float power = 0.0f;                       ///< of the full band, without its mean (DC)
    float lowPower = 0.0f;                    ///< of the part below 1800 Hz, without DC
    std::array<float, bandCount + 1> bands{}; ///< lowest first, then the sum of all
    bool operator==(const OnsetFrame&) const = default;
};

} // namespace pacini
