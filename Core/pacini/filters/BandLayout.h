#pragma once

// Band layout of a filter bank: centre and crossover frequencies.

#include <pacini/foundation/BandSpacing.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/FixedVector.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pacini
{

inline constexpr std::size_t maxBands = 32;

/// Band layout mode: position of the outer bands at the two ends of the range. The thesis (Weber 2020, section 4.3.1)
/// can be read in all three ways.
enum class BandLayoutKind
{
    centresAtEnds, ///< the first and last centre; crossovers in the middle between centres
    cutoffsAtEnds, ///< the first and last crossover; centres in the middle between crossovers (3 bands and more)
    tiled,         ///< the outer edges of bands of equal width
};

/// Parameters of a band layout. Bands are clamped to 1-32, frequencies to 1 Hz and above, `high` to 0.1 % above `low`
/// and more.
struct BandLayoutParams
{
    std::size_t bands = 6;
    Hertz low{30.0};
    Hertz high{1000.0};
    BandSpacing spacing = BandSpacing::logarithmic;
    BandLayoutKind kind = BandLayoutKind::centresAtEnds;
    bool operator==(const BandLayoutParams&) const = default;
};

/// One centre per band and one crossover between neighbours, both rising.
struct BandLayout
{
    FixedVector<Hertz, maxBands> centres;
    FixedVector<Hertz, maxBands - 1> crossovers;
    BandSpacing spacing = BandSpacing::logarithmic;
    bool operator==(const BandLayout&) const = default;

    [[nodiscard]] std::size_t bands() const noexcept { return centres.size(); }

    /// Returns the start of band k: its lower crossover. The first band has none: it is as wide below its centre as
    /// above (a single band reaches down to half its centre), but does not pass 0.
    [[nodiscard]] Hertz lowerEdge(std::size_t k) const noexcept
    {
        if (k > 0)
            return crossovers[k - 1];
        return crossovers.empty() ? Hertz(centres[0].value / 2.0) : mirrored(crossovers[0], centres[0]);
    }

    /// Returns the end of band k, by the same rule (a single band reaches up to twice its centre).
    [[nodiscard]] Hertz upperEdge(std::size_t k) const noexcept
    {
        if (k < crossovers.size())
            return crossovers[k];
        return crossovers.empty() ? Hertz(centres[k].value * 2.0) : mirrored(crossovers[k - 1], centres[k]);
    }

private:
    [[nodiscard]] Hertz mirrored(Hertz edge, Hertz centre) const noexcept
    {
        if (spacing == BandSpacing::logarithmic)
            return Hertz(centre.value * centre.value / edge.value);
        return Hertz(std::max(0.0, 2.0 * centre.value - edge.value));
    }
};

/// Centres and crossovers for `params`. On the linear scale with cutoffsAtEnds the first centre would often lie below
/// 0 Hz; it is then put at half the first crossover.
[[nodiscard]] inline BandLayout designBandLayout(const BandLayoutParams& params) noexcept
{
    const std::size_t n = clampTo<std::size_t>(params.bands, 1, maxBands);
    const double low = clampTo(params.low.value, 1.0, 1e6);
    const double high = clampTo(params.high.value, low * 1.001, 2e6);
    BandLayout layout;
    layout.spacing = params.spacing;
    const auto at = [&](double position)
    {
        return Hertz(onScale(params.spacing, low, high, position));
    };
    const auto count = static_cast<double>(n);
    if (n == 1)
    {
        layout.centres.pushBack(at(0.5));
        return layout;
    }

    // All three kinds are equal steps; they differ in where the first centre stands and how long a step is.
    double first = 0.0;
    double step = 1.0 / (count - 1.0);
    if (params.kind == BandLayoutKind::tiled)
    {
        step = 1.0 / count;
        first = step / 2.0;
    }
    else if (params.kind == BandLayoutKind::cutoffsAtEnds && n > 2)
    {
        step = 1.0 / (count - 2.0);
        first = -step / 2.0;
    }
    for (std::size_t k = 0; k < n; ++k)
        layout.centres.pushBack(at(first + step * static_cast<double>(k)));
    for (std::size_t k = 0; k + 1 < n; ++k)
        layout.crossovers.pushBack(at(first + step * (static_cast<double>(k) + 0.5)));
    if (params.spacing == BandSpacing::linear)
        layout.centres[0].value = std::max(layout.centres[0].value, layout.crossovers[0].value / 2.0);
    return layout;
}

} // namespace pacini
