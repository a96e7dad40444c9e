#pragma once

// Cascade of second-order sections for whole signals.

#include <pacini/filters/Biquad.h>

#include <array>
#include <cstddef>
#include <span>

namespace pacini
{

/// Filters through `count` sections, in place: a BiquadCascade for recordings, with a number of sections known to the
/// compiler. It keeps all coefficients and states in registers and overlaps the recursions of neighbouring sections,
/// which makes it about twice as fast; the comparison of long recordings spends much of its time here. Takes samples in
/// double precision too, and does not guard against denormals, because recordings end. The direct form is exact enough
/// here (see Biquad.h): rates are at most 768 kHz, q is close to 1, and features are floats.
template <std::size_t count>
class SectionCascade
{
public:
    explicit SectionCascade(const std::array<BiquadCoefficients, count>& design) noexcept : sections(design) {}

    /// The state is kept for the next call.
    template <typename Sample>
    void process(std::span<Sample> samples) noexcept
    {
        const auto c = sections; // copies, so that the compiler can keep them in registers
        auto s = states;
        for (Sample& sample : samples)
        {
            auto x = static_cast<double>(sample);
            for (std::size_t i = 0; i < count; ++i)
                x = s[i].tick(c[i], x);
            sample = static_cast<Sample>(x);
        }
        states = s;
    }

private:
    std::array<BiquadCoefficients, count> sections;
    std::array<BiquadState, count> states{};
};

} // namespace pacini
