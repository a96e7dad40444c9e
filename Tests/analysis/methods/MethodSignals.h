#pragma once

// Sounds for the translation methods, and their clips played back.

#include "support/Measure.h"

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Fft.h>
#include <pacini/synthesis/Decoder.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace pacini::test
{

/// The drive signal of a clip at fs, without levelling to its envelope.
inline std::vector<float> played(const Clip& clip, double fs)
{
    DecoderParams params;
    params.sampleRate = fs;
    params.followEnvelope = false;
    Decoder decoder(clip, params);
    std::vector<float> out(static_cast<std::size_t>(decoder.totalFrames()));
    decoder.process(out);
    return out;
}

/// The samples from `begin` to `end` seconds.
inline std::span<const float> between(const std::vector<float>& x, double begin, double end, double fs)
{
    const auto first = static_cast<std::size_t>(std::floor(begin * fs + 0.5));
    const auto last = static_cast<std::size_t>(std::floor(end * fs + 0.5));
    return std::span(x).subspan(first, last - first);
}

/// The amplitude of the sinusoid of f Hz in x; the length of x should hold whole periods, also of the other partials.
inline double amplitudeAt(std::span<const float> x, double f, double fs)
{
    return 2.0 * std::abs(spectrumAt(x, f, fs)) / static_cast<double>(x.size());
}

/// The frequency within low..high at which x, under a Hann window, has most energy, to 0.01 Hz: the largest bin of a
/// transform of twice its length, then by definition.
inline double strongestFrequency(std::span<const float> x, double low, double high, double fs)
{
    RealFft<double> fft(nextFastFftSize(2 * x.size()));
    std::vector<double> windowed(fft.size(), 0.0);
    for (std::size_t n = 0; n < x.size(); ++n)
        windowed[n] = static_cast<double>(x[n]) *
                      (1.0 - std::cos(2.0 * std::numbers::pi * static_cast<double>(n) / static_cast<double>(x.size())));
    std::vector<std::complex<double>> spectrum(fft.bins());
    fft.forward(windowed, spectrum);
    const double binWidth = fs / static_cast<double>(fft.size());
    std::size_t largest = 0;
    for (std::size_t k = 0; k < spectrum.size(); ++k)
    {
        const double f = static_cast<double>(k) * binWidth;
        if (f >= low && f <= high && (largest == 0 || std::abs(spectrum[k]) > std::abs(spectrum[largest])))
            largest = k;
    }
    double centre = static_cast<double>(largest) * binWidth;
    const auto part = std::span<const double>(windowed).first(x.size());
    for (double step = 0.5 * binWidth; step > 0.005; step *= 0.5)
    {
        const double below = std::abs(spectrumAt(part, centre - step, fs));
        const double here = std::abs(spectrumAt(part, centre, fs));
        const double above = std::abs(spectrumAt(part, centre + step, fs));
        centre += above > here && above > below ? step : (below > here ? -step : 0.0);
    }
    return centre;
}

} // namespace pacini::test
