#include "support/Catch.h"

#include <pacini/foundation/Fft.h>
#include <pacini/foundation/Random.h>

#include <numbers>

using namespace pacini;

namespace
{
/// Real and imaginary parts within +-1.
std::vector<std::complex<double>> complexNoise(std::size_t n, std::uint64_t seed)
{
    Random random(seed);
    std::vector<std::complex<double>> x(n);
    for (auto& v : x)
        v = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    return x;
}
} // namespace

TEST_CASE("Real transform equals the definition summed in long double", "[foundation]")
{
    for (std::size_t n : {2u, 6u, 16u, 30u, 100u})
    {
        Random random(n);
        std::vector<double> x(n);
        for (double& v : x)
            v = random.uniform(-1.0, 1.0);
        RealFft<double> fft(n);
        std::vector<std::complex<double>> spectrum(fft.bins());
        fft.forward(x, spectrum);
        for (std::size_t k = 0; k < fft.bins(); ++k)
        {
            std::complex<long double> sum = 0;
            for (std::size_t m = 0; m < n; ++m)
                sum += static_cast<long double>(x[m]) *
                       std::polar(1.0L, -2.0L * std::numbers::pi_v<long double> * static_cast<long double>(k * m % n) /
                                            static_cast<long double>(n));
            CHECK(std::abs(std::complex<double>(sum) - spectrum[k]) < 1e-12);
        }
    }
}

TEST_CASE("Complex inverse undoes forward up to the size", "[foundation]")
{
    const std::size_t n = 60;
    ComplexFft<double> fft(n);
    const auto x = complexNoise(n, 3);
    std::vector<std::complex<double>> y(n), z(n);
    fft.forward(x, y);
    fft.inverse(y, z);
    for (std::size_t i = 0; i < n; ++i)
        CHECK(std::abs(z[i] / static_cast<double>(n) - x[i]) < 1e-14);
}

TEST_CASE("Fast transform sizes are even, large enough and smooth", "[foundation]")
{
    for (std::size_t n = 1; n < 3000; n += 7)
    {
        auto size = nextFastFftSize(n);
        CHECK(size >= n);
        CHECK(size % 2 == 0);
        CHECK(size <= 2 * n + 2);
        for (std::size_t p : {2u, 3u, 5u})
            while (size % p == 0)
                size /= p;
        CHECK(size == 1);
    }
}

TEST_CASE("A fast transform size is the smallest that there is", "[foundation]")
{
    const auto isFast = [](std::size_t n)
    {
        if (n % 2 != 0)
            return false;
        for (const std::size_t p : {2u, 3u, 5u})
            while (n % p == 0)
                n /= p;
        return n == 1;
    };
    std::size_t expected = 2;
    for (std::size_t n = 0; n < 5000; ++n)
    {
        while (expected < n || !isFast(expected))
            ++expected;
        REQUIRE(nextFastFftSize(n) == expected);
    }
}

TEST_CASE("Transforms know their sizes, and complex ones equal the definition in both directions", "[foundation]")
{
    const std::size_t n = 12;
    ComplexFft<double> fft(n);
    CHECK(fft.size() == n);
    RealFft<float> real(n);
    CHECK(real.size() == n);
    CHECK(real.bins() == n / 2 + 1);
    const auto x = complexNoise(n, 8);
    std::vector<std::complex<double>> forward(n), inverse(n);
    fft.forward(x, forward);
    fft.inverse(x, inverse);
    for (std::size_t k = 0; k < n; ++k)
    {
        std::complex<double> down = 0.0, up = 0.0;
        for (std::size_t m = 0; m < n; ++m)
        {
            const double turn = 2.0 * std::numbers::pi * static_cast<double>(k * m % n) / static_cast<double>(n);
            down += x[m] * std::polar(1.0, -turn);
            up += x[m] * std::polar(1.0, turn);
        }
        CHECK(std::abs(forward[k] - down) < 1e-14);
        CHECK(std::abs(inverse[k] - up) < 1e-14);
    }
}
