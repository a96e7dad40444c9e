#pragma once

// Root finder for the characteristic polynomial of a passive mechanical system.

#include <pacini/actuator/RealPolynomial.h>
#include <pacini/foundation/FixedVector.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

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

using PoleGroupList = FixedVector<PoleGroup, RealPolynomial::maxDegree>;

namespace detail
{
using Root = std::complex<double>;
using RootList = FixedVector<Root, RealPolynomial::maxDegree>;

/// Points on circles whose radii are the slopes of the upper convex hull over (i, log c[i]): good guesses of the roots'
/// magnitudes however far apart they lie (D. A. Bini, "Numerical computation of polynomial zeros by means of Aberth's
/// method", 1996).
[[nodiscard]] inline RootList guessRoots(const RealPolynomial& p) noexcept
{
    RootList roots;
    const std::size_t n = p.degree();
    const auto slope = [&p](std::size_t i, std::size_t j)
    {
        return (std::log(p.c[j]) - std::log(p.c[i])) / static_cast<double>(j - i);
    };
    for (std::size_t i = 0; i < n;)
    {
        std::size_t next = n;
        for (std::size_t j = i + 1; j < n; ++j)
            if (p.c[j] > 0.0 && slope(i, j) > slope(i, next))
                next = j;
        const double radius = std::exp(-slope(i, next));
        for (std::size_t k = i; k < next; ++k) // turned by 0.7, so that no guess is real and none are conjugate
            roots.pushBack(
                std::polar(radius, 2.0 * std::numbers::pi * static_cast<double>(k - i) / static_cast<double>(next - i) +
                                       0.7 + static_cast<double>(i)));
        i = next;
    }
    return roots;
}

/// All roots at once (O. Aberth, "Iteration methods for finding all zeros of a polynomial simultaneously", 1973): third
/// order at simple roots, and no deflation that would spoil the small roots beside the large ones.
[[nodiscard]] inline RootList findRoots(const RealPolynomial& p) noexcept
{
    constexpr int maxSteps = 100; // a double root gains a bit per step; about ten steps are usual
    RootList roots = guessRoots(p);
    const RealPolynomial slope = p.derivative();
    for (int step = 0; step < maxSteps; ++step)
    {
        bool moved = false;
        for (std::size_t k = 0; k < roots.size(); ++k)
        {
            const Root newton = p.at(roots[k]) / slope.at(roots[k]);
            Root others = 0.0;
            for (std::size_t j = 0; j < roots.size(); ++j)
                if (j != k && roots[j] != roots[k])
                    others += 1.0 / (roots[k] - roots[j]);
            const Root change = newton / (1.0 - newton * others);
            if (!std::isfinite(std::norm(change)))
                continue;
            roots[k] -= change;
            moved = moved || std::norm(change) > 1e-30 * std::norm(roots[k]);
        }
        if (!moved)
            break;
    }
    return roots;
}

/// Groups conjugate roots, and real roots that lie close together: nearly coincident roots must be one group.
[[nodiscard]] inline PoleGroupList groupRoots(const RootList& roots) noexcept
{
    PoleGroupList groups;
    std::array<bool, RootList::capacity()> used{};
    const auto isReal = [](const Root& root)
    {
        return std::abs(root.imag()) <= 1e-6 * std::abs(root.real());
    };
    const auto distance = [&](const Root& x, const Root& y)
    {
        const double relative = std::abs(x - std::conj(y)) / (std::abs(x) + std::abs(y));
        return isReal(x) == isReal(y) ? relative : HUGE_VAL;
    };
    // The closest first; real roots a factor of 2 apart, or more, stay alone.
    for (;;)
    {
        std::size_t first = 0, second = 0;
        double closest = 1.0 / 3.0;
        for (std::size_t i = 0; i < roots.size(); ++i)
            for (std::size_t j = i + 1; j < roots.size(); ++j)
                if (!used[i] && !used[j] && distance(roots[i], roots[j]) < closest)
                {
                    closest = distance(roots[i], roots[j]);
                    first = i;
                    second = j;
                }
        if (first == second)
            break;
        used[first] = used[second] = true;
        const Root half = 0.5 * (roots[first] - roots[second]);
        groups.pushBack({0.5 * (roots[first] + roots[second]).real(), (half * half).real()});
    }
    for (std::size_t i = 0; i < roots.size(); ++i)
        if (!used[i])
            groups.pushBack({roots[i].real(), 0.0, true});
    return groups;
}
} // namespace detail

/// The product of the factors of all groups but `left`, at the poles of that group.
[[nodiscard]] inline PoleNumber otherFactors(const PoleGroupList& groups, std::size_t left) noexcept
{
    PoleNumber product{1.0, 0.0, groups[left].spread};
    for (std::size_t j = 0; j < groups.size(); ++j)
        if (j != left)
            product = product * factorAt(groups[j], groups[left]);
    return product;
}

/// The roots of a polynomial whose coefficients are not negative, the lowest and highest positive, and whose roots have
/// no positive real part (a passive system), in groups. After Aberth's iteration all factors are corrected together
/// (L. Bairstow 1914 in the simultaneous form of Durand and Kerner), which converges quadratically also where the two
/// roots of a pair coincide. [audio]: no allocation, a bounded number of steps.
[[nodiscard]] inline PoleGroupList findPoleGroups(const RealPolynomial& p) noexcept
{
    PoleGroupList groups = detail::groupRoots(detail::findRoots(p));
    const double leading = p.c[p.degree()];
    for (int step = 0; step < 4; ++step)
        for (std::size_t k = 0; k < groups.size(); ++k)
        {
            // The remainder of p over this factor, divided by the other factors.
            const PoleNumber change = p.at(valueAt(groups[k])) / (leading * otherFactors(groups, k));
            const double size = groups[k].slowest();
            const double largest = 1e-2 * (groups[k].single ? size : size * size);
            if (!(std::abs(change.a) <= largest && std::abs(change.b) <= 1e-2 * size))
                continue; // other poles coincide with this group: the guess is as good as can be
            if (groups[k].single)
                groups[k].centre -= change.a;
            else
            {
                groups[k].centre -= 0.5 * change.b;
                groups[k].spread -= change.a;
            }
        }
    for (PoleGroup& group : groups)
    {
        group.centre = std::min(group.centre, 0.0);
        group.spread = std::min(group.spread, group.centre * group.centre);
    }
    // Where groups meet, coefficients tell their places to about 1e-8 only; a little apart they keep finite residues.
    for (std::size_t k = 1; k < groups.size(); ++k)
        for (std::size_t j = 0; j < k; ++j)
        {
            const double size = groups[k].fastest();
            const PoleNumber apart = factorAt(groups[j], groups[k]);
            if (std::abs(apart.a) < 1e-8 * (groups[j].single ? size : size * size) &&
                (groups[k].single || std::abs(apart.b) < 1e-8 * size))
                groups[k].centre *= 1.0 + 1e-8 * static_cast<double>(k);
        }
    return groups;
}

} // namespace pacini
