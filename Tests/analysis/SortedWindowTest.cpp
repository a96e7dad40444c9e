#include "support/Catch.h"

#include <pacini/analysis/SortedWindow.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace pacini;

TEST_CASE("A window that slides has the median of what is under it, equal values included", "[analysis]")
{
    Random random(17);
    for (const std::size_t length : {1u, 3u, 4u, 9u, 31u})
        for (const double steps : {3.0, 1e6}) // many equal values, and none
        {
            std::vector<float> values;
            for (int i = 0; i < 300; ++i)
                values.push_back(static_cast<float>(std::floor(random.uniform(0.0, steps))));
            std::vector<float> window(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(length));
            std::sort(window.begin(), window.end());
            for (std::size_t i = length; i < values.size(); ++i)
            {
                replaceSorted(window, values[i - length], values[i]);
                std::vector<float> plain(values.begin() + static_cast<std::ptrdiff_t>(i + 1 - length),
                                         values.begin() + static_cast<std::ptrdiff_t>(i + 1));
                std::sort(plain.begin(), plain.end());
                REQUIRE(window == plain);
                REQUIRE(medianOfSorted(window) == plain[length / 2]);
            }
        }
}

TEST_CASE("Values beyond the ends are those before them in reverse", "[analysis]")
{
    // numpy.pad([0, 1, 2], 7, mode="symmetric")
    const std::vector<std::size_t> expected{0, 0, 1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1, 2, 2};
    for (std::size_t i = 0; i < expected.size(); ++i)
        CHECK(reflectedIndex(static_cast<std::ptrdiff_t>(i) - 7, 3) == expected[i]);
    for (const std::ptrdiff_t i : {-5, -1, 0, 1, 8})
        CHECK(reflectedIndex(i, 1) == 0);
}
