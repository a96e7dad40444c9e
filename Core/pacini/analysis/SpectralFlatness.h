#pragma once

// Spectral flatness: how noise-like a sound is.

#include <pacini/analysis/PowerSpectra.h>
#include <pacini/clip/Curve.h>
#include <pacini/foundation/Units.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace pacini
{

/// The geometric mean of a power spectrum over its arithmetic mean (J. D. Johnston, "Transform coding of audio signals
/// using perceptual noise criteria", IEEE JSAC 6 (1988)): 1 for a flat spectrum, 0 when a bin is empty or for no bins.
[[nodiscard]] inline double flatnessOf(std::span<const double> power) noexcept
{
    double sum = 0.0;
    double logarithms = 0.0;
    for (const double p : power)
    {
        sum += p;
        logarithms += std::log(p); // minus infinity for an empty bin: the result is then 0, as it should be
    }
    if (!(sum > 0.0))
        return 0.0;
    const auto count = static_cast<double>(power.size());
    return std::exp(logarithms / count) / (sum / count);
}

/// Parameters of the spectral flatness.
struct SpectralFlatnessParams
{
    FrameParams frames;
    Hertz low{0.0};                                      ///< bins from here ...
    Hertz high{std::numeric_limits<double>::infinity()}; ///< ... to here count
    bool operator==(const SpectralFlatnessParams&) const = default;
};

/// The flatness (0 to 1) at the middle of every frame over the bins within low..high, without those at 0 Hz and at half
/// the sample rate; fs in Hz. White noise has exp(-0.5772) = 0.561, a sinusoid nearly 0, a click 1 where the window
/// holds nothing else; silence and a range without bins have 0. Empty for an empty signal.
[[nodiscard]] inline Curve spectralFlatness(std::span<const float> signal, double fs,
                                            const SpectralFlatnessParams& params = {})
{
    const FrameGrid grid(params.frames, fs);
    Curve curve(grid.count(signal.size()));
    forEachPowerSpectrum(signal, grid,
                         [&](std::size_t m, std::span<const double> power)
                         {
                             std::size_t first = 1;
                             std::size_t last = power.size() - 1; // exclusive
                             while (first < last && grid.frequency(static_cast<double>(first)) < params.low.value)
                                 ++first;
                             while (last > first && grid.frequency(static_cast<double>(last - 1)) > params.high.value)
                                 --last;
                             const auto part = first < last ? power.subspan(first, last - first) : power.first(0);
                             curve[m] = {grid.time(m), flatnessOf(part)};
                         });
    return curve;
}

} // namespace pacini
