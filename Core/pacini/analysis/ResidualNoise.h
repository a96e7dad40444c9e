#pragma once

// Residual noise analysis: the part of a sound without the sinusoids of its clip, as noise levels in a few bands.

#include <pacini/analysis/PowerSpectra.h>
#include <pacini/clip/Clip.h>
#include <pacini/filters/BandLayout.h>
#include <pacini/foundation/DspBlock.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Parameters of the residual noise analysis.
struct ResidualNoiseParams
{
    BandLayoutParams layout;
    FrameParams frames;
    bool operator==(const ResidualNoiseParams&) const = default;
};

namespace detail
{

/// Returns the share of bin k, as the range half a bin to either side, that lies between `low` and `high` Hz (0 to 1).
inline double shareOfBin(const FrameGrid& grid, std::size_t k, double low, double high) noexcept
{
    const double from = grid.frequency(static_cast<double>(k) - 0.5);
    const double to = grid.frequency(static_cast<double>(k) + 0.5);
    return std::max(0.0, std::min(to, high) - std::max(from, low)) / (to - from);
}

} // namespace detail

/// For every band of the layout the RMS level, at the middle of every frame, of signal - modelled: the residual of
/// sinusoidal modelling (X. Serra and J. Smith, "Spectral modeling synthesis", Computer Music Journal 14 (1990)), kept
/// as band levels because skin does not feel more of noise. Both signals have the rate fs (Hz) and the same length (a
/// broken precondition; the shorter length counts). By Parseval's theorem the levels of bands that cover the whole
/// spectrum add up in power to the windowed mean square of the difference.
[[nodiscard]] inline std::vector<NoiseBand> residualNoise(std::span<const float> signal,
                                                          std::span<const float> modelled, double fs,
                                                          const ResidualNoiseParams& params = {})
{
    assert(signal.size() == modelled.size());
    std::vector<float> difference(std::min(signal.size(), modelled.size()));
    for (std::size_t i = 0; i < difference.size(); ++i)
        difference[i] = toSample(finiteOrZero(signal[i]) - finiteOrZero(modelled[i]));

    const BandLayout layout = designBandLayout(params.layout);
    const FrameGrid grid(params.frames, fs);
    std::vector<NoiseBand> bands(layout.bands());
    for (std::size_t b = 0; b < bands.size(); ++b)
    {
        bands[b].lowFrequency = layout.lowerEdge(b).value;
        bands[b].highFrequency = layout.upperEdge(b).value;
        bands[b].amplitude.reserve(grid.count(difference.size()));
    }

    // Both halves of the spectrum over window times the sum of the squared Hann window, 3/8 window.
    const auto window = static_cast<double>(grid.window);
    const double meanSquarePerPower = 2.0 / (window * window * 3.0 / 8.0);
    forEachPowerSpectrum(difference, grid,
                         [&](std::size_t m, std::span<const double> power)
                         {
                             for (NoiseBand& band : bands)
                             {
                                 double sum = 0.0;
                                 for (std::size_t k = 0; k < power.size(); ++k)
                                     sum +=
                                         power[k] * detail::shareOfBin(grid, k, band.lowFrequency, band.highFrequency);
                                 band.amplitude.push_back({grid.time(m), std::sqrt(sum * meanSquarePerPower)});
                             }
                         });
    return bands;
}

} // namespace pacini
