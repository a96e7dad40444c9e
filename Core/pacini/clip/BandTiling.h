#pragma once

// Band tiling: edges and centres of the bands of a clip, which adjoin each other.

#include <pacini/clip/Clip.h>
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

namespace detail
{
/// Whether bands can tile the range between two frequencies, Hz.
inline bool canTile(double low, double high)
{
    return low > 0.0 && high > low && high <= limits::frequency;
}

/// Puts bands on as many edges.
inline void setFrequencies(std::vector<Band>& bands, const std::vector<BandEdges>& edges)
{
    for (std::size_t k = 0; k < bands.size(); ++k)
    {
        bands[k].lowFrequency = edges[k].low;
        bands[k].centreFrequency = edges[k].centre;
        bands[k].highFrequency = edges[k].high;
    }
}

/// Whether bands lie as tiledBands() would put them.
inline bool isTiled(const std::vector<Band>& bands, BandSpacing spacing)
{
    const double low = bands.front().lowFrequency;
    const double high = bands.back().highFrequency;
    if (!canTile(low, high))
        return false;
    std::vector<Band> tiled = bands;
    setFrequencies(tiled, tiledBands(bands.size(), low, high, spacing));
    return tiled == bands;
}
} // namespace detail

} // namespace pacini
