#pragma once

// Spectral centroid: the centre of gravity of the power spectrum, frame by frame.

#include <pacini/analysis/PowerSpectra.h>
#include <pacini/clip/Curve.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace pacini
{

/// Parameters of the spectral centroid.
struct SpectralCentroidParams
{
    FrameParams frames;
    Hertz low{0.0};                                      ///< bins from here ...
    Hertz high{std::numeric_limits<double>::infinity()}; ///< ... to here count
    Decibels floor{-90.0}; ///< frames with less energy than this below the strongest have no centroid of their own
    bool operator==(const SpectralCentroidParams&) const = default;
};

/// The centroid in Hz at the middle of every frame; fs in Hz. Weber 2020, Eq. 4.8: sum k |X(k)|^2 / sum |X(k)|^2 over
/// the bins from 0 Hz to below half the sample rate (here also limited to low..high), times fs / window. Frames without
/// energy repeat the last value, at the start the first; a signal without energy has 0 Hz throughout, an empty one an
/// empty curve.
/// The same formula on one band of a filter bank, with twice the window, is that band's pitch.
[[nodiscard]] inline Curve spectralCentroid(std::span<const float> signal, double fs,
                                            const SpectralCentroidParams& params = {})
{
    const FrameGrid grid(params.frames, fs);
    Curve curve(grid.count(signal.size()));
    std::vector<double> energies(curve.size());
    forEachPowerSpectrum(signal, grid,
                         [&](std::size_t m, std::span<const double> power)
                         {
                             double energy = 0.0;
                             double moment = 0.0;
                             for (std::size_t k = 0; k + 1 < power.size(); ++k)
                             {
                                 const double f = grid.frequency(static_cast<double>(k));
                                 if (f < params.low.value || f > params.high.value)
                                     continue;
                                 energy += power[k];
                                 moment += power[k] * f;
                             }
                             energies[m] = energy;
                             curve[m] = {grid.time(m), energy > 0.0 ? moment / energy : 0.0};
                         });
    if (curve.empty())
        return curve;

    const double ratio = params.floor.gain();
    const double enough = std::max(*std::max_element(energies.begin(), energies.end()) * ratio * ratio, 1e-30);
    const auto first = std::find_if(energies.begin(), energies.end(), [enough](double e) { return e > enough; });
    double last = first == energies.end() ? 0.0 : curve[static_cast<std::size_t>(first - energies.begin())].value;
    for (std::size_t m = 0; m < curve.size(); ++m)
    {
        if (energies[m] > enough)
            last = curve[m].value;
        curve[m].value = last;
    }
    return curve;
}

} // namespace pacini
