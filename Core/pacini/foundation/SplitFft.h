#pragma once

// Fast Fourier transforms on separate arrays of real and imaginary parts, in a form that compilers turn into vector
// code.

#include <pacini/foundation/Lanes.h>

#include <array>
#include <cassert>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <type_traits>
#include <vector>

namespace pacini
{

namespace detail
{
/// A complex number whose parts are Lanes. (Products of std::complex are checked for infinities, which keeps them out
/// of vector registers.)
template <typename Vector>
struct SplitComplex
{
    Vector re;
    Vector im;

    friend SplitComplex operator+(const SplitComplex& a, const SplitComplex& b) noexcept
    {
        return {a.re + b.re, a.im + b.im};
    }
    friend SplitComplex operator-(const SplitComplex& a, const SplitComplex& b) noexcept
    {
        return {a.re - b.re, a.im - b.im};
    }
    friend SplitComplex operator*(const Vector& k, const SplitComplex& a) noexcept { return {k * a.re, k * a.im}; }
    friend SplitComplex operator*(const SplitComplex& a, const SplitComplex& b) noexcept
    {
        return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    }
    [[nodiscard]] SplitComplex timesMinusI() const noexcept { return {im, -re}; }
};

/// Fourier transforms of 2, 3, 4 and 5 numbers in place.
template <typename Real, typename Vector>
struct SmallTransform
{
    using Number = SplitComplex<Vector>;

    static void transform(Number (&x)[2]) noexcept
    {
        const Number difference = x[0] - x[1];
        x[0] = x[0] + x[1];
        x[1] = difference;
    }
    static void transform(Number (&x)[3]) noexcept
    {
        const Number sum = x[1] + x[2];
        const Number middle = x[0] - constant(0.5) * sum;
        const Number side = (constant(std::numbers::sqrt3 / 2.0) * (x[1] - x[2])).timesMinusI();
        x[0] = x[0] + sum;
        x[1] = middle + side;
        x[2] = middle - side;
    }
    static void transform(Number (&x)[4]) noexcept
    {
        const Number even = x[0] + x[2];
        const Number odd = x[1] + x[3];
        const Number evenDifference = x[0] - x[2];
        const Number oddDifference = (x[1] - x[3]).timesMinusI();
        x[0] = even + odd;
        x[1] = evenDifference + oddDifference;
        x[2] = even - odd;
        x[3] = evenDifference - oddDifference;
    }
    static void transform(Number (&x)[5]) noexcept
    {
        const Vector cosine1 = constant(0.30901699437494742410);  // cos(2 pi / 5)
        const Vector cosine2 = constant(-0.80901699437494742410); // cos(4 pi / 5)
        const Vector sine1 = constant(0.95105651629515357212);    // sin(2 pi / 5)
        const Vector sine2 = constant(0.58778525229247312917);    // sin(4 pi / 5)
        const Number outer = x[1] + x[4];
        const Number inner = x[2] + x[3];
        const Number outerDifference = x[1] - x[4];
        const Number innerDifference = x[2] - x[3];
        const Number middle1 = x[0] + cosine1 * outer + cosine2 * inner;
        const Number middle2 = x[0] + cosine2 * outer + cosine1 * inner;
        const Number side1 = (sine1 * outerDifference + sine2 * innerDifference).timesMinusI();
        const Number side2 = (sine2 * outerDifference - sine1 * innerDifference).timesMinusI();
        x[0] = x[0] + outer + inner;
        x[1] = middle1 + side1;
        x[2] = middle2 + side2;
        x[3] = middle2 - side2;
        x[4] = middle1 - side1;
    }

private:
    static Vector constant(double value) noexcept { return Vector::all(static_cast<Real>(value)); }
};

/// The n-th roots of unity as products of two short tables: a sine and a cosine for each would take longer than a
/// transform.
class RootsOfUnity
{
public:
    explicit RootsOfUnity(std::size_t order)
    {
        while ((std::size_t(1) << (2 * bits)) < order)
            ++bits;
        const auto root = [order](std::size_t k)
        {
            return std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(order));
        };
        for (std::size_t k = 0; k < (std::size_t(1) << bits); ++k)
            fine.push_back(root(k));
        for (std::size_t k = 0; k < order; k += std::size_t(1) << bits)
            coarse.push_back(root(k));
    }

    /// exp(-2 pi i k / order), k = 0 .. order - 1.
    [[nodiscard]] std::complex<double> operator[](std::size_t k) const noexcept
    {
        const auto a = coarse[k >> bits];
        const auto b = fine[k & ((std::size_t(1) << bits) - 1)];
        return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
    }

private:
    std::size_t bits = 0;
    std::vector<std::complex<double>> fine;
    std::vector<std::complex<double>> coarse;
};
} // namespace detail

/// Complex transform of a fixed size whose prime factors are 2, 3 and 5. Self-sorting decimation in frequency (the
/// Stockham algorithm; C. Van Loan, "Computational Frameworks for the Fast Fourier Transform", 1992, section 1.7) with
/// radix 4 first: the inner loops run over neighbouring numbers with one twiddle factor, so they need no shuffles in
/// vector registers. Several times as fast as ComplexFft, in planning too. One object serves one thread at a time.
template <typename Real>
class SplitFft
{
public:
    /// Asserts that `transformSize` is at least 1 and has no prime factor above 5.
    explicit SplitFft(std::size_t transformSize) : n(transformSize), workRe(n), workIm(n)
    {
        const detail::RootsOfUnity roots(n);
        std::size_t rest = n;
        std::size_t stride = 1;
        for (const std::size_t radix : {4u, 2u, 3u, 5u})
            for (; rest % radix == 0; rest /= radix, stride *= radix)
            {
                const std::size_t blocks = rest / radix;
                const std::size_t first = twiddlesRe.size();
                passes.push_back({radix, blocks, stride, first});
                twiddlesRe.resize(first + blocks * (radix - 1));
                twiddlesIm.resize(twiddlesRe.size());
                for (std::size_t j = 1; j < radix; ++j)
                    for (std::size_t p = 0; p < blocks; ++p)
                    {
                        const auto w = roots[p * j * stride];
                        twiddlesRe[first + (j - 1) * blocks + p] = static_cast<Real>(w.real());
                        twiddlesIm[first + (j - 1) * blocks + p] = static_cast<Real>(w.imag());
                    }
            }
        assert(rest == 1);
    }

    [[nodiscard]] std::size_t size() const noexcept { return n; }

    /// out[k] = sum in[m] exp(-2 pi i k m / size). All arrays hold size() numbers; in and out do not overlap.
    void forward(const Real* inRe, const Real* inIm, Real* outRe, Real* outIm) noexcept
    {
        if (passes.empty())
        {
            outRe[0] = inRe[0];
            outIm[0] = inIm[0];
        }
        for (std::size_t i = 0; i < passes.size(); ++i)
        {
            const bool toOut = (passes.size() - i) % 2 == 1; // so that the last pass ends there
            Real* toRe = toOut ? outRe : workRe.data();
            Real* toIm = toOut ? outIm : workIm.data();
            run(passes[i], inRe, inIm, toRe, toIm);
            inRe = toRe;
            inIm = toIm;
        }
    }

    /// out[m] = sum in[k] exp(+2 pi i k m / size), unscaled: the forward transform with the parts exchanged.
    void inverse(const Real* inRe, const Real* inIm, Real* outRe, Real* outIm) noexcept
    {
        forward(inIm, inRe, outIm, outRe);
    }

private:
    static constexpr std::size_t lanes = 16 / sizeof(Real); // the registers that every 64-bit processor has

    /// One step: `blocks` small transforms for each of `stride` interleaved sequences.
    struct Pass
    {
        std::size_t radix;
        std::size_t blocks;
        std::size_t stride;
        std::size_t firstTwiddle; // blocks times w, then blocks times w^2, ...
    };

    void run(const Pass& pass, const Real* inRe, const Real* inIm, Real* outRe, Real* outIm) const noexcept
    {
        if (pass.stride == 1 && pass.radix == 4 && pass.blocks % lanes == 0)
            return runFirst(pass, inRe, inIm, outRe, outIm);
        const auto with = [&]<std::size_t radix>()
        {
            if (pass.stride % lanes == 0)
                runLanes<radix, lanes>(pass, inRe, inIm, outRe, outIm);
            else
                runLanes<radix, 1>(pass, inRe, inIm, outRe, outIm);
        };
        switch (pass.radix)
        {
        case 2:
            return with.template operator()<2>();
        case 3:
            return with.template operator()<3>();
        case 4:
            return with.template operator()<4>();
        default:
            return with.template operator()<5>();
        }
    }

    /// Neighbouring lanes are neighbouring sequences; all use the same twiddle factors.
    template <std::size_t radix, std::size_t width>
    void runLanes(const Pass& pass, const Real* __restrict inRe, const Real* __restrict inIm, Real* __restrict outRe,
                  Real* __restrict outIm) const noexcept
    {
        using Vector = Lanes<Real, width>;
        using Number = detail::SplitComplex<Vector>;
        const std::size_t s = pass.stride;
        const std::size_t jump = s * pass.blocks;
        for (std::size_t p = 0; p < pass.blocks; ++p)
        {
            Number w[radix];
            for (std::size_t j = 1; j < radix; ++j)
            {
                const std::size_t at = pass.firstTwiddle + (j - 1) * pass.blocks + p;
                w[j] = {Vector::all(twiddlesRe[at]), Vector::all(twiddlesIm[at])};
            }
            for (std::size_t q = 0; q < s; q += width)
            {
                const std::size_t from = s * p + q;
                const std::size_t to = radix * s * p + q;
                Number x[radix];
                for (std::size_t j = 0; j < radix; ++j)
                    x[j] = {Vector::load(inRe + from + j * jump), Vector::load(inIm + from + j * jump)};
                detail::SmallTransform<Real, Vector>::transform(x);
                for (std::size_t j = 1; j < radix; ++j)
                    x[j] = w[j] * x[j];
                for (std::size_t j = 0; j < radix; ++j)
                {
                    x[j].re.store(outRe + to + j * s);
                    x[j].im.store(outIm + to + j * s);
                }
            }
        }
    }

    /// The first pass has a single sequence: neighbouring lanes are neighbouring blocks, and the results are
    /// transposed.
    void runFirst(const Pass& pass, const Real* __restrict inRe, const Real* __restrict inIm, Real* __restrict outRe,
                  Real* __restrict outIm) const noexcept
    {
        using Vector = Lanes<Real, lanes>;
        using Number = detail::SplitComplex<Vector>;
        const std::size_t m = pass.blocks;
        const Real* wRe = twiddlesRe.data() + pass.firstTwiddle;
        const Real* wIm = twiddlesIm.data() + pass.firstTwiddle;
        for (std::size_t p = 0; p < m; p += lanes)
        {
            Number x[4];
            for (std::size_t j = 0; j < 4; ++j)
                x[j] = {Vector::load(inRe + p + j * m), Vector::load(inIm + p + j * m)};
            detail::SmallTransform<Real, Vector>::transform(x);
            for (std::size_t j = 1; j < 4; ++j)
                x[j] = Number{Vector::load(wRe + (j - 1) * m + p), Vector::load(wIm + (j - 1) * m + p)} * x[j];
            for (std::size_t lane = 0; lane < lanes; ++lane)
                for (std::size_t j = 0; j < 4; ++j)
                {
                    outRe[4 * (p + lane) + j] = x[j].re.values[lane];
                    outIm[4 * (p + lane) + j] = x[j].im.values[lane];
                }
        }
    }

    std::size_t n;
    std::vector<Pass> passes;
    std::vector<Real> twiddlesRe;
    std::vector<Real> twiddlesIm;
    std::vector<Real> workRe;
    std::vector<Real> workIm;
};

} // namespace pacini
