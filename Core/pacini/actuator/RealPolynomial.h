#pragma once

// Polynomials of small degree.

#include <array>
#include <cassert>
#include <cstddef>

namespace pacini
{

/// c[0] + c[1] s + ... + c[6] s^6.
struct RealPolynomial
{
    static constexpr std::size_t maxDegree = 6;
    std::array<double, maxDegree + 1> c{};

    /// The polynomial s.
    [[nodiscard]] static RealPolynomial identity() noexcept
    {
        RealPolynomial p;
        p.c[1] = 1.0;
        return p;
    }

    /// The index of the highest coefficient that is not 0.
    [[nodiscard]] std::size_t degree() const noexcept
    {
        std::size_t n = maxDegree;
        while (n > 0 && c[n] == 0.0)
            --n;
        return n;
    }

    /// The value at x, of any type with sums and products, by Horner's rule.
    template <typename S>
    [[nodiscard]] S at(const S& x) const noexcept
    {
        S value = 0.0 * x + c[maxDegree];
        for (std::size_t i = maxDegree; i-- > 0;)
            value = value * x + c[i];
        return value;
    }

    [[nodiscard]] RealPolynomial derivative() const noexcept
    {
        RealPolynomial p;
        for (std::size_t i = 1; i <= maxDegree; ++i)
            p.c[i - 1] = static_cast<double>(i) * c[i];
        return p;
    }

    friend RealPolynomial operator+(RealPolynomial p, const RealPolynomial& q) noexcept
    {
        for (std::size_t i = 0; i <= maxDegree; ++i)
            p.c[i] += q.c[i];
        return p;
    }
    friend RealPolynomial operator+(RealPolynomial p, double constant) noexcept
    {
        p.c[0] += constant;
        return p;
    }
    friend RealPolynomial operator*(double factor, RealPolynomial p) noexcept
    {
        for (double& v : p.c)
            v *= factor;
        return p;
    }
    /// The degrees together must not exceed maxDegree.
    friend RealPolynomial operator*(const RealPolynomial& p, const RealPolynomial& q) noexcept
    {
        assert(p.degree() + q.degree() <= maxDegree);
        RealPolynomial product;
        for (std::size_t i = 0; i <= maxDegree; ++i)
            for (std::size_t j = 0; i + j <= maxDegree; ++j)
                product.c[i + j] += p.c[i] * q.c[j];
        return product;
    }
};

} // namespace pacini
