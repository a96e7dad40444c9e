#pragma once

// Root finder for the characteristic polynomial of a passive mechanical system.

#include <pacini/actuator/PoleGroup.h>
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

/// Puts conjugate roots together, and of the real ones those that lie close: what nearly coincides must be one group.
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
