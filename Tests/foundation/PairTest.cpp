#include "support/Catch.h"

#include <pacini/foundation/Pair.h>

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
