#pragma once

// Cascade of second-order sections, without allocation.

#include <pacini/filters/StateVariable.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/FixedVector.h>

#include <algorithm>
#include <array>
#include <complex>
#include <cstddef>
#include <span>

namespace pacini
{

inline constexpr std::size_t maxBiquadSections = 32;

/// Sections in series; an empty cascade passes everything unchanged.
struct BiquadCascadeCoefficients
{
    FixedVector<StateVariableCoefficients, maxBiquadSections> sections;
    bool operator==(const BiquadCascadeCoefficients&) const = default;

    /// The complex gain of the whole series at f for the sample rate fs (Hz).
    [[nodiscard]] std::complex<double> response(Hertz f, double fs) const noexcept
    {
        std::complex<double> product = 1.0;
        for (const StateVariableCoefficients& section : sections)
            product *= section.response(f, fs);
        return product;
    }
};

/// A streaming filter of sections in series, designed by the pure function `Design`(params, fs) ->
/// BiquadCascadeCoefficients. Parameters may change between calls; sections that remain keep their state, new ones
/// start from silence. Sections run in state-variable form (see StateVariable.h).
template <typename P, auto Design>
class DesignedCascade : public DesignedBlock<DesignedCascade<P, Design>, P>
{
public:
    void setParams(const P& params) noexcept
    {
        this->current = params;
        cascade = Design(params, this->fs);
        for (std::size_t i = cascade.sections.size(); i < states.size(); ++i)
            states[i] = {};
    }
    void reset() noexcept { states = {}; }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        const std::size_t count = cascade.sections.size();
        if (count == 0) // a loop without branches, at a fraction of what sections cost
        {
            std::transform(in.begin(), in.end(), out.begin(), passedSample);
            return;
        }
        const auto tick = [this, count](double x)
        {
            for (std::size_t i = 0; i < count; ++i)
                x = states[i].tick(cascade.sections[i], x);
            return x;
        };
        const auto flush = [this, count]
        {
            for (std::size_t i = 0; i < count; ++i)
                states[i].flush();
        };
        forEachSample(in, out, tick, flush);
    }

    [[nodiscard]] const BiquadCascadeCoefficients& coefficients() const noexcept { return cascade; }

private:
    BiquadCascadeCoefficients cascade = Design(P{}, ProcessSpec{}.sampleRate);
    std::array<StateVariableState, maxBiquadSections> states{};
};

/// Parameters of sections in series.
using BiquadCascadeParams = FixedVector<BiquadParams, maxBiquadSections>;

/// One cookbook section (see designStateVariable) for each element.
[[nodiscard]] inline BiquadCascadeCoefficients designBiquadCascade(const BiquadCascadeParams& params,
                                                                   double fs) noexcept
{
    BiquadCascadeCoefficients cascade;
    for (const BiquadParams& section : params)
        cascade.sections.pushBack(designStateVariable(section, fs));
    return cascade;
}

/// Cookbook sections in series, such as an equalizer's.
using BiquadCascade = DesignedCascade<BiquadCascadeParams, designBiquadCascade>;

static_assert(DspBlock<BiquadCascade>);

} // namespace pacini
