#pragma once

// Pairs of poles, and functions of both at once that stay exact where they coincide.

#include <cassert>
#include <cmath>

namespace pacini
{

/// Two poles, centre +- sqrt(spread): a conjugate pair when `spread` is negative, two neighbouring real poles when it
/// is positive, a double pole (critical damping) when it is 0. Both numbers move smoothly through that point, where the
/// poles themselves do not. Or a single real pole, `centre`, that lies away from all others: beside a pole a thousand
/// times faster a mean and a spread would not hold it. In 1/s and 1/s^2, or per frame when scaled.
struct PoleGroup
{
    double centre = 0.0;
    double spread = 0.0;
    bool single = false;
    bool operator==(const PoleGroup&) const = default;

    /// The magnitude of the smaller pole: how fast the slower of the two is.
    [[nodiscard]] double slowest() const noexcept
    {
        return spread < 0.0 ? std::sqrt(centre * centre - spread) : std::abs(centre) - std::sqrt(spread);
    }
    [[nodiscard]] double fastest() const noexcept
    {
        return spread < 0.0 ? slowest() : std::abs(centre) + std::sqrt(spread);
    }

    /// The group per frame of `seconds`.
    [[nodiscard]] PoleGroup perFrame(double seconds) const noexcept
    {
        return {centre * seconds, spread * seconds * seconds, single};
    }
};

/// The values of a real function f at the poles p1 and p2 of a group as one number a + b e, where e^2 = spread: a is
/// the mean of f(p1) and f(p2), b their divided difference. For a conjugate pair these are complex numbers up to a
/// scale, for a double pole dual numbers (W. K. Clifford, "Preliminary sketch of biquaternions", 1873), for a single
/// pole b is 0. A function of a pair of poles is computed as for one pole, and nothing divides by their distance.
struct PoleNumber
{
    double a = 0.0;
    double b = 0.0;
    double spread = 0.0;

    friend PoleNumber operator+(const PoleNumber& x, const PoleNumber& y) noexcept
    {
        assert(x.spread == y.spread);
        return {x.a + y.a, x.b + y.b, x.spread};
    }
    friend PoleNumber operator+(const PoleNumber& x, double y) noexcept { return {x.a + y, x.b, x.spread}; }
    friend PoleNumber operator*(double x, const PoleNumber& y) noexcept { return {x * y.a, x * y.b, y.spread}; }
    friend PoleNumber operator*(const PoleNumber& x, const PoleNumber& y) noexcept
    {
        assert(x.spread == y.spread);
        return {x.a * y.a + x.spread * x.b * y.b, x.a * y.b + x.b * y.a, x.spread};
    }
    /// y must not be 0 at any of the poles.
    friend PoleNumber operator/(const PoleNumber& x, const PoleNumber& y) noexcept
    {
        const PoleNumber product = x * PoleNumber{y.a, -y.b, y.spread};
        const double root = std::sqrt(std::abs(y.spread));
        const double norm = y.spread < 0.0 ? y.a * y.a - y.spread * y.b * y.b : (y.a - root * y.b) * (y.a + root * y.b);
        return {product.a / norm, product.b / norm, x.spread};
    }
};

/// The identity: the poles themselves.
[[nodiscard]] inline PoleNumber valueAt(const PoleGroup& group) noexcept
{
    return {group.centre, group.single ? 0.0 : 1.0, group.spread};
}

/// The polynomial with the poles of `factor` as its roots and leading coefficient 1, at the poles of another group. The
/// differences are taken first, so that it is as exact as the poles are also where the groups nearly coincide.
[[nodiscard]] inline PoleNumber factorAt(const PoleGroup& factor, const PoleGroup& group) noexcept
{
    const double apart = group.centre - factor.centre;
    if (factor.single)
        return {apart, group.single ? 0.0 : 1.0, group.spread};
    return {apart * apart + (group.spread - factor.spread), group.single ? 0.0 : 2.0 * apart, group.spread};
}

/// exp at all poles, whose real parts must not be positive; without overflow and without cancellation.
[[nodiscard]] inline PoleNumber expAt(const PoleGroup& group) noexcept
{
    const double middle = std::exp(group.centre);
    if (group.single)
        return {middle, 0.0, 0.0};
    const double root = std::sqrt(std::abs(group.spread));
    if (group.spread < 0.0)
        return {middle * std::cos(root), middle * std::sin(root) / root, group.spread};
    const double slow = std::exp(group.centre + root);
    const double fast = std::exp(group.centre - root);
    double difference = middle;
    if (root > 1.0)
        difference = 0.5 * (slow - fast) / root;
    else if (root > 0.0)
        difference *= std::sinh(root) / root;
    return {0.5 * (slow + fast), difference, group.spread};
}

/// (exp(x) - 1) / x for order 1 and (exp(x) - 1 - x) / x^2 for order 2 at all poles of a group per frame: what a
/// constant and a ramp over one frame leave behind (M. Hochbruck and A. Ostermann, "Exponential integrators", 2010,
/// eq. 2.10). By the power series where the quotients would cancel.
[[nodiscard]] inline PoleNumber phiAt(const PoleGroup& group, int order) noexcept
{
    assert(order == 1 || order == 2);
    const PoleNumber x = valueAt(group);
    if (group.fastest() < 1.0)
    {
        constexpr int terms = 20; // 1 / 20! is below half a unit in the last place
        PoleNumber sum{1.0, 0.0, group.spread};
        for (int k = terms + order; k > order; --k)
            sum = (1.0 / k) * (x * sum) + 1.0;
        return (order == 1 ? 1.0 : 0.5) * sum;
    }
    const PoleNumber first = (expAt(group) + -1.0) / x;
    return order == 1 ? first : (first + -1.0) / x;
}

} // namespace pacini
