#pragma once

// Group delay of a measured impulse response.

#include <pacini/foundation/Fft.h>
#include <pacini/foundation/SplitRealFft.h>
#include <pacini/linearize/ResponseSmoothing.h>
#include <pacini/linearize/SweepMeasurement.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// The group delay, s, at each of `frequency` (Hz, above 0) after the lag `zero`, s: the mean over `smoothing` octaves
/// of Re(D / H) = Re(D H*) / |H|^2 with D the spectrum of n h(n) (J. O. Smith, "Introduction to digital filters", 2007,
/// "Numerical computation of group delay"), weighted by |H|^2. No phase is unwrapped, and notches, where phase says
/// nothing, hardly count. 0 where there is no response.
[[nodiscard]] inline std::vector<double> groupDelay(const ImpulseResponse& response, double zero,
                                                    std::span<const double> frequency, double smoothing)
{
    assert(response.sampleRate > 0.0 && !response.samples.empty());
    const std::size_t count = response.samples.size();
    SplitRealFft<double> fft(nextFastFftSize(std::max<std::size_t>(16, 2 * count)));
    std::vector<double> time(fft.size(), 0.0);
    SplitArray<double> h(fft.bins());
    SplitArray<double> d(fft.bins());
    std::copy(response.samples.begin(), response.samples.end(), time.begin());
    fft.forward(time.data(), h.re.data(), h.im.data());
    for (std::size_t n = 0; n < count; ++n)
        time[n] *= (static_cast<double>(n) - static_cast<double>(response.origin)) / response.sampleRate - zero;
    fft.forward(time.data(), d.re.data(), d.im.data());

    std::vector<double> bins;
    std::vector<double> power;
    std::vector<double> delayed;
    for (std::size_t k = 1; k < fft.bins(); ++k)
    {
        bins.push_back(static_cast<double>(k) * response.sampleRate / static_cast<double>(fft.size()));
        power.push_back(h.re[k] * h.re[k] + h.im[k] * h.im[k]);
        delayed.push_back(d.re[k] * h.re[k] + d.im[k] * h.im[k]);
    }
    const SmoothedPower weight(bins, power);
    const SmoothedPower sum(bins, delayed);
    std::vector<double> seconds;
    for (const double f : frequency)
    {
        const double total = weight.at(f, smoothing);
        seconds.push_back(total > 0.0 ? sum.at(f, smoothing) / total : 0.0);
    }
    return seconds;
}

} // namespace pacini
