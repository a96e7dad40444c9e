#pragma once

// Cross-fades between neighbouring bands of the analysis.

#include <pacini/clip/BandTiling.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

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
