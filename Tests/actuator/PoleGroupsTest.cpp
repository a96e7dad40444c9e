#include "support/Catch.h"

#include <pacini/actuator/PoleGroups.h>

#include <algorithm>
#include <cmath>
#include <complex>

using namespace pacini;

namespace
{
RealPolynomial withPairs(std::initializer_list<PoleGroup> pairs)
{
    RealPolynomial product;
    product.c[0] = 1.0;
    for (const PoleGroup& pair : pairs)
    {
        RealPolynomial factor;
        factor.c[0] = pair.centre * pair.centre - pair.spread;
        factor.c[1] = -2.0 * pair.centre;
        factor.c[2] = 1.0;
        product = product * factor;
    }
    return product;
}

/// The largest relative distance of wanted pairs from the nearest found ones.
double distance(const PoleGroupList& found, std::initializer_list<PoleGroup> wanted)
{
    double largest = 0.0;
    for (const PoleGroup& pair : wanted)
    {
        double nearest = HUGE_VAL;
        for (const PoleGroup& other : found)
            nearest = std::min(nearest, std::abs(pair.centre - other.centre) / std::abs(pair.centre) +
                                            std::abs(pair.spread - other.spread) /
                                                std::max(std::abs(pair.spread), pair.centre * pair.centre));
        largest = std::max(largest, nearest);
    }
    return largest;
}
} // namespace

TEST_CASE("Pole pairs are found over fourteen decades, with damping from light to critical and beyond", "[actuator]")
{
    const std::initializer_list<PoleGroup> light = {{-1.0, -1e4}, {-20.0, -1.6e5}, {-100.0, -1e14}};
    CHECK(distance(findPoleGroups(withPairs(light)), light) < 1e-9);
    const std::initializer_list<PoleGroup> critical = {{-1.0, 0.0}, {-400.0, 0.0}, {-1e7, 0.0}};
    CHECK(distance(findPoleGroups(withPairs(critical)), critical) < 1e-13);
    const std::initializer_list<PoleGroup> close = {{-2.0, 0.1}, {-400.0, 400.0 * 400.0 * 0.1}, {-1e7, 1e13}};
    CHECK(distance(findPoleGroups(withPairs(close)), close) < 1e-12);
    const auto apart = findPoleGroups(withPairs({{-3.0, 4.0}, {-500.0, 480.0 * 480.0}, {-5e7, 24e14}}));
    const std::initializer_list<PoleGroup> alone = {{-1.0, 0.0, true},
                                                    {-5.0, 0.0, true},
                                                    {-20.0, 0.0, true},
                                                    {-980.0, 0.0, true},
                                                    {-5e7 + std::sqrt(24e14), 0.0, true},
                                                    {-5e7 - std::sqrt(24e14), 0.0, true}};
    CHECK(apart.size() == 6);
    CHECK(distance(apart, alone) < 1e-12);
    const std::initializer_list<PoleGroup> single = {{-1e-7, -1.0}};
    CHECK(distance(findPoleGroups(withPairs(single)), single) < 1e-9);
}

TEST_CASE("Near critical damping a pair keeps all its digits, though each of its poles does not", "[actuator]")
{
    for (int k = 2; k <= 16; ++k)
        for (const double sign : {-1.0, 1.0})
        {
            CAPTURE(k, sign);
            const double ratio = 1.0 + sign * std::pow(10.0, -k);
            const std::initializer_list<PoleGroup> pairs = {{-ratio, ratio * ratio - 1.0}, {-50.0, -1e6}};
            CHECK(distance(findPoleGroups(withPairs(pairs)), pairs) < 1e-12);
        }
}

TEST_CASE("Where all poles coincide they are found as closely as their coefficients tell", "[actuator]")
{
    const std::initializer_list<PoleGroup> twice = {{-0.1, -1.0}, {-0.1, -1.0}};
    CHECK(distance(findPoleGroups(withPairs(twice)), twice) < 1e-5);
    const std::initializer_list<PoleGroup> six = {{-1.0, 0.0}, {-1.0, 0.0}, {-1.0, 0.0}};
    const auto found = findPoleGroups(withPairs(six));
    REQUIRE(found.size() == 3);
    CHECK(distance(found, six) < 0.1);
}

TEST_CASE("Functions of a pair equal those of its two poles, and their derivative where these meet", "[actuator]")
{
    using Complex = std::complex<long double>;
    const auto phi = [](Complex x, int order)
    {
        Complex sum = 0.0L, term = 1.0L;
        for (int k = 1; k <= order; ++k)
            term /= static_cast<long double>(k);
        for (int k = 1; k < 200; ++k)
        {
            sum += term;
            term *= x / static_cast<long double>(k + order);
        }
        return sum;
    };
    for (const double centre : {-1e-8, -1e-3, -0.3, -2.0, -9.0})
        for (const double ratio : {-1e6, -30.0, -1.0, -1e-5, 1e-5, 0.01, 0.1})
        {
            const PoleGroup pair{centre, ratio * centre * centre};
            if (std::sqrt(std::abs(pair.spread)) > 15.0)
                continue;
            CAPTURE(pair.centre, pair.spread);
            const Complex root = std::sqrt(Complex(pair.spread));
            const Complex first = static_cast<long double>(pair.centre) + root;
            const Complex second = static_cast<long double>(pair.centre) - root;
            const auto check = [&](const PoleNumber& found, Complex one, Complex other)
            {
                const Complex mean = (one + other) / 2.0L;
                const Complex slope = (one - other) / (2.0L * root);
                const double size = static_cast<double>(std::abs(one) + std::abs(other));
                const double lost = size * 1e-18 / static_cast<double>(std::abs(root)); // by the reference
                CHECK(std::abs(found.a - static_cast<double>(mean.real())) <= 1e-14 * size);
                CHECK(std::abs(found.b - static_cast<double>(slope.real())) <=
                      1e-13 * std::max(size, std::abs(static_cast<double>(slope.real()))) + lost);
            };
            check(expAt(pair), std::exp(first), std::exp(second));
            check(phiAt(pair, 1), phi(first, 1), phi(second, 1));
            check(phiAt(pair, 2), phi(first, 2), phi(second, 2));
        }
    // Two poles in one: e^x is e^p + e^p (x - p), and 1 / (1 + x) loses its square.
    const PoleNumber same = expAt({-0.7, 0.0});
    CHECK(same.a == Approx(std::exp(-0.7)).epsilon(1e-15));
    CHECK(same.b == Approx(std::exp(-0.7)).epsilon(1e-15));
    const PoleNumber quotient = PoleNumber{1.0, 0.0, 0.0} / (valueAt({-0.7, 0.0}) + 1.0);
    CHECK(quotient.a == Approx(1.0 / 0.3));
    CHECK(quotient.b == Approx(-1.0 / 0.09));
    // Close together and fast: no overflow, and exp(-1e6) is 0.
    CHECK(expAt({-1e6, 1e11}).a == 0.0);
    CHECK(expAt({-1e6, 1e11}).b == 0.0);
    CHECK(phiAt({-1e6, 1e11}, 1).a == Approx(1e-6 / 0.9));
}
