#pragma once

// Several dot products at once, for FIR filters whose outputs share their taps.

#include <pacini/foundation/Lanes.h>

#include <array>
#include <cstddef>

namespace pacini
{

/// The dot products of `a` with `count` series that begin `distance` after each other: of each the same sum as
/// dotProduct() gives. One by one, each addition would wait for the one before; here `count` of them go at a time, and
/// `a` is read once.
template <std::size_t count, typename Real>
[[nodiscard]] inline std::array<Real, count> dotProducts(const Real* a, const Real* b, std::size_t distance,
                                                         std::size_t n) noexcept
{
    constexpr std::size_t lanes = 8;
    constexpr std::size_t width = 16 / sizeof(Real);
    using Vector = Lanes<Real, width>;
    Vector sums[count][lanes / width];
    for (auto& series : sums)
        for (Vector& sum : series)
            sum = Vector::all(Real(0));
    std::size_t i = 0;
    for (; i + lanes <= n; i += lanes)
        for (std::size_t v = 0; v < lanes / width; ++v)
        {
            const Vector factor = Vector::load(a + i + v * width);
            for (std::size_t k = 0; k < count; ++k)
                sums[k][v] = sums[k][v] + factor * Vector::load(b + k * distance + i + v * width);
        }
    std::array<Real, count> rest{};
    for (; i < n; ++i)
        for (std::size_t k = 0; k < count; ++k)
            rest[k] += a[i] * b[k * distance + i];
    std::array<Real, count> results;
    for (std::size_t k = 0; k < count; ++k)
    {
        Real parts[lanes];
        for (std::size_t v = 0; v < lanes / width; ++v)
            sums[k][v].store(parts + v * width);
        for (std::size_t half = lanes / 2; half > 0; half /= 2)
            for (std::size_t lane = 0; lane < half; ++lane)
                parts[lane] += parts[lane + half];
        results[k] = parts[0] + rest[k];
    }
    return results;
}

} // namespace pacini
