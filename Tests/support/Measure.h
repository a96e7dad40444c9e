#pragma once

// Measurements of signals by their definitions, slow and independent of the code under test.

#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace pacini::test
{

/// sum x[n] exp(-2 pi i f n / fs): the spectrum of a whole signal, such as an impulse response, at one frequency.
template <typename T>
std::complex<double> spectrumAt(std::span<const T> x, double f, double fs)
{
    const double w = 2.0 * std::numbers::pi * f / fs;
    std::complex<double> sum = 0.0;
    for (std::size_t n = 0; n < x.size(); ++n)
        sum +=
            static_cast<double>(x[n]) * std::polar(1.0, -std::fmod(w * static_cast<double>(n), 2.0 * std::numbers::pi));
    return sum;
}

/// a sin(2 pi f n / fs + phase)
inline std::vector<float> sine(std::size_t frames, double f, double fs, double a = 1.0, double phase = 0.0)
{
    std::vector<float> x(frames);
    for (std::size_t n = 0; n < frames; ++n)
        x[n] = static_cast<float>(a * std::sin(2.0 * std::numbers::pi * f * static_cast<double>(n) / fs + phase));
    return x;
}

/// Uniform noise of +-a.
inline std::vector<float> noise(std::size_t frames, std::uint64_t seed, double a = 1.0)
{
    Random random(seed);
    std::vector<float> x(frames);
    for (float& v : x)
        v = static_cast<float>(a * random.uniform(-1.0, 1.0));
    return x;
}

/// A single 1 at frame `at`.
inline std::vector<float> impulse(std::size_t frames, std::size_t at = 0)
{
    std::vector<float> x(frames, 0.0f);
    x[at] = 1.0f;
    return x;
}

/// Largest magnitude.
[[nodiscard]] double peakOf(const auto& x)
{
    double peak = 0.0;
    for (const auto v : x)
        peak = std::max(peak, std::abs(static_cast<double>(v)));
    return peak;
}

inline double rms(std::span<const float> x)
{
    double sum = 0.0;
    for (float v : x)
        sum += static_cast<double>(v) * static_cast<double>(v);
    return x.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(x.size()));
}

/// The impulse response of the bilinear second-order low-pass (order 0), band-pass with a peak of 1 (order 1) or
/// high-pass (order 2) at frame n, from its pair of complex poles (q > 0.5) in long double: no recursion, and no
/// difference of nearly equal numbers.
class ClosedFormResponse
{
public:
    ClosedFormResponse(int numeratorOrder, long double ratio, long double q)
    {
        using Complex = std::complex<long double>;
        const long double g = std::tan(std::numbers::pi_v<long double> * ratio);
        const Complex s = g * Complex(-0.5L / q, std::sqrt(1.0L - 0.25L / (q * q)));
        pole = (1.0L + s) / (1.0L - s);
        logPole = 2.0L * std::atanh(s);
        const long double a0 = 1.0L + g / q + g * g;
        const long double a2 = (1.0L - g / q + g * g) / a0;
        const Complex toOne = 2.0L * s / (1.0L - s) / pole;  // 1 - 1/p
        const Complex toMinusOne = 2.0L / (1.0L - s) / pole; // 1 + 1/p
        const Complex apart = Complex(0.0L, 2.0L * pole.imag()) / pole;
        const long double gain = (numeratorOrder == 0 ? g * g : numeratorOrder == 1 ? g / q : 1.0L) / a0;
        const Complex numerator = numeratorOrder == 0   ? toMinusOne * toMinusOne
                                  : numeratorOrder == 1 ? toMinusOne * toOne
                                                        : toOne * toOne;
        residue = gain * numerator / apart;
        const long double b2 = numeratorOrder == 1 ? -gain : gain;
        direct = b2 / a2;
    }

    [[nodiscard]] long double at(std::size_t n) const
    {
        const long double tail = 2.0L * (residue * std::exp(logPole * static_cast<long double>(n))).real();
        return n == 0 ? tail + direct : tail;
    }

private:
    std::complex<long double> pole;
    std::complex<long double> logPole;
    std::complex<long double> residue;
    long double direct = 0.0L;
};

} // namespace pacini::test
