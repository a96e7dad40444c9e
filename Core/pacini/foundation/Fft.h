#pragma once

// Fourier transforms of interleaved complex numbers (std::complex), on SplitFft.

#include <pacini/foundation/SplitRealFft.h>

#include <cassert>
#include <complex>
#include <cstddef>
#include <span>

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

/// Complex transform of a fixed size without prime factors above 5. Forward and inverse are both unscaled:
/// inverse(forward(x)) = size * x. Only planning allocates; one object serves one thread at a time.
template <typename Real>
class ComplexFft
{
public:
    explicit ComplexFft(std::size_t size) : plan(size), from(size), to(size) {}

    [[nodiscard]] std::size_t size() const noexcept { return plan.size(); }

    /// out[k] = sum in[m] exp(-2 pi i k m / size); both spans have `size` elements.
    void forward(std::span<const std::complex<Real>> in, std::span<std::complex<Real>> out) noexcept
    {
        split(in);
        plan.forward(from.re.data(), from.im.data(), to.re.data(), to.im.data());
        join(out);
    }

    /// out[m] = sum in[k] exp(+2 pi i k m / size), unscaled.
    void inverse(std::span<const std::complex<Real>> in, std::span<std::complex<Real>> out) noexcept
    {
        split(in);
        plan.inverse(from.re.data(), from.im.data(), to.re.data(), to.im.data());
        join(out);
    }

private:
    void split(std::span<const std::complex<Real>> in) noexcept
    {
        assert(in.size() == size());
        for (std::size_t i = 0; i < in.size(); ++i)
        {
            from.re[i] = in[i].real();
            from.im[i] = in[i].imag();
        }
    }
    void join(std::span<std::complex<Real>> out) const noexcept
    {
        assert(out.size() == size());
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = {to.re[i], to.im[i]};
    }

    SplitFft<Real> plan;
    SplitArray<Real> from;
    SplitArray<Real> to;
};

/// Forward transform of real input of even size without prime factors above 5.
template <typename Real>
class RealFft
{
public:
    explicit RealFft(std::size_t size) : plan(size), spectrum(plan.bins()) {}

    [[nodiscard]] std::size_t size() const noexcept { return plan.size(); }
    [[nodiscard]] std::size_t bins() const noexcept { return plan.bins(); }

    /// out[k], k = 0..size/2, of `size` real samples.
    void forward(std::span<const Real> in, std::span<std::complex<Real>> out) noexcept
    {
        assert(in.size() == size() && out.size() == bins());
        plan.forward(in.data(), spectrum.re.data(), spectrum.im.data());
        for (std::size_t k = 0; k < out.size(); ++k)
            out[k] = {spectrum.re[k], spectrum.im[k]};
    }

private:
    SplitRealFft<Real> plan;
    SplitArray<Real> spectrum;
};

} // namespace pacini
