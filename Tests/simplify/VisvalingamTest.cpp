#include "TestCurves.h"
#include "support/Catch.h"

#include <pacini/simplify/CurveError.h>
#include <pacini/simplify/Visvalingam.h>

using namespace pacini;

namespace
{
/// The definition, without a heap: O(n^2).
KeptPoints eliminateNaively(const Curve& dense, std::size_t count)
{
    KeptPoints kept = allPoints(dense.size());
    while (kept.size() > std::max<std::size_t>(count, 2))
    {
        std::size_t least = 0;
        double leastArea = 0.0;
        for (std::size_t k = 1; k + 1 < kept.size(); ++k)
        {
            const auto &a = dense[kept[k - 1]], &b = dense[kept[k]], &c = dense[kept[k + 1]];
            const double area =
                0.5 * std::abs((b.time - a.time) * (c.value - a.value) - (c.time - a.time) * (b.value - a.value));
            if (least == 0 || area < leastArea)
            {
                least = k;
                leastArea = area;
            }
        }
        kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(least));
    }
    return kept;
}
} // namespace

TEST_CASE("Visvalingam's heap removes the same points as the definition, ties included", "[simplify]")
{
    for (const auto& [name, dense] : test::testCurves(150))
        for (std::size_t count : {0u, 2u, 3u, 10u, 75u, 149u, 150u, 200u})
        {
            CAPTURE(name, count);
            CHECK(visvalingamToCount(dense, count) == eliminateNaively(dense, count));
        }
}

TEST_CASE("Visvalingam's removals are nested: fewer points are a subset of more points", "[simplify]")
{
    const Curve dense = test::curveOfValues(test::strikes(2000, 5));
    auto more = visvalingamToCount(dense, 400);
    for (std::size_t count : {200u, 50u, 7u})
    {
        const auto fewer = visvalingamToCount(dense, count);
        CHECK(fewer.size() == count);
        CHECK(std::includes(more.begin(), more.end(), fewer.begin(), fewer.end()));
        more = fewer;
    }
}

TEST_CASE("Visvalingam never removes the ends", "[simplify]")
{
    const auto dense = test::curveOfValues(test::uniformNoise(50, 3));
    for (const std::size_t count : {0u, 1u, 2u})
        CHECK(visvalingamToCount(dense, count) == KeptPoints{0, 49});
}

TEST_CASE("Visvalingam within a bound stops at points that it cannot remove", "[simplify]")
{
    const Curve dense = test::curveOfValues(test::strikes(1500, 6));
    const auto kept = visvalingamToBound(dense, 0.05);
    CHECK(curveError(dense, curveOf(dense, kept)).max <= 0.05);
    for (std::size_t k = 1; k + 1 < kept.size(); ++k)
        CHECK(maxDeviation(dense, kept[k - 1], kept[k + 1]).value > 0.05);
}
