#pragma once

// Two doubles for parallel computation.

#include <cmath>
#include <cstdint>

namespace pacini
{

/// Two doubles in one vector register of SSE2 or NEON, where the compiler has such; otherwise two doubles. Every
/// operation does to both what it does to one: nothing is rounded otherwise.
class Pair
{
public:
    Pair() noexcept : Pair(0.0) {}
    explicit Pair(double both) noexcept : lanes{both, both} {}
    Pair(double first, double second) noexcept : lanes{first, second} {}

    [[nodiscard]] double first() const noexcept { return lanes[0]; }
    [[nodiscard]] double second() const noexcept { return lanes[1]; }

#if defined(__GNUC__)
    friend Pair operator+(Pair x, Pair y) noexcept
    {
        return Pair(x.lanes + y.lanes);
    }
    friend Pair operator-(Pair x, Pair y) noexcept
    {
        return Pair(x.lanes - y.lanes);
    }
    friend Pair operator*(Pair x, Pair y) noexcept
    {
        return Pair(x.lanes * y.lanes);
    }

    /// The larger one of each two; y where one of them is not a number.
    [[nodiscard]] friend Pair larger(Pair x, Pair y) noexcept
    {
        return Pair(x.lanes > y.lanes ? x.lanes : y.lanes);
    }

    /// The smaller one of each two; y where one of them is not a number.
    [[nodiscard]] friend Pair smaller(Pair x, Pair y) noexcept
    {
        return Pair(x.lanes < y.lanes ? x.lanes : y.lanes);
    }

    [[nodiscard]] friend Pair magnitude(Pair x) noexcept
    {
        constexpr std::int64_t allButSign = std::int64_t((~std::uint64_t(0)) >> 1);
        return Pair(Lanes(Bits(x.lanes) & Bits{allButSign, allButSign}));
    }

    /// 0 for what is not a number or smaller in magnitude than `least`, the others as they are.
    [[nodiscard]] friend Pair cleared(Pair x, double least) noexcept
    {
        return Pair(Lanes(Bits(x.lanes) & Bits(magnitude(x).lanes >= Lanes{least, least})));
    }

private:
    using Lanes = double __attribute__((vector_size(2 * sizeof(double))));
    using Bits = std::int64_t __attribute__((vector_size(2 * sizeof(std::int64_t))));
    explicit Pair(Lanes both) noexcept : lanes(both) {}

    Lanes lanes;
#else
    friend Pair operator+(Pair x, Pair y) noexcept
    {
        return {x.lanes[0] + y.lanes[0], x.lanes[1] + y.lanes[1]};
    }
    friend Pair operator-(Pair x, Pair y) noexcept
    {
        return {x.lanes[0] - y.lanes[0], x.lanes[1] - y.lanes[1]};
    }
    friend Pair operator*(Pair x, Pair y) noexcept
    {
        return {x.lanes[0] * y.lanes[0], x.lanes[1] * y.lanes[1]};
    }
    [[nodiscard]] friend Pair larger(Pair x, Pair y) noexcept
    {
        return {x.lanes[0] > y.lanes[0] ? x.lanes[0] : y.lanes[0], x.lanes[1] > y.lanes[1] ? x.lanes[1] : y.lanes[1]};
    }
    [[nodiscard]] friend Pair smaller(Pair x, Pair y) noexcept
    {
        return {x.lanes[0] < y.lanes[0] ? x.lanes[0] : y.lanes[0], x.lanes[1] < y.lanes[1] ? x.lanes[1] : y.lanes[1]};
    }
    [[nodiscard]] friend Pair magnitude(Pair x) noexcept
    {
        return {std::abs(x.lanes[0]), std::abs(x.lanes[1])};
    }
    [[nodiscard]] friend Pair cleared(Pair x, double least) noexcept
    {
        return {std::abs(x.lanes[0]) >= least ? x.lanes[0] : 0.0, std::abs(x.lanes[1]) >= least ? x.lanes[1] : 0.0};
    }

private:
    double lanes[2];
#endif
};

} // namespace pacini
