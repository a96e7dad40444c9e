#pragma once

// A series of second-order sections for whole signals.

#include <pacini/filters/Biquad.h>

#include <array>
#include <cstddef>
#include <span>

namespace pacini
{

/// Filters through `count` sections, in place. What BiquadCascade is for streams, with a number of sections that the
/// compiler knows: it keeps all coefficients and states in registers and overlaps the recursions of neighbouring
/// sections, which makes it about twice as fast; the comparison of long recordings spends much of its time here. Takes
/// samples in double precision too, and does not guard against denormals: recordings end.
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
            {
                const double y = c[i].b0 * x + s[i].s1;
                // In this order y is used last: the recursion is one addition shorter than BiquadState::tick().
                s[i].s1 = (c[i].b1 * x + s[i].s2) - c[i].a1 * y;
                s[i].s2 = c[i].b2 * x - c[i].a2 * y;
                x = y;
            }
            sample = static_cast<Sample>(x);
        }
        states = s;
    }

private:
    std::array<BiquadCoefficients, count> sections;
    std::array<BiquadState, count> states{};
};

} // namespace pacini
