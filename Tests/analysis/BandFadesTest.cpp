#include "support/Catch.h"

#include <pacini/analysis/BandAnalysis.h>

using namespace pacini;

TEST_CASE("Neighbouring bands and what lies outside sum to one at every frequency", "[analysis]")
{
    for (const auto spacing : {BandSpacing::logarithmic, BandSpacing::linear})
        for (const std::size_t count : {1u, 2u, 6u, 12u, 32u})
            for (const double overlap : {0.1, 0.5, 1.0})
            {
                const auto bands = tiledBands(count, 30.0, 1000.0, spacing);
                const BandFades fades(bands, overlap);
                CAPTURE(count, overlap);
                for (double f = 5.0; f < 2000.0; f *= 1.003)
                {
                    double sum = 0.0;
                    for (std::size_t k = 0; k < count; ++k)
                    {
                        const double weight = fades.weight(k, k, f);
                        REQUIRE(weight >= 0.0);
                        REQUIRE(weight <= 1.0);
                        if (f <= fades.lowestFrequency(k) || f >= fades.highestFrequency(k))
                            REQUIRE(weight == Approx(0.0).margin(1e-12));
                        sum += weight;
                    }
                    REQUIRE(sum == Approx(fades.weight(0, count - 1, f)).margin(1e-12));
                    if (f > fades.lowestFrequency(0) && f < bands.front().low)
                        REQUIRE((sum > 0.0 && sum < 0.5));
                    if (f > fades.highestFrequency(0) && f < fades.lowestFrequency(count - 1))
                        REQUIRE(sum == Approx(1.0).margin(1e-12));
                }
            }
}

TEST_CASE("A band is halved at its edges and whole at its centre", "[analysis]")
{
    const auto bands = tiledBands(6, 30.0, 1000.0, BandSpacing::logarithmic);
    const BandFades fades(bands, 0.5);
    for (std::size_t k = 0; k < bands.size(); ++k)
    {
        CHECK(fades.weight(k, k, bands[k].low) == Approx(0.5));
        CHECK(fades.weight(k, k, bands[k].high) == Approx(0.5));
        CHECK(fades.weight(k, k, bands[k].centre) == Approx(1.0));
        // The fade is half as wide as the band, and a raised cosine: a quarter of it beyond the edge is at 0.854.
        const double quarter = std::pow(bands[k].high / bands[k].low, 0.5 * 0.25);
        CHECK(fades.weight(k, k, bands[k].low * quarter) == Approx(0.5 + 0.5 * std::sqrt(0.5)).epsilon(1e-3));
        CHECK(fades.lowestFrequency(k) == Approx(bands[k].low / (quarter * quarter)).epsilon(1e-3));
        CHECK(fades.highestFrequency(k) == Approx(bands[k].high * quarter * quarter).epsilon(1e-3));
    }
}

TEST_CASE("A fade is as wide as the narrower of its two bands allows", "[analysis]")
{
    const std::vector<BandEdges> bands{{100.0, 110.0, 121.0}, {121.0, 240.0, 484.0}};
    const BandFades fades(bands, 1.0);
    // Between them, the width of the first: ratio 1.21, centred on 121 Hz.
    CHECK(fades.highestFrequency(0) == Approx(121.0 * 1.1));
    CHECK(fades.lowestFrequency(1) == Approx(121.0 / 1.1));
    CHECK(fades.highestFrequency(1) == Approx(484.0 * 2.0));
}
