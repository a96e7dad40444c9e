#pragma once

// Band spacing: the scale on which bands are spaced.

#include <cmath>

namespace pacini
{

/// Logarithmic or linear spacing of bands.
enum class BandSpacing
{
    logarithmic, ///< equal ratios
    linear,      ///< equal widths
};

/// The frequency at `position` between low (0) and high (1) on a scale, also beyond the ends; all in one unit.
[[nodiscard]] inline double onScale(BandSpacing spacing, double low, double high, double position) noexcept
{
    if (spacing == BandSpacing::logarithmic)
        return low * std::pow(high / low, position);
    return low + (high - low) * position;
}

} // namespace pacini
