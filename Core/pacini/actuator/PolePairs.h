#pragma once

// The roots of the characteristic polynomial of a passive mechanical system, two by two.

#include <pacini/actuator/PolePair.h>
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

using PolePairList = FixedVector<PolePair, RealPolynomial::maxDegree / 2>;

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
    constexpr int mostSteps = 100; // a double root gains a bit per step; about ten steps are usual
    RootList roots = guessRoots(p);
    const RealPolynomial slope = p.derivative();
    for (int step = 0; step < mostSteps; ++step)
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

/// Puts conjugate roots together, and of the real ones those that lie closest: what nearly coincides must be one pair.
[[nodiscard]] inline PolePairList pairRoots(RootList roots) noexcept
{
    PolePairList pairs;
    const auto isReal = [](const Root& root)
    {
        return std::abs(root.imag()) <= 1e-6 * std::abs(root.real());
    };
    std::array<bool, RootList::capacity()> used{};
    for (std::size_t left = roots.size(); left >= 2; left -= 2)
    {
        std::size_t first = 0, second = 0;
        double closest = HUGE_VAL;
        for (std::size_t i = 0; i < roots.size(); ++i)
            for (std::size_t j = i + 1; j < roots.size(); ++j)
            {
                if (used[i] || used[j])
                    continue;
                const double size = std::abs(roots[i]) + std::abs(roots[j]);
                double distance = std::abs(roots[i] - std::conj(roots[j])) / size;
                if (isReal(roots[i]) != isReal(roots[j]))
                    distance += 1.0;
                else if (isReal(roots[i]))
                    distance += 1e-3; // the conjugate pairs come first
                if (distance < closest)
                {
                    closest = distance;
                    first = i;
                    second = j;
                }
            }
        used[first] = used[second] = true;
        const Root half = 0.5 * (roots[first] - roots[second]);
        pairs.pushBack({0.5 * (roots[first] + roots[second]).real(), (half * half).real()});
    }
    return pairs;
}
} // namespace detail

/// The product of the quadratic factors of all pairs but `left`, at the poles of that pair.
[[nodiscard]] inline PairNumber otherFactors(const PolePairList& pairs, std::size_t left) noexcept
{
    const PairNumber s = valueAt(pairs[left]);
    PairNumber product{1.0, 0.0, s.spread};
    for (std::size_t j = 0; j < pairs.size(); ++j)
        if (j != left)
            product = product * factorAt(pairs[j], s);
    return product;
}

/// The roots of a polynomial of even degree whose coefficients are not negative, the lowest and highest positive, and
/// whose roots have no positive real part (a passive system), as pairs. After Aberth's iteration the
/// quadratic factors are corrected together (L. Bairstow 1914 in the simultaneous form of Durand and Kerner), which
/// converges quadratically also where the two roots of a pair coincide. [audio]: no allocation, a bounded number of
/// steps.
[[nodiscard]] inline PolePairList findPolePairs(const RealPolynomial& p) noexcept
{
    const std::size_t n = p.degree();
    assert(n % 2 == 0);
    PolePairList pairs = detail::pairRoots(detail::findRoots(p));
    for (int step = 0; step < 4; ++step)
        for (std::size_t k = 0; k < pairs.size(); ++k)
        {
            // The remainder of p over the factor (s - centre)^2 - spread, divided by the other factors.
            const PairNumber change = p.at(valueAt(pairs[k])) / (p.c[n] * otherFactors(pairs, k));
            const double size = pairs[k].slowest();
            if (!(std::abs(change.a) <= 1e-2 * size * size && std::abs(change.b) <= 1e-2 * size))
                continue; // other poles coincide with this pair: the guess is as good as can be
            pairs[k].centre -= 0.5 * change.b;
            pairs[k].spread -= change.a;
        }
    for (PolePair& pair : pairs)
    {
        pair.centre = std::min(pair.centre, 0.0);
        pair.spread = std::min(pair.spread, pair.centre * pair.centre);
    }
    return pairs;
}

} // namespace pacini
