#pragma once

// From a chain of masses to a filter: one second-order section per pair of modes, and five taps.

#include <pacini/actuator/BodyChain.h>
#include <pacini/actuator/PolePairs.h>
#include <pacini/foundation/FixedVector.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

namespace pacini
{

/// How the continuous chain becomes a discrete one. Both have the exact poles exp(p / fs).
enum class BodyHold
{
    corrected, ///< true to the continuous response from 0 to 1000 Hz
    linear     ///< exact for a force that is linear between frames; the first-order hold as it is in textbooks
};

/// One pair of modes: x1' = a x1 + b x2, x2' = c x1 + a x2 + input; output = out1 x1 + out2 x2, before the step.
struct BodySection
{
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
    double out1 = 0.0;
    double out2 = 0.0;
    bool operator==(const BodySection&) const = default;

    [[nodiscard]] std::complex<double> response(std::complex<double> z) const noexcept
    {
        const std::complex<double> distance = z - a;
        return (out1 * b + out2 * distance) / (distance * distance - b * c);
    }
};

/// The sections' and the taps' outputs are added.
struct BodyModelCoefficients
{
    static constexpr std::size_t taps = 5;
    static constexpr std::size_t latency = 2; ///< frames: sections take their input from the middle tap

    FixedVector<BodySection, 3> sections;
    std::array<double, taps> tap{};
    bool operator==(const BodyModelCoefficients&) const = default;

    /// The complex gain at f for the sample rate fs (Hz), including the latency.
    [[nodiscard]] std::complex<double> response(Hertz f, double fs) const noexcept
    {
        const double w = 2.0 * std::numbers::pi * f.value / fs;
        std::complex<double> sum = 0.0;
        for (const BodySection& section : sections)
            sum += section.response(std::polar(1.0, w));
        sum *= std::polar(1.0, -w * static_cast<double>(latency));
        for (std::size_t i = 0; i < taps; ++i)
            sum += tap[i] * std::polar(1.0, -w * static_cast<double>(i));
        return sum;
    }
};

namespace detail
{
/// The section whose impulse response is the inverse transform of numerator / (pole pair), numerator per frame.
[[nodiscard]] inline BodySection makeSection(const PolePair& perFrame, const PairNumber& numerator) noexcept
{
    const PairNumber step = expAt(perFrame);
    return {step.a, step.b, perFrame.spread * step.b, numerator.a, numerator.b};
}

/// Sets the taps so that the whole follows `chain` up to 1000 Hz. What the sections leave is smooth there: it
/// holds no mode any more, only what lies beyond, images of the modes and the modes that were left out. Its real part
/// is even in frequency, its imaginary part odd; the first is fitted by c0 + c1 d^2 + c2 d^4 and the second by sin(w)
/// (c3 + c4 d^2), d = 2 sin(w / 2), which together are all filters of five taps around the middle one. Least squares of
/// the relative error; c0 makes a constant drive come out exactly.
inline void fitTaps(const BodyChain& chain, BodyPoint point, double fs, BodyModelCoefficients& c) noexcept
{
    constexpr int points = 48;
    constexpr double lowest = 10.0; // Hz
    const double highest = std::fmin(BodyBand::highest, 0.4 * fs);
    const double largestD = 2.0 * std::sin(std::numbers::pi * highest / fs);
    const auto left = [&](double f)
    {
        const std::complex<double> z = std::polar(1.0, 2.0 * std::numbers::pi * f / fs);
        std::complex<double> rest = chain.response(point, Hertz(f));
        for (const BodySection& section : c.sections)
            rest -= section.response(z);
        return rest;
    };
    const double constant = left(0.0).real();

    // Normal equations of two fits with two unknowns each, in u = (d / largestD)^2.
    struct Fit
    {
        double aa = 0.0, ab = 0.0, bb = 0.0, ay = 0.0, by = 0.0;
        void add(double weight, double first, double second, double y) noexcept
        {
            aa += weight * first * first;
            ab += weight * first * second;
            bb += weight * second * second;
            ay += weight * first * y;
            by += weight * second * y;
        }
        [[nodiscard]] std::array<double, 2> solved() const noexcept
        {
            const double determinant = aa * bb - ab * ab;
            if (!(determinant > 0.0))
                return {0.0, 0.0};
            return {(ay * bb - by * ab) / determinant, (by * aa - ay * ab) / determinant};
        }
    };
    Fit even, odd;
    for (int i = 0; i < points; ++i)
    {
        const double f = lowest * std::pow(highest / lowest, static_cast<double>(i) / (points - 1));
        const double w = 2.0 * std::numbers::pi * f / fs;
        const double d = 2.0 * std::sin(w / 2.0) / largestD;
        const double u = d * d;
        const std::complex<double> rest = left(f);
        const double weight = 1.0 / std::fmax(std::norm(chain.response(point, Hertz(f))), 1e-300);
        even.add(weight, u, u * u, rest.real() - constant);
        odd.add(weight, std::sin(w) / largestD, std::sin(w) / largestD * u, rest.imag());
    }
    const double scale = 1.0 / (largestD * largestD);
    const auto evenFit = even.solved();
    const auto oddFit = odd.solved();
    const double c1 = evenFit[0] * scale, c2 = evenFit[1] * scale * scale;
    const double c3 = oddFit[0] / largestD, c4 = oddFit[1] / largestD * scale;
    // With t = cos(w): d^2 = 2 - 2 t, d^4 = 6 - 8 t + 2 cos(2w), d^2 sin(w) = 2 sin(w) - sin(2w).
    const double evenOuter = c2;
    const double evenInner = -c1 - 4.0 * c2;
    const double oddOuter = -c4 / 2.0;
    const double oddInner = (c3 + 2.0 * c4) / 2.0;
    c.tap = {evenOuter + oddOuter, evenInner + oddInner, constant + 2.0 * c1 + 6.0 * c2, evenInner - oddInner,
             evenOuter - oddOuter};
}
} // namespace detail

/// The filter that `point` of a chain is to a drive at `fs` Hz.
///
/// The response is split into partial fractions, one second-order fraction per pair of poles, so that nothing grows
/// where the two of a pair meet (critical damping); where two different pairs meet their fractions become large and
/// cancel, which costs half the digits at worst. Each fraction becomes the recursion with the poles exp(p / fs) and
/// with the right residues there. That is the first-order hold but for its gain at the pole, which is (sinh(x) / x)^2
/// with x = p / (2 fs): this droop, 0.14 % at 1 kHz of 48 kHz and 5 % of 8 kHz, would be the largest error of all.
/// Pairs above 0.4 fs are left out, since their images would fall into the band of touch: a lightly damped mode near a
/// multiple of fs appears at any frequency in the plain first-order hold. What they do at low frequencies is smooth and
/// goes, with what is smooth of the hold's error, into the five taps. The taps stand around the frame they correct: the
/// response of an undamped stiff joint has no phase, which taps of the past could imitate only with large gains above
/// the band. This costs two frames of latency.
[[nodiscard]] inline BodyModelCoefficients designBodyModel(const BodyChain& chain, BodyPoint point, double fs,
                                                           BodyHold hold = BodyHold::corrected) noexcept
{
    const RealPolynomial denominator = chain.denominator(RealPolynomial::identity());
    const PolePairList pairs = findPolePairs(denominator);
    const double leading = denominator.c[denominator.degree()];
    const double fastest = 0.4 * 2.0 * std::numbers::pi; // per frame

    BodyModelCoefficients c;
    for (std::size_t k = 0; k < pairs.size(); ++k)
    {
        const PolePair perFrame = pairs[k].perFrame(1.0 / fs);
        if (hold == BodyHold::corrected && perFrame.slowest() > fastest)
            continue;
        const PairNumber s = valueAt(pairs[k]);
        const PairNumber fraction = chain.force * (chain.numerator(point, s) / (leading * otherFactors(pairs, k)));
        // The same per frame: e is scaled by 1 / fs, and so is time.
        const PairNumber numerator{fraction.a / (fs * fs), fraction.b / fs, perFrame.spread};
        if (hold == BodyHold::corrected)
        {
            c.sections.pushBack(detail::makeSection(perFrame, numerator * expAt(perFrame)));
            continue;
        }
        const PairNumber phi1 = phiAt(perFrame, 1);
        c.sections.pushBack(detail::makeSection(perFrame, numerator * (phi1 * phi1)));
        c.tap[BodyModelCoefficients::latency] += (numerator * phiAt(perFrame, 2)).b;
    }
    if (hold == BodyHold::corrected)
        detail::fitTaps(chain, point, fs, c);
    else
    {
        // What a force does at once.
        const RealPolynomial numerator = chain.numerator(point, RealPolynomial::identity());
        c.tap[BodyModelCoefficients::latency] += chain.force * numerator.c[denominator.degree()] / leading;
    }
    return c;
}

} // namespace pacini
