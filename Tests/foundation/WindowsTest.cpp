#include "support/Catch.h"

#include <pacini/foundation/Windows.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

using namespace pacini;

namespace
{
/// I0(x) = 1 / pi times the integral of exp(x cos t) over half a turn: the midpoint rule of a smooth periodic function
/// is exact soon.
double besselByIntegral(double x)
{
    double sum = 0.0;
    const int steps = 200;
    for (int i = 0; i < steps; ++i)
        sum += std::exp(x * std::cos(std::numbers::pi * (i + 0.5) / steps));
    return sum / steps;
}
} // namespace

TEST_CASE("The periodic Hann window is a raised cosine that ends before it repeats", "[foundation]")
{
    CHECK(hannPeriodic(0).empty());
    CHECK(hannPeriodic(1) == std::vector<double>{0.0});
    for (const std::size_t n : {2u, 4u, 5u, 64u})
    {
        const auto w = hannPeriodic(n);
        REQUIRE(w.size() == n);
        for (std::size_t i = 0; i < n; ++i)
        {
            const double s = std::sin(std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
            CHECK(w[i] == Approx(s * s).margin(1e-15));
        }
    }
}

TEST_CASE("The Bessel function of order zero equals its integral", "[foundation]")
{
    CHECK(besselI0(0.0) == 1.0);
    for (const double x : {1e-9, 0.1, 1.0, 2.5, 5.0, 9.0, 20.0, 40.0})
    {
        CAPTURE(x);
        CHECK(besselI0(x) == Approx(besselByIntegral(x)).epsilon(1e-14));
        CHECK(besselI0(-x) == besselI0(x));
    }
}

TEST_CASE("Kaiser's shape parameter has his three pieces", "[foundation]")
{
    for (const double a : {-5.0, 0.0, 20.0, 20.999})
        CHECK(kaiserBeta(a) == 0.0);
    for (const double a : {21.0, 25.0, 30.0, 40.0, 50.0})
        CHECK(kaiserBeta(a) == Approx(0.5842 * std::pow(a - 21.0, 0.4) + 0.07886 * (a - 21.0)).margin(1e-15));
    CHECK(kaiserBeta(21.0) == 0.0);
    CHECK(kaiserBeta(30.0) == Approx(2.1166).epsilon(1e-3)); // his table: 30 dB, 2.12; 50 dB, 4.54; 60 dB, 5.65
    CHECK(kaiserBeta(50.0) == Approx(4.5335).epsilon(1e-3));
    CHECK(kaiserBeta(50.0) != 0.1102 * (50.0 - 8.7));
    CHECK(kaiserBeta(50.001) == Approx(0.1102 * (50.001 - 8.7)).epsilon(1e-15));
    CHECK(kaiserBeta(60.0) == Approx(5.65326).epsilon(1e-12));
    CHECK(kaiserBeta(100.0) == Approx(10.06126).epsilon(1e-12));
}

TEST_CASE("The Kaiser window is the ratio of two Bessel functions, and 0 outside", "[foundation]")
{
    for (const double beta : {0.0, 0.5, 2.0, 5.65326, 7.85726, 14.0})
    {
        CAPTURE(beta);
        const KaiserWindow window(beta);
        for (const double u : {-1.0, -0.999, -0.5, 0.0, 0.1, 0.7, 0.95, 1.0})
        {
            const double expected = besselByIntegral(beta * std::sqrt(1.0 - u * u)) / besselByIntegral(beta);
            CHECK(window.at(u) == Approx(expected).epsilon(1e-12));
        }
        for (const double u : {-1.0001, 1.0001, 1.5, -3.0})
            CHECK(window.at(u) == 0.0);
    }
}

TEST_CASE("A Kaiser filter has the taps of his formula", "[foundation]")
{
    // ceil((A - 7.95) / (14.36 width)) + 1, the length of a filter whose order is the quotient.
    CHECK(kaiserTaps(60.0, 0.1) == 38);
    CHECK(kaiserTaps(80.0, 0.1) == 52);
    CHECK(kaiserTaps(80.0, 0.025) == 202);
    CHECK(kaiserTaps(7.95, 0.1) == 1);
    CHECK(kaiserTaps(7.95 + 14.36, 1.0) <= 3);
    CHECK(kaiserTaps(30.0, 0.5) == 5);
}

TEST_CASE("A windowed sinc is a sinc under its window, of unit gain at 0 Hz", "[foundation]")
{
    const KaiserWindow window(6.0);
    struct Case
    {
        std::size_t taps;
        double cutoff, offset, centre, half;
    };
    for (const auto& [taps, cutoff, offset, centre, half] : {Case{21, 0.1, 0.0, 10.0, 11.0},
                                                             {20, 0.25, 0.3, 10.0, 10.0},
                                                             {9, 0.5, 0.0, 4.0, 4.0},
                                                             {16, 0.05, 0.75, 7.0, 8.5}})
    {
        CAPTURE(taps, cutoff, offset);
        const auto row = windowedSinc(taps, cutoff, offset, centre, window, half);
        REQUIRE(row.size() == taps);
        std::vector<double> expected(taps);
        double sum = 0.0, found = 0.0;
        for (std::size_t i = 0; i < taps; ++i)
        {
            const double t = offset + static_cast<double>(i) - centre;
            const double angle = 2.0 * std::numbers::pi * cutoff * t;
            expected[i] = (t == 0.0 ? 1.0 : std::sin(angle) / angle) * window.at(t / half);
            sum += expected[i];
            found += row[i];
        }
        for (std::size_t i = 0; i < taps; ++i)
            CHECK(row[i] == Approx(expected[i] / sum).margin(1e-15));
        CHECK(found == Approx(1.0).epsilon(1e-14));
    }
    // Half the amplitude at the cutoff.
    const auto row = windowedSinc(401, 0.1, 0.0, 200.0, window, 201.0);
    double at = 0.0;
    for (std::size_t i = 0; i < row.size(); ++i)
        at += row[i] * std::cos(2.0 * std::numbers::pi * 0.1 * (static_cast<double>(i) - 200.0));
    CHECK(at == Approx(0.5).epsilon(1e-3));
    CHECK(windowedSinc(1, 0.3, 0.0, 0.0, window, 1.0) == std::vector<double>{1.0});
}

TEST_CASE("A windowed sinc is exactly 0 at its zeros", "[foundation]")
{
    // Else what a row keeps would depend, where it is silent, on how a library computes the sine of whole half turns.
    const auto row = windowedSinc(20, 0.5, 0.0, 10.0, KaiserWindow(7.0), 10.0);
    std::vector<double> kept(20);
    kept[10] = 1.0;
    CHECK(row == kept);
}
