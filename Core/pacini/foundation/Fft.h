#pragma once

// Fourier transforms of any size on kissfft. Plans allocate; transforms do not.

#include <kissfft.hh>

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// The smallest n >= `atLeast` whose only prime factors are 2, 3 and 5, and which is even.
[[nodiscard]] inline std::size_t nextFastFftSize(std::size_t atLeast)
{
    std::size_t best = 2;
    while (best < atLeast)
        best *= 2;
    for (std::size_t five = 1; five < best; five *= 5)
        for (std::size_t three = five; three < best; three *= 3)
            for (std::size_t n = three * 2; n < best; n *= 2)
                if (n >= atLeast)
                    best = n;
    return best;
}

/// Complex transform of fixed size. Forward and inverse are both unscaled: inverse(forward(x)) = size * x.
/// Not thread-safe for concurrent use of one object; [any] thread.
template <typename Real>
class ComplexFft
{
public:
    explicit ComplexFft(std::size_t size) : n(size), forwardPlan(size, false), inversePlan(size, true) {}

    [[nodiscard]] std::size_t size() const noexcept { return n; }

    /// out[k] = sum in[m] exp(-2 pi i k m / size); both spans have `size` elements and do not overlap.
    void forward(std::span<const std::complex<Real>> in, std::span<std::complex<Real>> out) const
    {
        forwardPlan.transform(in.data(), out.data());
    }

    /// out[m] = sum in[k] exp(+2 pi i k m / size), unscaled.
    void inverse(std::span<const std::complex<Real>> in, std::span<std::complex<Real>> out) const
    {
        inversePlan.transform(in.data(), out.data());
    }

private:
    std::size_t n;
    kissfft<Real> forwardPlan;
    kissfft<Real> inversePlan;
};

/// Forward transform of real input of even size, by one complex transform of half the size.
template <typename Real>
class RealFft
{
public:
    /// `size` must be even and at least 2.
    explicit RealFft(std::size_t size)
        : n(size), half(size / 2), plan(size / 2, false), packed(size / 2), twiddles(size / 2)
    {
        const double step = -2.0 * 3.14159265358979323846 / static_cast<double>(size);
        for (std::size_t k = 0; k < half; ++k)
        {
            const double angle = step * static_cast<double>(k);
            twiddles[k] = {static_cast<Real>(std::cos(angle)), static_cast<Real>(std::sin(angle))};
        }
    }

    [[nodiscard]] std::size_t size() const noexcept { return n; }
    [[nodiscard]] std::size_t bins() const noexcept { return half + 1; }

    /// out[k], k = 0..size/2, of `size` real samples.
    void forward(std::span<const Real> in, std::span<std::complex<Real>> out)
    {
        // Even samples as real parts, odd ones as imaginary parts; then split by symmetry.
        const auto* pairs = reinterpret_cast<const std::complex<Real>*>(in.data());
        plan.transform(pairs, packed.data());
        out[0] = {packed[0].real() + packed[0].imag(), Real(0)};
        out[half] = {packed[0].real() - packed[0].imag(), Real(0)};
        for (std::size_t k = 1; k < half; ++k)
        {
            const auto a = packed[k];
            const auto b = packed[half - k];
            const Real evenRe = (a.real() + b.real()) * Real(0.5);
            const Real evenIm = (a.imag() - b.imag()) * Real(0.5);
            const Real oddRe = (a.imag() + b.imag()) * Real(0.5);
            const Real oddIm = (b.real() - a.real()) * Real(0.5);
            const auto w = twiddles[k];
            out[k] = {evenRe + w.real() * oddRe - w.imag() * oddIm, evenIm + w.real() * oddIm + w.imag() * oddRe};
        }
    }

private:
    std::size_t n;
    std::size_t half;
    kissfft<Real> plan;
    std::vector<std::complex<Real>> packed;
    std::vector<std::complex<Real>> twiddles;
};

} // namespace pacini
