#pragma once

// Dot product, for FIR filters and correlations.

#include <cstddef>

namespace pacini
{

/// sum a[i] b[i], i = 0..n-1, computed in `Sum` (by default the type of the factors; double for long sums of floats).
/// Eight partial sums let the compiler use vector registers without reordering additions behind our back, and keep the
/// rounding error at about n / 8 units in the last place.
template <typename Sum, typename Real>
[[nodiscard]] inline Sum dotProductIn(const Real* a, const Real* b, std::size_t n) noexcept
{
    constexpr std::size_t lanes = 8;
    Sum sums[lanes]{};
    std::size_t i = 0;
    for (; i + lanes <= n; i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane)
            sums[lane] += static_cast<Sum>(a[i + lane]) * static_cast<Sum>(b[i + lane]);
    for (std::size_t width = lanes / 2; width > 0; width /= 2)
        for (std::size_t lane = 0; lane < width; ++lane)
            sums[lane] += sums[lane + width];
    Sum rest = 0;
    for (; i < n; ++i)
        rest += static_cast<Sum>(a[i]) * static_cast<Sum>(b[i]);
    return sums[0] + rest;
}

template <typename Real>
[[nodiscard]] inline Real dotProduct(const Real* a, const Real* b, std::size_t n) noexcept
{
    return dotProductIn<Real>(a, b, n);
}

} // namespace pacini
