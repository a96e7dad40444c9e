#pragma once

// Numbers side by side, in vector registers where the compiler has them.

#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace pacini
{

namespace detail
{
/// `count` numbers, in a vector register where the compiler has the extension that GCC and Clang share.
template <typename Real, std::size_t count>
struct LaneRegister
{
    using Type = std::array<Real, count>;
};
#if defined(__GNUC__)
template <>
struct LaneRegister<float, 4>
{
    using Type = float __attribute__((vector_size(4 * sizeof(float))));
};
template <>
struct LaneRegister<double, 2>
{
    using Type = double __attribute__((vector_size(2 * sizeof(double))));
};
#endif
} // namespace detail

/// SIMD vector: neighbouring numbers that go through the same arithmetic. Nothing is rounded otherwise than one by one.
template <typename Real, std::size_t count>
struct Lanes
{
    typename detail::LaneRegister<Real, count>::Type values;

    [[nodiscard]] static Lanes load(const Real* from) noexcept
    {
        Lanes x;
        std::memcpy(&x.values, from, sizeof(x.values));
        return x;
    }
    [[nodiscard]] static Lanes all(Real value) noexcept
    {
        Lanes x;
        for (std::size_t i = 0; i < count; ++i)
            x.values[i] = value;
        return x;
    }
    void store(Real* to) const noexcept { std::memcpy(to, &values, sizeof(values)); }
    friend Lanes operator+(const Lanes& a, const Lanes& b) noexcept
    {
        return each(a, b, [](const auto& x, const auto& y) { return x + y; });
    }
    friend Lanes operator-(const Lanes& a, const Lanes& b) noexcept
    {
        return each(a, b, [](const auto& x, const auto& y) { return x - y; });
    }
    friend Lanes operator*(const Lanes& a, const Lanes& b) noexcept
    {
        return each(a, b, [](const auto& x, const auto& y) { return x * y; });
    }
    [[nodiscard]] Lanes operator-() const noexcept
    {
        return each(*this, *this, [](const auto& x, const auto&) { return -x; });
    }

private:
    using Register = typename detail::LaneRegister<Real, count>::Type;

    template <typename Operation>
    [[nodiscard]] static Lanes each(const Lanes& a, const Lanes& b, Operation operation) noexcept
    {
        Lanes x;
        if constexpr (std::is_same_v<Register, std::array<Real, count>>)
            for (std::size_t i = 0; i < count; ++i)
                x.values[i] = operation(a.values[i], b.values[i]);
        else
            x.values = operation(a.values, b.values);
        return x;
    }
};

} // namespace pacini
