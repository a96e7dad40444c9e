#include "support/Catch.h"

#include <pacini/evaluate/EventMatching.h>
#include <pacini/evaluate/RiseDetector.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <vector>

using namespace pacini;

namespace
{
/// The size of a largest one-to-one matching, by trying everything.
std::size_t largestMatching(const std::vector<double>& a, const std::vector<double>& b, double tolerance, std::size_t i,
                            unsigned used)
{
    if (i == a.size())
        return 0;
    std::size_t best = largestMatching(a, b, tolerance, i + 1, used);
    for (std::size_t j = 0; j < b.size(); ++j)
        if ((used >> j & 1u) == 0 && std::abs(a[i] - b[j]) <= tolerance)
            best = std::max(best, 1 + largestMatching(a, b, tolerance, i + 1, used | 1u << j));
    return best;
}

std::vector<double> randomTimes(Random& random, std::size_t count)
{
    std::vector<double> t(count);
    for (double& v : t)
        v = random.uniform(0.0, 0.2);
    std::sort(t.begin(), t.end());
    return t;
}
} // namespace

TEST_CASE("Matching in order of time finds as many pairs as trying everything", "[evaluate]")
{
    Random random(11);
    for (int trial = 0; trial < 300; ++trial)
    {
        const auto a = randomTimes(random, 1 + random.next() % 6);
        const auto b = randomTimes(random, 1 + random.next() % 6);
        CHECK(matchEvents(a, b, 0.025).size() == largestMatching(a, b, 0.025, 0, 0u));
    }
}

TEST_CASE("Scores count hits, spurious and missed events; order does not matter", "[evaluate]")
{
    const auto score = scoreEvents({0.5, 0.1, 0.9}, {0.92, 0.11, 0.3}, 0.025);
    CHECK(score.truePositives == 2);
    CHECK(score.falsePositives == 1);
    CHECK(score.falseNegatives == 1);
    CHECK(score.f == Approx(2.0 / 3.0));
    REQUIRE(score.medianError.has_value());
    CHECK(*score.medianError == Approx(0.015));
}

TEST_CASE("A difference of exactly the tolerance is a hit", "[evaluate]")
{
    CHECK(scoreEvents({0.1}, {0.125}, 0.025).truePositives == 1);
    CHECK(scoreEvents({0.3}, {0.31}, 0.010).truePositives == 1);
    CHECK(scoreEvents({0.3}, {0.311}, 0.010).truePositives == 0);
}

TEST_CASE("Ambiguous onsets excuse detections, unless these are near a real onset", "[evaluate]")
{
    const std::vector<double> ambiguous{0.5};
    CHECK(scoreEvents({0.1}, {0.1, 0.51}, 0.025, ambiguous).falsePositives == 0);
    CHECK(scoreEvents({0.1}, {0.1, 0.53}, 0.025, ambiguous).falsePositives == 1);
    CHECK(scoreEvents({0.49}, {0.48, 0.51}, 0.010, ambiguous).falsePositives == 1);
}

TEST_CASE("Nothing to find and nothing found is perfect; one of both is worth nothing", "[evaluate]")
{
    CHECK(scoreEvents({}, {}, 0.025).f == 1.0);
    CHECK(scoreEvents({0.1}, {}, 0.025).f == 0.0);
    CHECK(scoreEvents({}, {0.1}, 0.025).f == 0.0);
    CHECK_FALSE(scoreEvents({}, {0.1}, 0.025).medianError.has_value());
}

TEST_CASE("Medians of even and odd counts", "[evaluate]")
{
    CHECK(median({3.0, 1.0, 2.0}) == 2.0);
    CHECK(median({4.0, 1.0, 3.0, 2.0}) == 2.5);
    CHECK_FALSE(median({}).has_value());
}

TEST_CASE("Peaks: plateaus count once, ends never, lower neighbours give way", "[evaluate]")
{
    const auto peaks = [](std::vector<double> x, double height, std::size_t distance)
    {
        return findPeaks(x, height, distance);
    };
    using Indices = std::vector<std::size_t>;
    CHECK(peaks({0, 1, 0, 2, 0}, 0.5, 1) == Indices{1, 3});
    CHECK(peaks({0, 1, 0, 2, 0}, 1.5, 1) == Indices{3});
    CHECK(peaks({5, 1, 0, 1, 6}, 0.0, 1).empty());
    CHECK(peaks({0, 2, 2, 2, 0}, 0.0, 1) == Indices{2});
    CHECK(peaks({0, 2, 2, 0}, 0.0, 1) == Indices{1});
    CHECK(peaks({0, 2, 2, 3, 0}, 0.0, 1) == Indices{3});
    CHECK(peaks({0, 2, 2}, 0.0, 1).empty());
    CHECK(peaks({0, 3, 0, 4, 0, 5, 0}, 0.0, 3) == Indices{1, 5}); // 5 removes 4, which then no longer removes 3
    CHECK(peaks({0, 3, 0, 3, 0}, 0.0, 3) == Indices{3});
    CHECK(peaks({}, 0.0, 1).empty());
}

TEST_CASE("Rises are found where a level climbs by the threshold within the span", "[evaluate]")
{
    std::vector<float> envelope(300, 0.1f);
    std::fill(envelope.begin() + 100, envelope.begin() + 105, 1.0f);
    std::fill(envelope.begin() + 200, envelope.end(), 0.25f);
    RiseDetectorParams params;
    params.gapFrames = 10;
    // +17.8 dB over the floor of -30 dB, then only +6.5 dB.
    CHECK(detectRises({envelope}, params) == std::vector<std::size_t>{4, 102});
    params.rise = Decibels(6.0);
    CHECK(detectRises({envelope}, params).size() == 3);
    params.rise = Decibels(19.0);
    CHECK(detectRises({envelope}, params).empty());
    CHECK(detectRises({std::vector<float>(50)}, params).empty());
    CHECK(detectRises({std::vector<float>()}, params).empty());
}
