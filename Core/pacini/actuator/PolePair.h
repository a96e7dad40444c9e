#pragma once

// Two poles that belong together, and functions of both at once, without trouble where they coincide.

#include <cassert>
#include <cmath>

namespace pacini
{

/// The poles centre +- sqrt(spread): a conjugate pair when `spread` is negative, two real poles when it is positive,
/// one double pole (critical damping) when it is 0. Both numbers move smoothly through that point, where the poles
/// themselves do not. In 1/s and 1/s^2, or per frame when scaled.
struct PolePair
{
    double centre = 0.0;
    double spread = 0.0;
    bool operator==(const PolePair&) const = default;

    /// The magnitude of the smaller pole: how fast the slower of the two is.
    [[nodiscard]] double slowest() const noexcept
    {
        if (spread <= 0.0)
            return std::sqrt(centre * centre - spread);
        // The product over the larger one keeps all digits.
        const double largest = std::abs(centre) + std::sqrt(spread);
        return largest > 0.0 ? std::abs(centre * centre - spread) / largest : 0.0;
    }

    /// The pair over frames of `seconds`.
    [[nodiscard]] PolePair perFrame(double seconds) const noexcept
    {
        return {centre * seconds, spread * seconds * seconds};
    }
};

/// The values of a real function f at the two poles p1 and p2 of a pair as one number a + b e, where e^2 = spread:
/// a is the mean of f(p1) and f(p2), b their divided difference. For a conjugate pair these are complex numbers up to a
/// scale, for a double pole dual numbers (W. K. Clifford, "Preliminary sketch of biquaternions", 1873). A function of
/// the pair of poles is computed as for one pole, and nothing divides by their distance.
struct PairNumber
{
    double a = 0.0;
    double b = 0.0;
    double spread = 0.0;

    friend PairNumber operator+(const PairNumber& x, const PairNumber& y) noexcept
    {
        assert(x.spread == y.spread);
        return {x.a + y.a, x.b + y.b, x.spread};
    }
    friend PairNumber operator+(const PairNumber& x, double y) noexcept { return {x.a + y, x.b, x.spread}; }
    friend PairNumber operator*(double x, const PairNumber& y) noexcept { return {x * y.a, x * y.b, y.spread}; }
    friend PairNumber operator*(const PairNumber& x, const PairNumber& y) noexcept
    {
        assert(x.spread == y.spread);
        return {x.a * y.a + x.spread * x.b * y.b, x.a * y.b + x.b * y.a, x.spread};
    }
    /// y must not be 0 at either pole.
    friend PairNumber operator/(const PairNumber& x, const PairNumber& y) noexcept
    {
        const PairNumber product = x * PairNumber{y.a, -y.b, y.spread};
        const double root = std::sqrt(std::abs(y.spread));
        const double norm = y.spread < 0.0 ? y.a * y.a - y.spread * y.b * y.b : (y.a - root * y.b) * (y.a + root * y.b);
        return {product.a / norm, product.b / norm, x.spread};
    }
};

/// The identity: the poles themselves.
[[nodiscard]] inline PairNumber valueAt(const PolePair& pair) noexcept
{
    return {pair.centre, 1.0, pair.spread};
}

/// (s - p1)(s - p2) at the poles of another pair.
[[nodiscard]] inline PairNumber factorAt(const PolePair& factor, const PairNumber& s) noexcept
{
    const PairNumber distance = s + (-factor.centre);
    return distance * distance + (-factor.spread);
}

/// exp at both poles, whose real parts must not be positive; finite and without cancellation whatever their distance.
[[nodiscard]] inline PairNumber expAt(const PolePair& pair) noexcept
{
    const double root = std::sqrt(std::abs(pair.spread));
    if (pair.spread < 0.0)
    {
        const double decay = std::exp(pair.centre);
        return {decay * std::cos(root), decay * std::sin(root) / root, pair.spread};
    }
    const double slow = std::exp(pair.centre + root);
    const double fast = std::exp(pair.centre - root);
    double difference = std::exp(pair.centre);
    if (root > 1.0)
        difference = 0.5 * (slow - fast) / root;
    else if (root > 0.0)
        difference *= std::sinh(root) / root;
    return {0.5 * (slow + fast), difference, pair.spread};
}

/// phi(x) = (exp(x) - 1) / x of order 1 and phi(x) = (exp(x) - 1 - x) / x^2 of order 2 at both poles of a pair per
/// frame: what a constant and a ramp over one frame leave behind (M. Hochbruck and A. Ostermann, "Exponential
/// integrators", 2010, eq. 2.10). By the power series where the quotients would cancel.
[[nodiscard]] inline PairNumber phiAt(const PolePair& pair, int order) noexcept
{
    assert(order == 1 || order == 2);
    const PairNumber x = valueAt(pair);
    const double largest = pair.spread < 0.0 ? std::sqrt(pair.centre * pair.centre - pair.spread)
                                             : std::abs(pair.centre) + std::sqrt(pair.spread);
    if (largest < 1.0)
    {
        constexpr int terms = 20; // 1 / 20! is below half a unit in the last place
        PairNumber sum{1.0, 0.0, pair.spread};
        for (int k = terms + order; k > order; --k)
            sum = (1.0 / k) * (x * sum) + 1.0;
        return (order == 1 ? 1.0 : 0.5) * sum;
    }
    if (pair.slowest() < 1e-3 * largest)
    {
        // One pole is slow, one fast: each by its own rule.
        const auto phi = [order](double p)
        {
            const double first = p == 0.0 ? 1.0 : std::expm1(p) / p;
            if (order == 1)
                return first;
            return std::abs(p) < 1e-3 ? 0.5 + p * (1.0 / 6.0 + p * (1.0 / 24.0 + p / 120.0)) : (first - 1.0) / p;
        };
        const double slow = phi(-pair.slowest());
        const double fast = phi(-largest);
        return {0.5 * (slow + fast), 0.5 * (slow - fast) / std::sqrt(pair.spread), pair.spread};
    }
    const PairNumber first = (expAt(pair) + -1.0) / x;
    return order == 1 ? first : (first + -1.0) / x;
}

} // namespace pacini
