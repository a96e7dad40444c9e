#pragma once

// Second-order sections as polynomials in z^-1: their parameters, design and response.

#include <pacini/filters/DesignLimits.h>
#include <pacini/foundation/Units.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace pacini
{

/// Type of a second-order section.
enum class BiquadType
{
    lowpass,
    highpass,
    bandpass, ///< 0 dB at its peak
    notch,
    allpass,
    peak,
    lowShelf,
    highShelf,
};

/// Parameters of a second-order section. Frequencies are clamped to 1e-7 to 0.4999 of the sample rate, q to 1e-6 to
/// 1e5, gains to +-120 dB.
struct BiquadParams
{
    BiquadType type = BiquadType::lowpass;
    Hertz frequency{1000.0};
    double q = std::numbers::sqrt2 / 2.0;
    Decibels gain{0.0}; ///< peak and shelves only
    bool operator==(const BiquadParams&) const = default;
};

/// H(z) = (b0 + b1 z^-1 + b2 z^-2) / (1 + a1 z^-1 + a2 z^-2). As constructed it passes everything unchanged.
struct BiquadCoefficients
{
    double b0 = 1.0, b1 = 0.0, b2 = 0.0;
    double a1 = 0.0, a2 = 0.0;
    bool operator==(const BiquadCoefficients&) const = default;

    /// The complex gain at frequency f for the sample rate fs (Hz).
    [[nodiscard]] std::complex<double> response(Hertz f, double fs) const noexcept
    {
        // Both polynomials are expanded around z = 1 (z^-1 = 1 - d): far below the sample rate their terms cancel
        // almost completely there, and the plain sums would lose up to eleven digits.
        const double w = 2.0 * std::numbers::pi * f.value / fs;
        const double half = std::sin(w / 2.0);
        const std::complex<double> d{2.0 * half * half, std::sin(w)};
        const auto around1 = [d](double c0, double c1, double c2)
        {
            return (c0 + c1 + c2) - d * (c1 + 2.0 * c2 - d * c2);
        };
        return around1(b0, b1, b2) / around1(1.0, a1, a2);
    }
};

/// The section of the given type by the bilinear transform: R. Bristow-Johnson, "Cookbook formulae for audio equalizer
/// biquad filter coefficients", 1994 (W3C note 2021), with Q as the width of peaks and the slope of shelves.
/// The cookbook is what equalizers and published parameter tables use. Streams run the same sections as
/// designStateVariable(): a1 and a2 rounded to doubles leave an error of up to -137 dB at 20 Hz, Q 20 and 768 kHz (it
/// grows with Q (fs / f)^2, rounding in the recursion with sqrt(Q (fs / f)^3)), and they must not move per sample.
[[nodiscard]] inline BiquadCoefficients designBiquad(const BiquadParams& params, double fs) noexcept
{
    const double w = 2.0 * std::numbers::pi * clampedFrequency(params.frequency, fs) / fs;
    const double half = std::sin(w / 2.0);
    const double oneMinusCosine = 2.0 * half * half; // 1 - cos(w) loses all digits at low frequencies
    const double cosine = 1.0 - oneMinusCosine;
    const double alpha = std::sin(w) / (2.0 * clampedQ(params.q));
    const double a = std::sqrt(clampedGain(params.gain).gain());

    const auto normalised = [](double b0, double b1, double b2, double a0, double a1, double a2)
    {
        return BiquadCoefficients{b0 / a0, b1 / a0, b2 / a0, a1 / a0, a2 / a0};
    };
    const auto over = [&](double b0, double b1, double b2)
    {
        return normalised(b0, b1, b2, 1.0 + alpha, -2.0 * cosine, 1.0 - alpha);
    };
    const auto shelf = [&](double sign) // the high shelf is the low shelf with the sign of the cosine changed
    {
        const double c = sign * cosine;
        const double slope = 2.0 * std::sqrt(a) * alpha;
        return normalised(a * ((a + 1.0) - (a - 1.0) * c + slope), sign * 2.0 * a * ((a - 1.0) - (a + 1.0) * c),
                          a * ((a + 1.0) - (a - 1.0) * c - slope), (a + 1.0) + (a - 1.0) * c + slope,
                          sign * -2.0 * ((a - 1.0) + (a + 1.0) * c), (a + 1.0) + (a - 1.0) * c - slope);
    };

    switch (params.type)
    {
    case BiquadType::lowpass:
        return over(oneMinusCosine / 2.0, oneMinusCosine, oneMinusCosine / 2.0);
    case BiquadType::highpass:
        return over((1.0 + cosine) / 2.0, -(1.0 + cosine), (1.0 + cosine) / 2.0);
    case BiquadType::bandpass:
        return over(alpha, 0.0, -alpha);
    case BiquadType::notch:
        return over(1.0, -2.0 * cosine, 1.0);
    case BiquadType::allpass:
        return over(1.0 - alpha, -2.0 * cosine, 1.0 + alpha);
    case BiquadType::peak:
        return normalised(1.0 + alpha * a, -2.0 * cosine, 1.0 - alpha * a, 1.0 + alpha / a, -2.0 * cosine,
                          1.0 - alpha / a);
    case BiquadType::lowShelf:
        return shelf(1.0);
    case BiquadType::highShelf:
        return shelf(-1.0);
    }
    return {};
}

/// The memory of one section in transposed direct form II: of the direct forms the one with the least rounding noise in
/// floating point, and the fastest of all. For fixed filters at rates up to a few hundred times their frequency.
struct BiquadState
{
    double s1 = 0.0;
    double s2 = 0.0;

    double tick(const BiquadCoefficients& c, double x) noexcept
    {
        const double y = c.b0 * x + s1;
        s1 = (c.b1 * x + s2) - c.a1 * y; // y last: it is what the recursion waits for
        s2 = c.b2 * x - c.a2 * y;
        return y;
    }
};

} // namespace pacini
