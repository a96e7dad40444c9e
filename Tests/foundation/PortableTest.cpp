#include "support/Catch.h"

#include <pacini/foundation/Portable.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace pacini;

namespace
{

/// Errors in units in the last place against long double, whose functions are others and which has 11 bits more at
/// least.
class PortableErrors
{
public:
    void add(double found, long double exact)
    {
        const double about = std::abs(static_cast<double>(exact));
        if (about < 1e-290 || about > 1e300)
            return;
        const double unit = std::nextafter(about, std::numeric_limits<double>::infinity()) - about;
        largest = std::max(largest, static_cast<double>(std::abs(static_cast<long double>(found) - exact)) / unit);
    }
    double largest = 0.0;
};

} // namespace

TEST_CASE("Portable functions are within a unit in the last place of long double", "[foundation]")
{
    static_assert(std::numeric_limits<long double>::digits >= 64);
    constexpr long double pi = std::numbers::pi_v<long double>;
    PortableErrors turns, sines, tangents, powers, exponentials, logarithms;
    Random random(46);
    for (int i = 0; i < 20000; ++i)
    {
        // Of an eighth of a turn, where the argument's error of a long double counts least.
        const double eighth = random.uniform(-0.125, 0.125);
        const auto turn = portable::turnBy(eighth);
        turns.add(turn.real(), std::cos(2.0L * pi * static_cast<long double>(eighth)));
        turns.add(turn.imag(), std::sin(2.0L * pi * static_cast<long double>(eighth)));
        const double angle = random.uniform(-1000.0, 1000.0);
        sines.add(portable::sin(angle), std::sin(static_cast<long double>(angle)));
        sines.add(portable::cos(angle), std::cos(static_cast<long double>(angle)));
        const double acute = random.uniform(0.0, 1.57);
        tangents.add(portable::tan(acute), std::tan(static_cast<long double>(acute)));
        const double base = std::exp(random.uniform(-10.0, 10.0));
        const double exponent = random.uniform(-40.0, 40.0);
        powers.add(portable::pow(base, exponent),
                   std::pow(static_cast<long double>(base), static_cast<long double>(exponent)));
        const double x = random.uniform(-600.0, 600.0);
        exponentials.add(portable::exp(x), std::exp(static_cast<long double>(x)));
        exponentials.add(portable::exp2(x), std::exp2(static_cast<long double>(x)));
        exponentials.add(portable::exp10(0.4 * x), std::pow(10.0L, static_cast<long double>(0.4 * x)));
        const double above = i % 2 == 0 ? std::exp(x) : 1.0 + 1e-4 * x;
        logarithms.add(portable::log(above), std::log(static_cast<long double>(above)));
        logarithms.add(portable::log2(above), std::log2(static_cast<long double>(above)));
    }
    CHECK(turns.largest < 1.5);
    CHECK(sines.largest < 0.9);
    CHECK(tangents.largest < 2.0);
    CHECK(powers.largest < 0.95);
    CHECK(exponentials.largest < 0.75);
    CHECK(logarithms.largest < 0.55);
}

TEST_CASE("A portable turn by whole quarters is exact, however far", "[foundation]")
{
    using Turn = std::complex<double>;
    for (const double turns : {0.0, 1.0, -3.0, 1e6, 86400.0 * 1000.0})
    {
        CHECK(portable::turnBy(turns) == Turn(1.0, 0.0));
        CHECK(portable::turnBy(turns + 0.25) == Turn(0.0, 1.0));
        CHECK(portable::turnBy(turns + 0.5) == Turn(-1.0, 0.0));
        CHECK(portable::turnBy(turns - 0.25) == Turn(0.0, -1.0));
    }
    CHECK(portable::turnBy(86400.0 * 1000.0 + 0.125).imag() == Approx(0.5 * std::numbers::sqrt2).epsilon(1e-15));
}

TEST_CASE("Portable functions of limits are those of the library", "[foundation]")
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    CHECK(portable::pow(0.0, 0.0) == 1.0);
    CHECK(portable::pow(0.0, 2.0) == 0.0);
    CHECK(portable::pow(0.0, -1.0) == infinity);
    CHECK(portable::pow(infinity, 0.5) == infinity);
    CHECK(portable::pow(3.0, 0.0) == 1.0);
    CHECK(portable::pow(1.0, 1e9) == 1.0);
    CHECK(std::isnan(portable::pow(-1.0, 0.5)));
    CHECK(portable::log(0.0) == -infinity);
    CHECK(portable::log2(0.0) == -infinity);
    CHECK(portable::log(infinity) == infinity);
    CHECK(portable::log(1.0) == 0.0);
    CHECK(std::isnan(portable::log(-1.0)));
    CHECK(portable::log2(std::numeric_limits<double>::denorm_min()) == -1074.0);
    CHECK(portable::exp(-infinity) == 0.0);
    CHECK(portable::exp(infinity) == infinity);
    CHECK(portable::exp(-1e4) == 0.0);
    CHECK(portable::exp2(-1074.0) == std::numeric_limits<double>::denorm_min());
    for (const double x :
         {portable::sin(nothing), portable::cos(nothing), portable::tan(nothing), portable::exp(nothing),
          portable::log(nothing), portable::pow(nothing, 1.0), portable::pow(2.0, nothing)})
        CHECK(std::isnan(x));
    for (int i = -3; i <= 15; ++i)
    {
        CHECK(portable::exp10(i) == std::pow(10.0, i));
        CHECK(portable::exp2(i) == std::exp2(i));
    }
}
