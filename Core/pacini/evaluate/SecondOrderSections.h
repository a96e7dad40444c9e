#pragma once

// Cascaded second-order sections for offline filtering, and the few designs that the measures are defined with.

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>

namespace pacini::detail
{

/// H(z) = (b0 + b1 z^-1 + b2 z^-2) / (1 + a1 z^-1 + a2 z^-2).
struct SecondOrderSection
{
    double b0 = 1.0;
    double b1 = 0.0;
    double b2 = 0.0;
    double a1 = 0.0;
    double a2 = 0.0;
};

/// Filters sample by sample through `count` sections in transposed direct form II. All sections of a sample are in one
/// loop, so that the processor overlaps the recursions of neighbouring sections.
template <std::size_t count>
class SectionCascade
{
public:
    explicit SectionCascade(const std::array<SecondOrderSection, count>& design) noexcept : sections(design) {}

    /// In place; the state is kept for the next call.
    template <typename Sample>
    void process(std::span<Sample> samples) noexcept
    {
        auto c = sections; // copies, so that the compiler can keep them in registers
        auto s = states;
        for (Sample& sample : samples)
        {
            auto x = static_cast<double>(sample);
            for (std::size_t i = 0; i < count; ++i)
            {
                const double y = c[i].b0 * x + s[i][0];
                s[i][0] = (c[i].b1 * x + s[i][1]) - c[i].a1 * y; // in this order y is used last: the recursion is short
                s[i][1] = c[i].b2 * x - c[i].a2 * y;
                x = y;
            }
            sample = static_cast<Sample>(x);
        }
        states = s;
    }

private:
    std::array<SecondOrderSection, count> sections;
    std::array<std::array<double, 2>, count> states{};
};

/// Second-order low-pass at f (Hz, below fs / 2) by the bilinear transform: R. Bristow-Johnson, "Cookbook formulae for
/// audio equalizer biquad filter coefficients", 1994. q = sqrt(1/2) is Butterworth.
[[nodiscard]] inline SecondOrderSection lowpassSection(double f, double fs,
                                                       double q = std::numbers::sqrt2 / 2.0) noexcept
{
    const double w = 2.0 * std::numbers::pi * f / fs;
    const double alpha = std::sin(w) / (2.0 * q);
    const double b = (1.0 - std::cos(w)) / (1.0 + alpha);
    return {b / 2.0, b, b / 2.0, -2.0 * std::cos(w) / (1.0 + alpha), (1.0 - alpha) / (1.0 + alpha)};
}

/// Second-order high-pass, as lowpassSection().
[[nodiscard]] inline SecondOrderSection highpassSection(double f, double fs,
                                                        double q = std::numbers::sqrt2 / 2.0) noexcept
{
    const double w = 2.0 * std::numbers::pi * f / fs;
    const double alpha = std::sin(w) / (2.0 * q);
    const double b = (1.0 + std::cos(w)) / (1.0 + alpha);
    return {b / 2.0, -b, b / 2.0, -2.0 * std::cos(w) / (1.0 + alpha), (1.0 - alpha) / (1.0 + alpha)};
}

/// Butterworth band-pass of order 2 (two sections) with -3 dB at low and high (Hz, 0 < low < high < fs / 2): poles of
/// the second-order low-pass prototype, low-pass to band-pass substitution, bilinear transform with both edges
/// prewarped (A. Oppenheim and R. Schafer, "Discrete-Time Signal Processing", 3rd edition 2010, sections 7.2 and B.1).
[[nodiscard]] inline std::array<SecondOrderSection, 2> bandpassSections(double low, double high, double fs) noexcept
{
    const double w1 = 2.0 * fs * std::tan(std::numbers::pi * low / fs);
    const double w2 = 2.0 * fs * std::tan(std::numbers::pi * high / fs);
    const std::complex<double> prototype = std::polar(1.0, 0.75 * std::numbers::pi); // and its conjugate
    const std::complex<double> half = prototype * ((w2 - w1) / 2.0);
    const std::complex<double> root = std::sqrt(half * half - w1 * w2);
    std::array<SecondOrderSection, 2> sections;
    for (std::size_t i = 0; i < 2; ++i)
    {
        // One pole of each conjugate pair; each section has a zero at 0 Hz and one at fs / 2. In the s plane it is
        // (w2 - w1) s / ((s - p)(s - p*)).
        const std::complex<double> p = i == 0 ? half + root : half - root;
        const std::complex<double> z = (2.0 * fs + p) / (2.0 * fs - p);
        const double gain = (w2 - w1) * 2.0 * fs / std::norm(2.0 * fs - p);
        sections[i] = {gain, 0.0, -gain, -2.0 * z.real(), std::norm(z)};
    }
    return sections;
}

} // namespace pacini::detail
