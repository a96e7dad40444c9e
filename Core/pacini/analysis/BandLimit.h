#pragma once

// Band-pass for the range of touch: keeps what skin can feel, and a little more that helps the analysis.

#include <pacini/filters/BiquadCascade.h>
#include <pacini/filters/Butterworth.h>
#include <pacini/foundation/Units.h>

namespace pacini
{

/// Corner frequencies of the band limit. The thesis's range (Weber 2020, section 4.3). A low limit of 0 Hz or below
/// leaves out the high-pass, a high limit of
/// 0.49 of the sample rate or above the low-pass.
struct BandLimitParams
{
    Hertz low{5.0};
    Hertz high{1800.0};
    bool operator==(const BandLimitParams&) const = default;
};

/// Butterworth high-pass of second and low-pass of fourth order; the thesis names neither type nor order.
[[nodiscard]] inline BiquadCascadeCoefficients designBandLimit(const BandLimitParams& params, double fs) noexcept
{
    BiquadCascadeCoefficients cascade;
    const auto append = [&](const ButterworthParams& filter)
    {
        for (const StateVariableCoefficients& section : designButterworth(filter, fs).sections)
            cascade.sections.pushBack(section);
    };
    if (params.low.value > 0.0)
        append({.type = ButterworthType::highpass, .order = 2, .frequency = params.low});
    if (params.high.value < 0.49 * fs)
        append({.type = ButterworthType::lowpass, .order = 4, .frequency = params.high});
    return cascade;
}

/// Streaming band limit, causal.
using BandLimit = DesignedCascade<BandLimitParams, designBandLimit>;

static_assert(DspBlock<BandLimit>);

} // namespace pacini
