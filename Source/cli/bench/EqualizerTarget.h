#pragma once

// Target magnitude of an equalizer at every frequency, for filters that are not made of sections.

#include <pacini/foundation/Fft.h>
#include <pacini/linearize/EqualizerFitProblem.h>
#include <pacini/linearize/EqualizerSearch.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace pacini::cli
{

/// What flattens the points of a problem, drop-outs aside, between them by straight lines over the logarithm of the
/// frequency. Outside of the range it stays what it is at the edge, so that nothing is raised more there. The level at
/// which the response becomes flat is its mean, or as much less as keeps the boost within its limit.
class EqualizerTarget
{
public:
    explicit EqualizerTarget(const EqualizerFitProblem& problem)
    {
        double sum = 0.0, weights = 0.0, lowest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < problem.points(); ++i)
        {
            if (problem.weight[i] <= 0.0)
                continue;
            sum += problem.weight[i] * problem.level[i];
            weights += problem.weight[i];
            lowest = std::min(lowest, problem.level[i]);
        }
        const double level = std::min(sum / weights, lowest + problem.maxBoost);
        for (std::size_t i = 0; i < problem.points(); ++i)
            if (problem.weight[i] > 0.0)
            {
                logFrequency.push_back(std::log(problem.frequency[i]));
                wanted.push_back(level - problem.level[i]);
            }
    }

    /// dB at a frequency above 0 Hz.
    [[nodiscard]] double at(double frequency) const noexcept
    {
        const double x = std::log(frequency);
        const auto above = std::upper_bound(logFrequency.begin(), logFrequency.end(), x);
        if (above == logFrequency.begin())
            return wanted.front();
        if (above == logFrequency.end())
            return wanted.back();
        const auto i = static_cast<std::size_t>(above - logFrequency.begin());
        const double share = (x - logFrequency[i - 1]) / (logFrequency[i] - logFrequency[i - 1]);
        return wanted[i - 1] + share * (wanted[i] - wanted[i - 1]);
    }

private:
    std::vector<double> logFrequency, wanted;
};

/// A size of transform that shows the lowest point of a problem in steps of a twentieth of its frequency, and filters
/// with up to `taps` coefficients without wrapping.
[[nodiscard]] inline std::size_t transformSizeFor(const EqualizerFitProblem& problem, std::size_t taps)
{
    const double steps = std::min(20.0 * problem.fs / problem.frequency[0], 262144.0);
    std::size_t size = 1024;
    while (static_cast<double>(size) < steps || size < 8 * taps)
        size *= 2;
    return size;
}

/// The target's amplitude at the frequencies 0 to fs of a transform of `size` bins, symmetric about fs/2.
[[nodiscard]] inline std::vector<double> amplitudesOf(const EqualizerTarget& target, std::size_t size, double fs)
{
    std::vector<double> amplitude(size);
    for (std::size_t k = 0; k <= size / 2; ++k)
    {
        const double f = fs * (k == 0 ? 1e-9 : static_cast<double>(k) / static_cast<double>(size));
        amplitude[k] = Decibels(target.at(f)).gain();
        if (k > 0 && k < size)
            amplitude[size - k] = amplitude[k];
    }
    return amplitude;
}

/// The inverse transform of a real and symmetric spectrum, which is real and symmetric: an autocorrelation where the
/// spectrum is a power.
[[nodiscard]] inline std::vector<double> symmetricInverse(const std::vector<double>& spectrum)
{
    ComplexFft<double> fft(spectrum.size());
    const std::vector<std::complex<double>> in(spectrum.begin(), spectrum.end());
    std::vector<std::complex<double>> out(spectrum.size());
    fft.inverse(in, out);
    std::vector<double> values;
    values.reserve(out.size());
    for (const auto& value : out)
        values.push_back(value.real() / static_cast<double>(out.size()));
    return values;
}

/// The spectrum of real coefficients, padded with zeros to `size`.
[[nodiscard]] inline std::vector<std::complex<double>> spectrumOf(const std::vector<double>& coefficients,
                                                                  std::size_t size)
{
    ComplexFft<double> fft(size);
    std::vector<std::complex<double>> in(size), out(size);
    std::copy(coefficients.begin(), coefficients.end(), in.begin());
    fft.forward(in, out);
    return out;
}

/// The level in dB of taps[0] + taps[1] z^-1 + ... at `frequency` Hz for the sample rate fs.
[[nodiscard]] inline double polynomialLevel(const std::vector<double>& taps, double frequency, double fs)
{
    const std::complex<double> z = std::polar(1.0, -2.0 * std::numbers::pi * frequency / fs);
    std::complex<double> sum = 0.0;
    for (std::size_t n = taps.size(); n-- > 0;)
        sum = sum * z + taps[n];
    return Decibels::fromGain(std::abs(sum)).value;
}

/// Sets rms, max and level of `fit` to what is left of the problem's response after a filter of levelAt(f) dB.
template <typename Fit, typename LevelAt>
void setFlatness(Fit& fit, const EqualizerFitProblem& problem, LevelAt levelAt)
{
    std::vector<double> curve;
    for (std::size_t i = 0; i < problem.points(); ++i)
        curve.push_back(levelAt(problem.frequency[i]));
    const Flatness flatness = flatnessOf(problem, curve, problem.given);
    fit.rms = flatness.rms;
    fit.max = flatness.max;
    fit.level = flatness.level;
}

/// The impulse response of that magnitude whose energy comes first: the cepstrum of a minimum-phase response is 0 at
/// negative times (A. V. Oppenheim, R. W. Schafer, "Discrete-Time Signal Processing", 3rd ed. 2010, section 13.7).
/// `amplitude` is symmetric as amplitudesOf() has it and above 0.
[[nodiscard]] inline std::vector<double> minimumPhaseResponse(const std::vector<double>& amplitude)
{
    const std::size_t size = amplitude.size();
    std::vector<double> logarithm;
    logarithm.reserve(size);
    for (const double a : amplitude)
        logarithm.push_back(std::log(a));
    std::vector<double> cepstrum = symmetricInverse(logarithm);
    for (std::size_t n = 1; n < size / 2; ++n)
    {
        cepstrum[n] *= 2.0;
        cepstrum[size - n] = 0.0;
    }
    std::vector<std::complex<double>> spectrum = spectrumOf(cepstrum, size);
    for (auto& value : spectrum)
        value = std::exp(value);
    ComplexFft<double> fft(size);
    std::vector<std::complex<double>> response(size);
    fft.inverse(spectrum, response);
    std::vector<double> h;
    h.reserve(size);
    for (const auto& value : response)
        h.push_back(value.real() / static_cast<double>(size));
    return h;
}

} // namespace pacini::cli
