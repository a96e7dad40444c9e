#pragma once

// Where the bands of a clip lie.

#include <pacini/foundation/BandSpacing.h>

#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pacini
{

/// One band's frequencies in Hz.
struct BandEdges
{
    double low = 0.0;
    double centre = 0.0;
    double high = 0.0;
    bool operator==(const BandEdges&) const = default;
};

/// `count` bands that tile low..high Hz in equal ratios or widths; the centre is the geometric or arithmetic mean of
/// the edges. Inner edges and centres are rounded to 0.01 Hz, so that they are the same on every machine and read well.
[[nodiscard]] inline std::vector<BandEdges> tiledBands(std::size_t count, double low, double high, BandSpacing spacing)
{
    assert(count > 0 && low > 0.0 && high > low);
    const auto at = [&](double position)
    {
        const double f = onScale(spacing, low, high, position / static_cast<double>(count));
        return std::round(100.0 * f) / 100.0;
    };
    std::vector<BandEdges> bands(count);
    for (std::size_t k = 0; k < count; ++k)
    {
        const auto position = static_cast<double>(k);
        bands[k] = {k == 0 ? low : at(position), at(position + 0.5), k + 1 == count ? high : at(position + 1.0)};
    }
    return bands;
}

} // namespace pacini
