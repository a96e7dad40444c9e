#pragma once

// SIMD lanes: arithmetic on several numbers at once, in plain loops.

#include <cstddef>

namespace pacini
{

/// SIMD vector: neighbouring numbers that go through the same arithmetic. Plain loops of known length, which compilers
/// turn into single vector instructions when `count` numbers fit a register.
template <typename Real, std::size_t count>
struct Lanes
{
    Real values[count];

    [[nodiscard]] static Lanes load(const Real* from) noexcept
    {
        Lanes x;
        for (std::size_t i = 0; i < count; ++i)
            x.values[i] = from[i];
        return x;
    }
    [[nodiscard]] static Lanes all(Real value) noexcept
    {
        Lanes x;
        for (std::size_t i = 0; i < count; ++i)
            x.values[i] = value;
        return x;
    }
    void store(Real* to) const noexcept
    {
        for (std::size_t i = 0; i < count; ++i)
            to[i] = values[i];
    }
    friend Lanes operator+(const Lanes& a, const Lanes& b) noexcept
    {
        Lanes x;
        for (std::size_t i = 0; i < count; ++i)
            x.values[i] = a.values[i] + b.values[i];
        return x;
    }
    friend Lanes operator-(const Lanes& a, const Lanes& b) noexcept
    {
        Lanes x;
        for (std::size_t i = 0; i < count; ++i)
            x.values[i] = a.values[i] - b.values[i];
        return x;
    }
    friend Lanes operator*(const Lanes& a, const Lanes& b) noexcept
    {
        Lanes x;
        for (std::size_t i = 0; i < count; ++i)
            x.values[i] = a.values[i] * b.values[i];
        return x;
    }
    [[nodiscard]] Lanes operator-() const noexcept
    {
        Lanes x;
        for (std::size_t i = 0; i < count; ++i)
            x.values[i] = -values[i];
        return x;
    }
};

} // namespace pacini
