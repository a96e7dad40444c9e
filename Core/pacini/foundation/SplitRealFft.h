#pragma once

// Fourier transforms of real signals to separate arrays of real and imaginary parts.

#include <pacini/foundation/SplitFft.h>

#include <cassert>
#include <cstddef>
#include <vector>

namespace pacini
{

/// Complex numbers as two arrays.
template <typename Real>
struct SplitArray
{
    std::vector<Real> re;
    std::vector<Real> im;

    SplitArray() = default;
    explicit SplitArray(std::size_t size) : re(size), im(size) {}
};

/// Transform of `size` real samples to the bins 0 .. size / 2 by one complex transform of half the size: even samples
/// as real parts, odd ones as imaginary parts, taken apart by symmetry. One object serves one thread at a time.
template <typename Real>
class SplitRealFft
{
public:
    /// Asserts that `transformSize` is even and has no prime factor above 5.
    explicit SplitRealFft(std::size_t transformSize)
        : n(transformSize), half(n / 2), plan(half), twiddles(half), packed(half), transformed(half)
    {
        assert(n % 2 == 0);
        const detail::RootsOfUnity roots(n);
        for (std::size_t k = 0; k < half; ++k)
        {
            twiddles.re[k] = static_cast<Real>(roots[k].real());
            twiddles.im[k] = static_cast<Real>(roots[k].imag());
        }
    }

    [[nodiscard]] std::size_t size() const noexcept { return n; }
    [[nodiscard]] std::size_t bins() const noexcept { return half + 1; }

    /// out[k] = sum in[m] exp(-2 pi i k m / size), k = 0 .. size / 2.
    void forward(const Real* in, Real* outRe, Real* outIm) noexcept
    {
        for (std::size_t i = 0; i < half; ++i)
        {
            packed.re[i] = in[2 * i];
            packed.im[i] = in[2 * i + 1];
        }
        const Real* re = transformed.re.data();
        const Real* im = transformed.im.data();
        plan.forward(packed.re.data(), packed.im.data(), transformed.re.data(), transformed.im.data());
        outRe[0] = re[0] + im[0];
        outRe[half] = re[0] - im[0];
        outIm[0] = outIm[half] = Real(0);
        for (std::size_t k = 1; k < half; ++k)
        {
            const Real evenRe = (re[k] + re[half - k]) * Real(0.5);
            const Real evenIm = (im[k] - im[half - k]) * Real(0.5);
            const Real oddRe = (im[k] + im[half - k]) * Real(0.5);
            const Real oddIm = (re[half - k] - re[k]) * Real(0.5);
            outRe[k] = evenRe + twiddles.re[k] * oddRe - twiddles.im[k] * oddIm;
            outIm[k] = evenIm + twiddles.re[k] * oddIm + twiddles.im[k] * oddRe;
        }
    }

    /// The signal of a real signal's spectrum, unscaled: inverse(forward(x)) = size * x. The imaginary parts of the
    /// first and the last bin count as 0.
    void inverse(const Real* inRe, const Real* inIm, Real* out) noexcept
    {
        packed.re[0] = inRe[0] + inRe[half];
        packed.im[0] = inRe[0] - inRe[half];
        for (std::size_t k = 1; k < half; ++k)
        {
            const Real sumRe = inRe[k] + inRe[half - k];
            const Real sumIm = inIm[k] - inIm[half - k];
            const Real differenceRe = inRe[k] - inRe[half - k];
            const Real differenceIm = inIm[k] + inIm[half - k];
            // The difference turned back by the twiddle factor is the spectrum of the odd samples.
            const Real oddRe = twiddles.re[k] * differenceRe + twiddles.im[k] * differenceIm;
            const Real oddIm = twiddles.re[k] * differenceIm - twiddles.im[k] * differenceRe;
            packed.re[k] = sumRe - oddIm;
            packed.im[k] = sumIm + oddRe;
        }
        plan.inverse(packed.re.data(), packed.im.data(), transformed.re.data(), transformed.im.data());
        for (std::size_t i = 0; i < half; ++i)
        {
            out[2 * i] = transformed.re[i];
            out[2 * i + 1] = transformed.im[i];
        }
    }

private:
    std::size_t n;
    std::size_t half;
    SplitFft<Real> plan;
    SplitArray<Real> twiddles;
    SplitArray<Real> packed;
    SplitArray<Real> transformed;
};

} // namespace pacini
