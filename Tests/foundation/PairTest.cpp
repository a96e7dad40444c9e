#include "support/Catch.h"

#include <pacini/foundation/Pair.h>

#include <cmath>
#include <limits>

using namespace pacini;

TEST_CASE("Both numbers of a pair are computed as one is", "[foundation]")
{
    const double a = 0.1, b = -1e300, c = 3.0, d = 1e-17;
    const Pair x(a, b), y(c, d);
    CHECK((x + y).first() == a + c);
    CHECK((x + y).second() == b + d);
    CHECK((x - y).first() == a - c);
    CHECK((x - y).second() == b - d);
    CHECK((x * y).first() == a * c);
    CHECK((x * y).second() == b * d);
    CHECK(Pair(a).first() == a);
    CHECK(Pair(a).second() == a);
    CHECK(Pair().first() == 0.0);
    CHECK(Pair().second() == 0.0);
}

TEST_CASE("A pair is compared, clamped and cleared number by number", "[foundation]")
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const auto check = [](Pair x, double first, double second)
    {
        CHECK(x.first() == first);
        CHECK(x.second() == second);
    };
    check(larger(Pair(1.0, -3.0), Pair(2.0, -4.0)), 2.0, -3.0);
    check(smaller(Pair(1.0, -3.0), Pair(2.0, -4.0)), 1.0, -4.0);
    check(larger(Pair(none, 1.0), Pair(2.0, 3.0)), 2.0, 3.0);
    check(smaller(Pair(none, 4.0), Pair(2.0, 3.0)), 2.0, 3.0);
    check(magnitude(Pair(-1e-310, 2.0)), 1e-310, 2.0);
    check(magnitude(Pair(-infinity, -0.0)), infinity, 0.0);
    CHECK_FALSE(std::signbit(magnitude(Pair(-0.0, 1.0)).first()));
    check(cleared(Pair(-0.5, 0.25), 0.5), -0.5, 0.0);
    check(cleared(Pair(none, -infinity), 0.5), 0.0, -infinity);
}
