#include "support/Catch.h"

#include <pacini/foundation/LargestMagnitude.h>

#include <limits>
#include <vector>

using namespace pacini;

TEST_CASE("The largest magnitude is found wherever it stands", "[foundation]")
{
    CHECK(largestMagnitude({}) == 0.0f);
    for (std::size_t size = 1; size < 40; ++size)
        for (std::size_t at = 0; at < size; ++at)
        {
            std::vector<float> x(size, 0.25f);
            x[at] = at % 2 == 0 ? -0.5f : 0.5f;
            REQUIRE(largestMagnitude(x) == 0.5f);
        }
    CHECK(largestMagnitude(std::vector<float>{std::numeric_limits<float>::quiet_NaN(), -1.0f}) == 1.0f);
}
