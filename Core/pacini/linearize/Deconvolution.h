#pragma once

// Deconvolution: computes the impulse response from the played and the recorded signal.

#include <pacini/foundation/Fft.h>
#include <pacini/foundation/SplitRealFft.h>
#include <pacini/foundation/Units.h>
#include <pacini/linearize/Sweep.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Bins 0 .. N/2 of a real signal of N samples.
using HalfSpectrum = SplitArray<double>;

/// a b, bin by bin.
[[nodiscard]] inline HalfSpectrum product(const HalfSpectrum& a, const HalfSpectrum& b)
{
    HalfSpectrum out(a.re.size());
    for (std::size_t k = 0; k < out.re.size(); ++k)
    {
        out.re[k] = a.re[k] * b.re[k] - a.im[k] * b.im[k];
        out.im[k] = a.re[k] * b.im[k] + a.im[k] * b.re[k];
    }
    return out;
}

/// Regularisation: what the inverse of a spectrum adds to |X|^2, relative to its largest value: at 1500 Hz of a sweep
/// from 10 Hz on, where |X|^2 has fallen by 22 dB, it costs 0.0014 dB; beyond the sweep it keeps noise from being
/// raised.
inline constexpr double deconvolutionRegularisation = -60.0; // dB

/// h = IFFT(Y X* / (|X|^2 + eps)) (M. Weber, "A Framework for Audio-Tactile Signal Translation", 2020, eq. 3.1). The
/// result is circular: sample N - k lies k samples before the arrival. Nothing of it is cut, since the regularised
/// impulse has two sides and loses 0.7 dB with one of them.
class Deconvolver
{
public:
    /// `played`: one sweep; `transformSize` even, without prime factors above 5, at least played.size().
    Deconvolver(std::span<const double> played, std::size_t transformSize,
                double regularisation = deconvolutionRegularisation)
        : fft(transformSize), inverse(transformSize / 2 + 1)
    {
        const HalfSpectrum x = spectrum(played);
        double largest = 0.0;
        for (std::size_t k = 0; k < x.re.size(); ++k)
            largest = std::max(largest, x.re[k] * x.re[k] + x.im[k] * x.im[k]);
        const double added = std::max(largest * Decibels(regularisation).power(), 1e-300);
        for (std::size_t k = 0; k < x.re.size(); ++k)
        {
            const double scale = 1.0 / (x.re[k] * x.re[k] + x.im[k] * x.im[k] + added);
            inverse.re[k] = x.re[k] * scale;
            inverse.im[k] = -x.im[k] * scale;
        }
    }

    [[nodiscard]] std::size_t size() const noexcept { return fft.size(); }

    /// The spectrum of up to size() samples, zeros behind them.
    [[nodiscard]] HalfSpectrum spectrum(std::span<const double> samples)
    {
        assert(samples.size() <= fft.size());
        std::vector<double> padded(fft.size(), 0.0);
        std::copy(samples.begin(), samples.end(), padded.begin());
        HalfSpectrum out(fft.bins());
        fft.forward(padded.data(), out.re.data(), out.im.data());
        return out;
    }

    /// Y X* / (|X|^2 + eps) of a recording's spectrum.
    [[nodiscard]] HalfSpectrum response(const HalfSpectrum& recorded) const { return product(recorded, inverse); }

    /// The circular signal of a spectrum.
    [[nodiscard]] std::vector<double> signal(const HalfSpectrum& spectrum)
    {
        std::vector<double> x(fft.size());
        fft.inverse(spectrum.re.data(), spectrum.im.data(), x.data());
        const double scale = 1.0 / static_cast<double>(fft.size());
        for (double& v : x)
            v *= scale;
        return x;
    }

    /// Returns the gain of white-noise power at `f` cycles per sample, from the power of one sample to that of one bin
    /// of a single lag.
    [[nodiscard]] double noisePower(double f) const noexcept
    {
        const auto bin = static_cast<std::size_t>(std::lround(f * static_cast<double>(fft.size())));
        const std::size_t k = std::min(bin, inverse.re.size() - 1);
        return inverse.re[k] * inverse.re[k] + inverse.im[k] * inverse.im[k];
    }

private:
    SplitRealFft<double> fft;
    HalfSpectrum inverse;
};

/// `sweep` sampled at `rate` Hz, the first sample `delay` samples (may be fractional) before its start.
[[nodiscard]] inline std::vector<double> delayedSweep(const ExponentialSweep& sweep, double rate, double delay)
{
    std::vector<double> x(static_cast<std::size_t>(std::ceil(std::max(0.0, sweep.seconds() * rate + delay))));
    for (std::size_t n = 0; n < x.size(); ++n)
        x[n] = sweep.at((static_cast<double>(n) - delay) / rate);
    return x;
}

} // namespace pacini
