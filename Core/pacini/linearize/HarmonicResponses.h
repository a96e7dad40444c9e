#pragma once

// Harmonic separation of a deconvolved sweep: the responses of each order, apart from each other.

#include <pacini/foundation/SplitRealFft.h>
#include <pacini/linearize/Deconvolution.h>
#include <pacini/linearize/LagWindow.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

namespace pacini
{

/// 1 / X of an exponential sweep of amplitude 1 that never ends, at f Hz and `rate` Hz:
/// X(f) = rate / 2 sqrt(L / f) exp(i (2 pi L (f - f1) - 2 pi f L ln(f / f1) - pi / 4)) by stationary phase (A. Novak,
/// P. Lotton, L. Simon, "Synchronized swept-sine: theory, application, and implementation", JAES 63, 2015, eq. 33-42).
/// The order N of a sweep is the same sweep L ln N earlier, up to N f2: dividing by the played sweep's own spectrum, as
/// eq. 3.1 does, would leave out all of it above f2. `start` is the sweep's start in s after sample 0.
[[nodiscard]] inline std::complex<double> endlessSweepInverse(double f, const ExponentialSweep& sweep, double rate,
                                                              double start) noexcept
{
    const double growth = sweep.growthTime();
    const double f1 = sweep.lowFrequency();
    const double turns = growth * (f - f1) - f * growth * std::log(f / f1) - f * start;
    const double angle = 2.0 * std::numbers::pi * (turns - std::floor(turns)) - std::numbers::pi / 4.0;
    return std::polar(2.0 / rate * std::sqrt(f / growth), -angle);
}

/// 1 / X of the endless sweep at all bins of a recording's spectrum, 0 below half of its lowest frequency and above
/// `highest` Hz. Y / X has order N of a nonlinear system at lag -L ln N (A. Farina, "Simultaneous measurement of
/// impulse response and distortion with a swept-sine technique", AES 108th convention, 2000), with the amplitude that
/// it has at N f when a sinusoid of amplitude 1 at f goes in.
[[nodiscard]] inline HalfSpectrum endlessSweepInverse(std::size_t bins, const ExponentialSweep& sweep, double rate,
                                                      double start, double highest)
{
    const double perBin = rate / static_cast<double>(2 * (bins - 1));
    HalfSpectrum inverse(bins);
    for (std::size_t k = 0; k < bins; ++k)
    {
        const double f = static_cast<double>(k) * perBin;
        if (f < 0.5 * sweep.lowFrequency() || f > highest)
            continue;
        const auto value = endlessSweepInverse(f, sweep, rate, start);
        inverse.re[k] = value.real();
        inverse.im[k] = value.imag();
    }
    return inverse;
}

/// Lag window of harmonic order `order` (2 or more): its arrival before the linear one, three tenths of the way to the
/// next order before it and seven tenths of that to the order after it, `reverberation` s at most.
[[nodiscard]] inline LagWindow harmonicWindow(int order, double growthTime, double reverberation) noexcept
{
    const double n = order;
    const double arrival = -growthTime * std::log(n);
    const double before = std::min(0.3 * growthTime * std::log((n + 1.0) / n), reverberation);
    const double after = std::min(0.65 * growthTime * std::log(n / (n - 1.0)), reverberation);
    return {arrival - before, arrival - 0.3 * before, arrival + 0.6 * after, arrival + after};
}

/// Lag window of the linear response: the side before its arrival is kept too, see Deconvolver.
[[nodiscard]] inline LagWindow linearWindow(double growthTime, double reverberation) noexcept
{
    const double before = std::min(0.3 * growthTime * std::numbers::ln2, reverberation);
    return {-before, -0.5 * before, 0.7 * reverberation, reverberation};
}

} // namespace pacini
