#pragma once

// Butterworth filters of any order as second-order sections.

#include <pacini/filters/BiquadCascade.h>
#include <pacini/filters/DesignLimits.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace pacini
{

/// Low-pass or high-pass.
enum class ButterworthType
{
    lowpass,
    highpass,
    bandpass,
};

inline constexpr int maxButterworthOrder = 16;

/// Parameters of a Butterworth filter. Order 1 to 16 (clamped; a band-pass has twice as many poles). Frequencies are
/// the -3 dB points, clamped to 1e-7 to
/// 0.4999 of the sample rate; highFrequency counts for the band-pass only and is kept 0.01 % above `frequency`.
struct ButterworthParams
{
    ButterworthType type = ButterworthType::lowpass;
    int order = 2;
    Hertz frequency{1000.0};
    Hertz highFrequency{2000.0};
    bool operator==(const ButterworthParams&) const = default;
};

namespace detail
{

/// sin and cos of the angles under which the prototype's pole pairs lie: pair k has the poles -sine +- j cosine.
struct ButterworthPair
{
    double sine;
    double cosine;
    [[nodiscard]] double q() const noexcept { return 0.5 / sine; }
};

inline ButterworthPair butterworthPair(int order, int k) noexcept
{
    const double angle = std::numbers::pi * (2.0 * k + 1.0) / (2.0 * order);
    return {std::sin(angle), std::cos(angle)};
}

/// First-order low- or high-pass by the prewarped bilinear transform, 1 or s over s + 1: as a section with s + 1 above
/// and below once more. f as clampedFrequency() returns it.
inline StateVariableCoefficients firstOrderSection(bool highpass, double f, double fs) noexcept
{
    const auto loop = StateVariableLoop::design(f, 2.0, fs);
    return StateVariableCoefficients::make(loop, highpass ? 1.0 : 0.0, 1.0, highpass ? 0.0 : 1.0);
}

inline void appendLowOrHighpass(const ButterworthParams& params, int order, double fs,
                                BiquadCascadeCoefficients& cascade) noexcept
{
    // With prewarping a pole pair of quality q becomes exactly the cookbook's section of that q.
    const bool highpass = params.type == ButterworthType::highpass;
    const BiquadType type = highpass ? BiquadType::highpass : BiquadType::lowpass;
    if (order % 2 == 1)
        cascade.sections.pushBack(firstOrderSection(highpass, clampedFrequency(params.frequency, fs), fs));
    for (int k = order / 2 - 1; k >= 0; --k)
        cascade.sections.pushBack(designStateVariable({type, params.frequency, butterworthPair(order, k).q()}, fs));
}

inline void appendBandpass(const ButterworthParams& params, int order, double fs,
                           BiquadCascadeCoefficients& cascade) noexcept
{
    const auto warped = [fs](double f)
    {
        return std::tan(std::numbers::pi * f / fs);
    };
    const double narrowest = 1.0 + 1e-4;
    const double top = designLimits::highestFrequency * fs;
    const double low = std::min(clampedFrequency(params.frequency, fs), top / narrowest);
    const double high = clampTo(params.highFrequency.value, low * narrowest, top);
    const double width = warped(high) - warped(low);
    const double centreSquared = warped(high) * warped(low);
    const double centre = std::sqrt(centreSquared);

    const auto append = [&](double omega, double q)
    {
        // width s above in place of a section's own k s
        const auto loop = StateVariableLoop::make(omega, 1.0 / q);
        cascade.sections.pushBack(StateVariableCoefficients::make(loop, 0.0, width / centre, 0.0));
    };
    if (order % 2 == 1)
        append(centre, centre / width);
    for (int k = order / 2 - 1; k >= 0; --k)
    {
        // s^2 - width p s + centre^2 = 0 for the prototype pole p: two poles whose product is centre^2.
        const auto pair = butterworthPair(order, k);
        const std::complex<double> b = width * std::complex<double>(-pair.sine, pair.cosine);
        const std::complex<double> root = std::sqrt(b * b - 4.0 * centreSquared);
        const bool sameSide = (std::conj(b) * root).real() >= 0.0; // add, never subtract: no cancellation
        const std::complex<double> pole = (sameSide ? b + root : b - root) / 2.0;
        const double omega = std::abs(pole);
        const double q = -omega / (2.0 * pole.real());
        append(omega, q);
        append(centreSquared / omega, q);
    }
}

} // namespace detail

/// Sections of the Butterworth filter by the prewarped bilinear transform (A. V. Oppenheim and R. W. Schafer,
/// "Discrete-Time Signal Processing", 3rd ed. 2010, sections 7.2 and 7.3), designed pole by pole: expanding the whole
/// polynomial would lose all digits at low frequencies and high orders. Sections of low q come first, so that no
/// resonance meets the unfiltered signal.
[[nodiscard]] inline BiquadCascadeCoefficients designButterworth(const ButterworthParams& params, double fs) noexcept
{
    const int order = clampTo(params.order, 1, maxButterworthOrder);
    BiquadCascadeCoefficients cascade;
    if (params.type == ButterworthType::bandpass)
        detail::appendBandpass(params, order, fs, cascade);
    else
        detail::appendLowOrHighpass(params, order, fs, cascade);
    return cascade;
}

/// Streaming Butterworth filter.
using Butterworth = DesignedCascade<ButterworthParams, designButterworth>;

static_assert(DspBlock<Butterworth>);

} // namespace pacini
