#pragma once

// Window functions, and the windowed sinc for sample-rate converters.

#include <pacini/foundation/Portable.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace pacini
{

/// Periodic Hann window (for transforms): 0.5 - 0.5 cos(2 pi i / n), i = 0..n-1.
[[nodiscard]] inline std::vector<double> hannPeriodic(std::size_t n)
{
    std::vector<double> w(n);
    for (std::size_t i = 0; i < n; ++i)
        w[i] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
    return w;
}

/// Zeroth-order modified Bessel function of the first kind, by its power series (converges for every finite x).
[[nodiscard]] inline double besselI0(double x)
{
    const double quarter = x * x / 4.0;
    double term = 1.0;
    double sum = 1.0;
    for (int k = 1; term > sum * 1e-17; ++k)
    {
        term *= quarter / (static_cast<double>(k) * static_cast<double>(k));
        sum += term;
    }
    return sum;
}

/// Kaiser's shape parameter for a stop-band attenuation in dB (Kaiser 1974).
[[nodiscard]] inline double kaiserBeta(double attenuation)
{
    if (attenuation > 50.0)
        return 0.1102 * (attenuation - 8.7);
    if (attenuation >= 21.0)
        return 0.5842 * std::pow(attenuation - 21.0, 0.4) + 0.07886 * (attenuation - 21.0);
    return 0.0;
}

/// The Kaiser window I0(beta sqrt(1 - u^2)) / I0(beta). I0 is a power series in the square of its argument, so the
/// window is a polynomial in 1 - u^2, whose coefficients are found once: filters need thousands of values.
class KaiserWindow
{
public:
    explicit KaiserWindow(double beta)
    {
        const double scale = 1.0 / besselI0(beta);
        double term = scale;
        for (int k = 1; term > 1e-18; ++k)
        {
            coefficients.push_back(term);
            term *= beta * beta / 4.0 / (static_cast<double>(k) * static_cast<double>(k));
        }
    }

    /// The value at position u in [-1, 1], 0 outside.
    [[nodiscard]] double at(double u) const noexcept
    {
        const double w = 1.0 - u * u;
        if (w < 0.0)
            return 0.0;
        double value = 0.0;
        for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c)
            value = value * w + *c;
        return value;
    }

private:
    std::vector<double> coefficients;
};

/// Taps of a filter with a Kaiser window that is `attenuation` dB down after a transition `width` wide, in cycles per
/// sample (Kaiser 1974).
[[nodiscard]] inline std::size_t kaiserTaps(double attenuation, double width)
{
    return static_cast<std::size_t>(std::ceil((attenuation - 7.95) / (14.36 * width))) + 1;
}

/// A low-pass of `taps` taps and unit gain at 0 Hz: a sinc cut off (-6 dB) at `cutoff` cycles per sample under a window
/// that ends `half` samples from its centre. Tap i stands at offset + i - centre.
[[nodiscard]] inline std::vector<double> windowedSinc(std::size_t taps, double cutoff, double offset, double centre,
                                                      const KaiserWindow& window, double half)
{
    std::vector<double> row(taps);
    double sum = 0.0;
    for (std::size_t i = 0; i < taps; ++i)
    {
        const double t = offset + static_cast<double>(i) - centre;
        const double x = 2.0 * std::numbers::pi * cutoff * t;
        // Its zeros are zeros exactly, so that a row that keeps its input does.
        row[i] = (std::abs(x) < 1e-12 ? 1.0 : portable::turnBy(cutoff * t).imag() / x) * window.at(t / half);
        sum += row[i];
    }
    for (double& tap : row)
        tap /= sum;
    return row;
}

} // namespace pacini
