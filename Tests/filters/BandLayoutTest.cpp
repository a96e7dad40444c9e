#include "support/Catch.h"
#include "support/Golden.h"

#include <pacini/filters/BandLayout.h>

#include <limits>
#include <map>
#include <string>

using namespace pacini;
using namespace pacini::test;

namespace
{

const std::vector<BandLayoutKind> kinds{BandLayoutKind::centresAtEnds, BandLayoutKind::cutoffsAtEnds,
                                        BandLayoutKind::tiled};
const std::vector<BandSpacing> spacings{BandSpacing::logarithmic, BandSpacing::linear};

} // namespace

TEST_CASE("Band layouts equal the reference", "[filters][golden]")
{
    const auto data = golden("filterbank")["layouts"];
    const std::map<std::string, BandLayoutKind> names{
        {"A", BandLayoutKind::centresAtEnds}, {"B", BandLayoutKind::cutoffsAtEnds}, {"C", BandLayoutKind::tiled}};
    for (const auto& [name, kind] : names)
        for (const std::size_t n : {2u, 3u, 6u})
        {
            CAPTURE(name, n);
            BandLayoutParams params;
            params.bands = n;
            params.kind = kind;
            const auto layout = designBandLayout(params);
            const auto& expected = data[name][std::to_string(n)];
            REQUIRE(layout.centres.size() == n);
            REQUIRE(layout.crossovers.size() == n - 1);
            for (std::size_t k = 0; k < n; ++k)
                CHECK(layout.centres[k].value == Approx(expected["centres"][k].get<double>()).epsilon(1e-10));
            for (std::size_t k = 0; k + 1 < n; ++k)
                CHECK(layout.crossovers[k].value == Approx(expected["crossovers"][k].get<double>()).epsilon(1e-10));
        }
}

TEST_CASE("Linear layouts step by equal hertz", "[filters]")
{
    const auto ends = designBandLayout({6, 100_Hz, 1100_Hz, BandSpacing::linear, BandLayoutKind::centresAtEnds});
    for (std::size_t k = 0; k < 6; ++k)
        CHECK(ends.centres[k].value == Approx(100.0 + 200.0 * static_cast<double>(k)));
    CHECK(ends.crossovers[0].value == Approx(200.0));
    CHECK(ends.lowerEdge(0).value == Approx(0.0).margin(1e-9));
    CHECK(ends.upperEdge(5).value == Approx(1200.0));

    const auto tiled = designBandLayout({5, 100_Hz, 1100_Hz, BandSpacing::linear, BandLayoutKind::tiled});
    CHECK(tiled.lowerEdge(0).value == Approx(100.0));
    CHECK(tiled.centres[0].value == Approx(200.0));
    CHECK(tiled.upperEdge(4).value == Approx(1100.0));

    const auto cutoffs = designBandLayout({6, 100_Hz, 1100_Hz, BandSpacing::linear, BandLayoutKind::cutoffsAtEnds});
    CHECK(cutoffs.crossovers[0].value == Approx(100.0));
    CHECK(cutoffs.crossovers[4].value == Approx(1100.0));
    CHECK(cutoffs.centres[1].value == Approx(225.0));
    CHECK(cutoffs.centres[0].value == Approx(50.0)); // 100 - 125 would be below 0 Hz
}

TEST_CASE("The tiled layout covers exactly its range with bands of one width", "[filters]")
{
    for (std::size_t n = 1; n <= maxBands; ++n)
    {
        const auto layout = designBandLayout({n, 30_Hz, 1000_Hz, BandSpacing::logarithmic, BandLayoutKind::tiled});
        if (n > 1)
        {
            CHECK(layout.lowerEdge(0).value == Approx(30.0));
            CHECK(layout.upperEdge(n - 1).value == Approx(1000.0));
        }
        for (std::size_t k = 0; n > 1 && k < n; ++k)
            CHECK(layout.upperEdge(k).value / layout.lowerEdge(k).value ==
                  Approx(std::pow(1000.0 / 30.0, 1.0 / static_cast<double>(n))));
    }
}

TEST_CASE("Any parameters give 1 to 32 rising bands with their centres between their edges", "[filters]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const auto kind : kinds)
        for (const auto spacing : spacings)
            for (const std::size_t n : {0u, 1u, 2u, 3u, 4u, 12u, 32u, 1000u})
                for (const double low : {nan, -5.0, 0.0, 30.0, 999.0, 2000.0, inf})
                    for (const double high : {nan, 0.0, 1000.0, 384000.0, inf})
                    {
                        CAPTURE(static_cast<int>(kind), static_cast<int>(spacing), n, low, high);
                        const auto layout = designBandLayout({n, Hertz(low), Hertz(high), spacing, kind});
                        REQUIRE(layout.bands() >= 1);
                        REQUIRE(layout.bands() <= maxBands);
                        REQUIRE(layout.crossovers.size() + 1 == layout.bands());
                        for (std::size_t k = 0; k < layout.bands(); ++k)
                        {
                            const double centre = layout.centres[k].value;
                            REQUIRE(std::isfinite(centre));
                            REQUIRE(centre > 0.0);
                            REQUIRE(layout.lowerEdge(k).value >= 0.0);
                            REQUIRE(layout.lowerEdge(k).value <= centre);
                            REQUIRE(centre <= layout.upperEdge(k).value);
                            if (k > 0)
                                REQUIRE(layout.lowerEdge(k) == layout.upperEdge(k - 1));
                        }
                    }
}
