#pragma once

// Least-squares refit: the best values for vertices whose times are already chosen.

#include <pacini/simplify/HatBasis.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace pacini
{

/// Parameters of the refit.
struct RefitParams
{
    double lowest = -std::numeric_limits<double>::infinity();  ///< no value falls below this, e.g. 0 for amplitudes
    double maxError = std::numeric_limits<double>::infinity(); ///< no dense point may end up further away than this
};

namespace detail
{

/// The normal equations of the hat basis: a symmetric positive definite tridiagonal system.
struct HatSystem
{
    std::vector<double> diagonal, beside, right;

    explicit HatSystem(std::size_t n) : diagonal(n, 0.0), beside(n, 0.0), right(n, 0.0) {}

    void add(const HatPlace& place, double value, double weight) noexcept
    {
        const double a = place.fraction;
        const double b = 1.0 - a;
        diagonal[place.left] += weight * b * b;
        right[place.left] += weight * b * value;
        if (a == 0.0)
            return;
        beside[place.left] += weight * a * b;
        diagonal[place.left + 1] += weight * a * a;
        right[place.left + 1] += weight * a * value;
    }

    /// Solves for all vertices that are not `fixed`; those keep their value in x. Elimination without pivoting is
    /// stable for positive definite systems.
    void solve(std::vector<double>& x, const std::vector<bool>& fixed) const
    {
        const std::size_t n = diagonal.size();
        std::vector<double> d(n), r(n);
        for (std::size_t k = 0; k < n; ++k)
        {
            d[k] = fixed[k] ? 1.0 : diagonal[k];
            r[k] = fixed[k] ? x[k] : right[k];
            if (k == 0 || fixed[k])
                continue;
            if (fixed[k - 1])
            {
                r[k] -= beside[k - 1] * x[k - 1];
                continue;
            }
            const double factor = beside[k - 1] / d[k - 1];
            d[k] -= factor * beside[k - 1];
            r[k] -= factor * r[k - 1];
        }
        for (std::size_t k = n; k-- > 0;)
            if (!fixed[k])
                x[k] = (r[k] - (k + 1 < n ? beside[k] * x[k + 1] : 0.0)) / d[k];
    }
};

/// The largest step from `from` to `to` (0 to 1) that keeps every dense point within `maxError`, as `from` does.
template <typename Dense>
[[nodiscard]] double largestStep(const Dense& dense, std::span<const Breakpoint> from, std::span<const Breakpoint> to,
                                 double maxError)
{
    double step = 1.0;
    forEachPlace(dense, from,
                 [&](std::size_t m, const HatPlace& place)
                 {
                     const double e0 = place.of(from) - dense[m].value;
                     const double e1 = place.of(to) - dense[m].value;
                     if (std::abs(e1) > maxError)
                         step = std::min(step, std::max(0.0, (std::copysign(maxError, e1) - e0) / (e1 - e0)));
                 });
    return step;
}

} // namespace detail

/// The curve with the times of `vertices` (in order) whose values have the least weighted squared vertical error at the
/// points of `dense`: least squares in the basis of hat functions, whose normal equations are tridiagonal (de Boor, "A
/// Practical Guide to Splines", ch. XIV, for degree 1). O(n + m). `weightOf(m)` is the weight of point m, 0 or
/// more. A vertex that no weighted point sees keeps its value: a ridge of 1e-9 pulls to the old values. Values that
/// would fall below params.lowest are fixed there and the others solved again (an active set that only grows). With
/// params.maxError the values go only as far from the old ones towards the best ones as no point's error passes it,
/// given that the old ones hold it. Steps stay steps. `dense` is a span of points, or what is indexed like one.
template <typename Dense, typename WeightOf>
[[nodiscard]] Curve refitTo(const Dense& dense, std::span<const Breakpoint> vertices, WeightOf weightOf,
                            const RefitParams& params)
{
    Curve curve(vertices.begin(), vertices.end());
    if (dense.size() == 0 || vertices.empty())
        return curve;

    constexpr double ridge = 1e-9; // of one point's weight: no visible bias, but never singular
    double largestWeight = 0.0;
    for (std::size_t m = 0; m < dense.size(); ++m)
        largestWeight = std::max(largestWeight, weightOf(m));
    if (largestWeight <= 0.0)
        return curve;
    detail::HatSystem system(vertices.size());
    std::vector<double> x(vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k)
    {
        x[k] = vertices[k].value;
        system.add({k, 0.0}, x[k], ridge * largestWeight);
    }
    forEachPlace(dense, vertices,
                 [&](std::size_t m, const HatPlace& place) { system.add(place, dense[m].value, weightOf(m)); });

    std::vector<bool> fixed(vertices.size(), false);
    for (bool again = true; again;)
    {
        system.solve(x, fixed);
        again = false;
        for (std::size_t k = 0; k < x.size(); ++k)
        {
            if (!(x[k] < params.lowest))
                continue;
            x[k] = params.lowest;
            fixed[k] = true;
            again = true;
        }
    }

    Curve best = curve;
    for (std::size_t k = 0; k < x.size(); ++k)
        best[k].value = x[k];
    if (params.maxError == std::numeric_limits<double>::infinity())
        return best;
    const double step = detail::largestStep(dense, vertices, best, params.maxError);
    for (std::size_t k = 0; k < x.size(); ++k)
        curve[k].value += step * (best[k].value - curve[k].value);
    return curve;
}

/// The same with weights, 0 or more, in a span that is empty (all 1) or as long as `dense`.
[[nodiscard]] inline Curve refit(std::span<const Breakpoint> dense, std::span<const Breakpoint> vertices,
                                 std::span<const double> weights = {}, const RefitParams& params = {})
{
    assert(weights.empty() || weights.size() == dense.size());
    return refitTo(
        dense, vertices, [weights](std::size_t m) { return weights.empty() ? 1.0 : weights[m]; }, params);
}

} // namespace pacini
