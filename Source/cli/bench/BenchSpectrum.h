#pragma once

// Zero-padded spectra of whole signals, for benchmarks that compare them.

#include <pacini/foundation/Fft.h>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini::cli
{

using Spectrum = std::vector<std::complex<double>>;

/// The bins 0 to size / 2 of a signal with zeros after it; `size` is even.
[[nodiscard]] inline Spectrum spectrumOf(std::span<const float> signal, std::size_t size)
{
    std::vector<double> padded(size);
    std::copy_n(signal.begin(), std::min(signal.size(), size), padded.begin());
    RealFft<double> transform(size);
    Spectrum spectrum(transform.bins());
    transform.forward(padded, spectrum);
    return spectrum;
}

} // namespace pacini::cli
