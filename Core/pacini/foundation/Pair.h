#pragma once

// Two doubles that are computed side by side.

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

private:
    using Lanes = double __attribute__((vector_size(2 * sizeof(double))));
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

private:
    double lanes[2];
#endif
};

} // namespace pacini
