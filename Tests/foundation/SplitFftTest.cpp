#include "support/Catch.h"

#include <pacini/foundation/DotProduct.h>
#include <pacini/foundation/Random.h>
#include <pacini/foundation/SplitFft.h>
#include <pacini/foundation/SplitRealFft.h>

#include <complex>
#include <numbers>
#include <vector>

using namespace pacini;

namespace
{
std::complex<long double> root(std::size_t product, std::size_t n, long double sign)
{
    return std::polar(1.0L, sign * 2.0L * std::numbers::pi_v<long double> * static_cast<long double>(product % n) /
                                static_cast<long double>(n));
}

template <typename Real>
std::vector<Real> noise(std::size_t n, std::uint64_t seed)
{
    Random random(seed);
    std::vector<Real> x(n);
    for (Real& v : x)
        v = static_cast<Real>(random.uniform(-1.0, 1.0));
    return x;
}

/// Largest error of a transform of noise against the definition in long double, relative to the spectrum's RMS.
template <typename Real>
double transformError(std::size_t n, bool inverse)
{
    const auto re = noise<Real>(n, n);
    const auto im = noise<Real>(n, n + 1);
    std::vector<Real> outRe(n), outIm(n);
    SplitFft<Real> fft(n);
    inverse ? fft.inverse(re.data(), im.data(), outRe.data(), outIm.data())
            : fft.forward(re.data(), im.data(), outRe.data(), outIm.data());
    double worst = 0.0;
    for (std::size_t k = 0; k < n; ++k)
    {
        std::complex<long double> sum = 0;
        for (std::size_t m = 0; m < n; ++m)
            sum += std::complex<long double>(re[m], im[m]) * root(k * m, n, inverse ? 1.0L : -1.0L);
        const std::complex<long double> found(outRe[k], outIm[k]);
        worst = std::max(worst, static_cast<double>(std::abs(found - sum)));
    }
    return worst / std::sqrt(static_cast<double>(n));
}
} // namespace

TEST_CASE("Split transform equals the definition summed in long double for every mix of factors", "[foundation]")
{
    for (const std::size_t n :
         {1u,  2u,  3u,  4u,  5u,  6u,   8u,   9u,   10u,  12u,  15u,  16u,  20u,  25u,  27u,  32u,
          45u, 60u, 64u, 75u, 90u, 120u, 128u, 160u, 240u, 256u, 300u, 320u, 360u, 480u, 500u, 512u})
    {
        CAPTURE(n);
        for (const bool inverse : {false, true})
        {
            CHECK(transformError<double>(n, inverse) < 1e-14);
            CHECK(transformError<float>(n, inverse) < 2e-6);
        }
    }
}

TEST_CASE("Split inverse undoes forward up to the size for large transforms", "[foundation]")
{
    for (const std::size_t n : {4096u, 40960u, 36000u, 3125u, 6561u})
    {
        CAPTURE(n);
        const auto re = noise<double>(n, 1);
        const auto im = noise<double>(n, 2);
        std::vector<double> aRe(n), aIm(n), bRe(n), bIm(n);
        SplitFft<double> fft(n);
        fft.forward(re.data(), im.data(), aRe.data(), aIm.data());
        fft.inverse(aRe.data(), aIm.data(), bRe.data(), bIm.data());
        double worst = 0.0;
        for (std::size_t i = 0; i < n; ++i)
            worst = std::max({worst, std::abs(bRe[i] / static_cast<double>(n) - re[i]),
                              std::abs(bIm[i] / static_cast<double>(n) - im[i])});
        CHECK(worst < 1e-14);
    }
}

TEST_CASE("Split real transform equals the definition and its inverse undoes it", "[foundation]")
{
    for (const std::size_t n : {2u, 4u, 6u, 10u, 16u, 30u, 100u, 320u})
    {
        CAPTURE(n);
        const auto x = noise<double>(n, n);
        SplitRealFft<double> fft(n);
        SplitArray<double> spectrum(fft.bins());
        fft.forward(x.data(), spectrum.re.data(), spectrum.im.data());
        for (std::size_t k = 0; k < fft.bins(); ++k)
        {
            std::complex<long double> sum = 0;
            for (std::size_t m = 0; m < n; ++m)
                sum += static_cast<long double>(x[m]) * root(k * m, n, -1.0L);
            CHECK(std::abs(std::complex<double>(sum) - std::complex(spectrum.re[k], spectrum.im[k])) < 1e-12);
        }
        std::vector<double> back(n);
        fft.inverse(spectrum.re.data(), spectrum.im.data(), back.data());
        for (std::size_t i = 0; i < n; ++i)
            CHECK(std::abs(back[i] / static_cast<double>(n) - x[i]) < 1e-14);
    }
}

TEST_CASE("Dot products of every length equal the plain sum", "[foundation]")
{
    const auto a = noise<float>(100, 1);
    const auto b = noise<float>(100, 2);
    double sum = 0.0;
    for (std::size_t n = 0; n < a.size(); ++n)
    {
        CHECK(dotProductIn<double>(a.data(), b.data(), n) == Approx(sum).margin(1e-13));
        CHECK(static_cast<double>(dotProduct(a.data(), b.data(), n)) == Approx(sum).margin(1e-5));
        sum += static_cast<double>(a[n]) * static_cast<double>(b[n]);
    }
}

TEST_CASE("The ends of a real signal's spectrum are real, whatever stood there before", "[foundation]")
{
    for (const std::size_t n : {2u, 4u, 10u, 64u})
    {
        CAPTURE(n);
        SplitRealFft<float> fft(n);
        CHECK(fft.size() == n);
        CHECK(fft.bins() == n / 2 + 1);
        const auto x = noise<float>(n, 3);
        std::vector<float> re(n / 2 + 1, 7.0f), im(n / 2 + 1, 7.0f), back(n);
        fft.forward(x.data(), re.data(), im.data());
        CHECK(im.front() == 0.0f);
        CHECK(im.back() == 0.0f);
        im.front() = im.back() = 5.0f; // they count as 0
        fft.inverse(re.data(), im.data(), back.data());
        for (std::size_t i = 0; i < n; ++i)
            CHECK(back[i] / static_cast<float>(n) == Approx(x[i]).margin(1e-5));
    }
}

TEST_CASE("Roots of unity are right to a few units in the last place at any order", "[foundation]")
{
    for (const std::size_t n : {1u, 2u, 3u, 5u, 16u, 17u, 60u, 65u, 1000u})
    {
        const detail::RootsOfUnity roots(n);
        for (std::size_t k = 0; k < n; ++k)
            REQUIRE(std::abs(roots[k] - std::complex<double>(root(k, n, -1.0L))) < 1e-15);
    }
}

TEST_CASE("Lanes are numbers side by side", "[foundation]")
{
    using Four = Lanes<float, 4>;
    const float numbers[] = {1.0f, -2.0f, 3.0f, 0.5f, 99.0f};
    const auto a = Four::load(numbers);
    const auto b = Four::all(2.0f);
    const auto stored = [](const Four& x)
    {
        std::vector<float> out(5, -1.0f);
        x.store(out.data());
        CHECK(out.back() == -1.0f);
        out.pop_back();
        return out;
    };
    CHECK(stored(a) == std::vector<float>{1.0f, -2.0f, 3.0f, 0.5f});
    CHECK(stored(a + b) == std::vector<float>{3.0f, 0.0f, 5.0f, 2.5f});
    CHECK(stored(a - b) == std::vector<float>{-1.0f, -4.0f, 1.0f, -1.5f});
    CHECK(stored(a * b) == std::vector<float>{2.0f, -4.0f, 6.0f, 1.0f});
    CHECK(stored(-a) == std::vector<float>{-1.0f, 2.0f, -3.0f, -0.5f});
}
