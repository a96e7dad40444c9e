#pragma once

// Filter design for the body model: a chain of masses becomes sections of two modes each, and five taps.

#include <pacini/actuator/BodyChain.h>
#include <pacini/actuator/PoleGroups.h>
#include <pacini/foundation/FixedVector.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

namespace pacini
{

/// Methods of discretising the continuous chain. Both have the exact poles exp(p / fs).
enum class BodyHold
{
    corrected, ///< true to the continuous response from 0 to 1000 Hz
    linear     ///< exact for a force that is linear between frames; the first-order hold as it is in textbooks
};

/// Two modes: x1' = a x1 + b x2 + g input, x2' = c x1 + d x2 + input; output = out1 x1 + out2 x2, before the step.
struct BodySection
{
    double a = 0.0, b = 0.0, c = 0.0, d = 0.0;
    double g = 0.0;
    double out1 = 0.0, out2 = 0.0;
    bool operator==(const BodySection&) const = default;

    [[nodiscard]] std::complex<double> response(std::complex<double> z) const noexcept
    {
        const std::complex<double> x1 = g * (z - d) + b;
        const std::complex<double> x2 = (z - a) + c * g;
        return (out1 * x1 + out2 * x2) / ((z - a) * (z - d) - b * c);
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
/// Adds the recursion whose impulse response is the inverse transform of numerator / (factor of the group), all per
/// frame. Two single poles share a section.
inline void addSection(const PoleGroup& group, const PoleNumber& numerator, BodyModelCoefficients& filter) noexcept
{
    const PoleNumber step = expAt(group);
    if (!group.single)
    {
        filter.sections.pushBack({step.a, step.b, group.spread * step.b, step.a, 0.0, numerator.a, numerator.b});
        return;
    }
    for (BodySection& section : filter.sections)
        if (section.b == 0.0 && section.g == 0.0)
        {
            section.a = step.a;
            section.g = 1.0;
            section.out1 = numerator.a;
            return;
        }
    filter.sections.pushBack({0.0, 0.0, 0.0, step.a, 0.0, 0.0, numerator.a});
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
/// The response is split into partial fractions, one for each group of poles, so that nothing grows where the two of a
/// pair meet (critical damping); where two different groups meet their fractions become large and cancel, which costs
/// half the digits at worst. Each fraction becomes the recursion with the poles exp(p / fs) and with the right residues
/// there. That is the first-order hold but for its gain at the pole, which is (sinh(x) / x)^2 with x = p / (2 fs): this
/// droop, 0.14 % at 1 kHz of 48 kHz and 5 % of 8 kHz, would be the largest error of all.
/// Poles above 0.4 fs are left out, since their images would fall into the band of touch: a lightly damped mode near a
/// multiple of fs appears at any frequency in the plain first-order hold. What they do at low frequencies is smooth and
/// goes, with what is smooth of the hold's error, into the five taps. The taps stand around the frame they correct: the
/// response of an undamped stiff joint has no phase, which taps of the past could imitate only with large gains above
/// the band. This costs two frames of latency.
[[nodiscard]] inline BodyModelCoefficients designBodyModel(const BodyChain& chain, BodyPoint point, double fs,
                                                           BodyHold hold = BodyHold::corrected) noexcept
{
    const RealPolynomial denominator = chain.denominator(RealPolynomial::identity());
    const PoleGroupList groups = findPoleGroups(denominator);
    const double leading = denominator.c[denominator.degree()];
    const double fastest = 0.4 * 2.0 * std::numbers::pi; // per frame
    const double slowest = 1e-12;                        // creeping over days: exp(p / fs) cannot be told from 1

    BodyModelCoefficients filter;
    double& middle = filter.tap[BodyModelCoefficients::latency];
    for (std::size_t k = 0; k < groups.size(); ++k)
    {
        const PoleGroup perFrame = groups[k].perFrame(1.0 / fs);
        if (perFrame.slowest() < slowest || (hold == BodyHold::corrected && perFrame.slowest() > fastest))
            continue;
        const PoleNumber fraction =
            chain.force * (chain.numerator(point, valueAt(groups[k])) / (leading * otherFactors(groups, k)));
        // The same per frame: e and time are scaled by 1 / fs.
        const PoleNumber numerator = groups[k].single
                                         ? PoleNumber{fraction.a / fs, 0.0, 0.0}
                                         : PoleNumber{fraction.a / (fs * fs), fraction.b / fs, perFrame.spread};
        if (hold == BodyHold::corrected)
        {
            detail::addSection(perFrame, numerator * expAt(perFrame), filter);
            continue;
        }
        const PoleNumber phi1 = phiAt(perFrame, 1);
        const PoleNumber ramp = numerator * phiAt(perFrame, 2);
        detail::addSection(perFrame, numerator * (phi1 * phi1), filter);
        middle += groups[k].single ? ramp.a : ramp.b;
    }
    if (hold == BodyHold::corrected)
        detail::fitTaps(chain, point, fs, filter);
    else
    {
        // What a force does at once.
        const RealPolynomial numerator = chain.numerator(point, RealPolynomial::identity());
        middle += chain.force * numerator.c[denominator.degree()] / leading;
    }
    return filter;
}

} // namespace pacini
