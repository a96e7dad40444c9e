#pragma once

// Where bands lie and how they fade into each other.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

enum class BandSpacing
{
    logarithmic,
    linear
};

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
        const double u = position / static_cast<double>(count);
        const double f = spacing == BandSpacing::logarithmic ? low * std::pow(high / low, u) : low + (high - low) * u;
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

/// The cross-fades between adjoining bands: raised cosines on log frequency, centred on the edges. At every frequency
/// the weights of all bands and of what lies outside sum to one, so nothing is lost or counted twice.
class BandFades
{
public:
    /// `overlap` is the width of a cross-fade as a share of the narrower of the two bands (0-1].
    BandFades(std::span<const BandEdges> bands, double overlap)
    {
        const auto ratio = [&](std::size_t k)
        {
            return bands[k].high / bands[k].low;
        };
        for (std::size_t e = 0; e <= bands.size(); ++e)
        {
            const double below = ratio(e > 0 ? e - 1 : 0);
            const double above = ratio(e < bands.size() ? e : e - 1);
            fades.push_back({std::log(e < bands.size() ? bands[e].low : bands.back().high),
                             overlap * std::log(std::min(below, above))});
        }
    }

    /// Lowest and highest frequency that bands `first` to `last` (inclusive) react to, Hz.
    [[nodiscard]] double lowestFrequency(std::size_t first) const
    {
        return std::exp(fades[first].edge - 0.5 * fades[first].width);
    }
    [[nodiscard]] double highestFrequency(std::size_t last) const
    {
        return std::exp(fades[last + 1].edge + 0.5 * fades[last + 1].width);
    }

    /// Weight (0-1) of bands `first` to `last` (inclusive) together at `frequency` > 0.
    [[nodiscard]] double weight(std::size_t first, std::size_t last, double frequency) const
    {
        const double logF = std::log(frequency);
        return above(fades[first], logF) - above(fades[last + 1], logF);
    }

private:
    struct Fade
    {
        double edge; // natural logarithm of Hz
        double width;
    };

    static double above(const Fade& fade, double logF)
    {
        const double u = std::clamp((logF - fade.edge) / fade.width, -0.5, 0.5);
        return 0.5 + 0.5 * std::sin(std::numbers::pi * u);
    }

    std::vector<Fade> fades;
};

} // namespace pacini
