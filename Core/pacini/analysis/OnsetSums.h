#pragma once

// Short sums and inner products, of the few terms that an OnsetFrame or a short filter has.

#include <array>
#include <cstddef>

namespace pacini::detail
{

// Sums run in four fixed lanes: compilers turn them into vector code without changing the order of additions. More
// lanes would leave too much of a frame, which is often 8 to 50 samples long, to the loop for the rest.
using FourSums = std::array<float, 4>;

inline float total(const FourSums& v) noexcept
{
    return (v[0] + v[2]) + (v[1] + v[3]);
}

/// Sum of x[i]^2, i = 0..count-1.
inline float sumOfSquares(const float* x, std::ptrdiff_t count) noexcept
{
    FourSums sum{};
    std::ptrdiff_t i = 0;
    for (; i + 4 <= count; i += 4)
        for (std::size_t l = 0; l < 4; ++l)
            sum[l] += x[i + std::ptrdiff_t(l)] * x[i + std::ptrdiff_t(l)];
    float rest = 0.0f;
    for (; i < count; ++i)
        rest += x[i] * x[i];
    return total(sum) + rest;
}

/// x[0] + ... + x[7].
inline float sumOfEight(const float* x) noexcept
{
    FourSums sum{};
    for (std::size_t l = 0; l < 4; ++l)
        sum[l] = x[l] + x[l + 4];
    return total(sum);
}

/// Sum of (x[i-1] - 2 x[i] + x[i+1])^2, i = 0..count-1.
inline float sumOfSquaredBends(const float* x, std::ptrdiff_t count) noexcept
{
    FourSums sum{};
    std::ptrdiff_t i = 0;
    for (; i + 4 <= count; i += 4)
        for (std::size_t l = 0; l < 4; ++l)
        {
            const float* p = x + i + std::ptrdiff_t(l);
            const float bend = (p[1] - p[0]) - (p[0] - p[-1]);
            sum[l] += bend * bend;
        }
    float rest = 0.0f;
    for (; i < count; ++i)
    {
        const float bend = (x[i + 1] - x[i]) - (x[i] - x[i - 1]);
        rest += bend * bend;
    }
    return total(sum) + rest;
}

/// Sum of a[i] b[i]; `count` is a multiple of 4. For some 16 products faster than dotProduct(), whose eight lanes take
/// longer to add up.
inline float dotOfFours(const float* a, const float* b, std::ptrdiff_t count) noexcept
{
    FourSums sum{};
    for (std::ptrdiff_t i = 0; i < count; i += 4)
        for (std::size_t l = 0; l < 4; ++l)
            sum[l] += a[i + std::ptrdiff_t(l)] * b[i + std::ptrdiff_t(l)];
    return total(sum);
}

} // namespace pacini::detail
