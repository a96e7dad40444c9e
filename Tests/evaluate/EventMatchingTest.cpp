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

TEST_CASE("A score has its counts, with and without hits", "[evaluate]")
{
    const EventScore nothing;
    CHECK(nothing == EventScore{0.0, 0, 0, 0});
    const auto missed = scoreEvents({0.5, 0.7}, {0.6}, 0.025);
    CHECK(missed == EventScore{0.0, 0, 1, 2});
    CHECK(scoreEvents({}, {}, 0.025) == EventScore{1.0, 0, 0, 0});
    CHECK(scoreEvents({0.5}, {}, 0.025) == EventScore{0.0, 0, 0, 1});
    CHECK(scoreEvents({}, {0.5}, 0.025) == EventScore{0.0, 0, 1, 0});
    CHECK(matchEvents(std::vector<double>{0.5, 1.0}, std::vector<double>{0.25, 0.75, 1.25}, 0.25) ==
          std::vector<double>{-0.25, -0.25});
    CHECK(matchEvents(std::vector<double>{0.5, 1.0}, std::vector<double>{0.125, 0.875, 1.25}, 0.25) ==
          std::vector<double>{-0.125});
    CHECK(median({3.0, 9.0, 1.0}) == 3.0);
    CHECK(median({7.0}) == 7.0);
    CHECK(median({7.0, 1.0}) == 4.0);
}

TEST_CASE("Detections within 25 ms of an ambiguous onset and further than that from every onset do not count",
          "[evaluate]")
{
    const std::vector<double> ambiguous{0.25};
    CHECK(scoreEvents({1.0}, {1.0, 0.274}, 0.01, ambiguous).falsePositives == 0);
    CHECK(scoreEvents({1.0}, {1.0, 0.226}, 0.01, ambiguous).falsePositives == 0);
    CHECK(scoreEvents({1.0}, {1.0, 0.276}, 0.01, ambiguous).falsePositives == 1);
    CHECK(scoreEvents({1.0}, {1.0, 0.224}, 0.01, ambiguous).falsePositives == 1);
    CHECK(scoreEvents({0.29}, {0.27}, 0.01, ambiguous).falsePositives == 1); // near both
    CHECK(scoreEvents({0.29}, {0.264}, 0.01, ambiguous).falsePositives == 0);
}

TEST_CASE("Peaks as high and as far apart as is asked are kept", "[evaluate]")
{
    using Indices = std::vector<std::size_t>;
    CHECK(findPeaks(std::vector<double>{0, 1, 0, 2, 0}, 1.0, 2) == Indices{1, 3});
    CHECK(findPeaks(std::vector<double>{0, 1, 0, 2, 0}, 1.0, 3) == Indices{3});
    CHECK(findPeaks(std::vector<double>{0, 2, 0, 1, 0}, 1.0, 3) == Indices{1});
    CHECK(findPeaks(std::vector<double>{0, 1, 0, 1, 0, 1, 0, 1, 0}, 0.5, 4) == Indices{3, 7});
    CHECK(findPeaks(std::vector<double>{0, 3, 0, 2, 0, 1, 0, 4, 0}, 0.5, 5) == Indices{1, 7});
    CHECK(findPeaks(std::vector<double>{0, 1, 1, 1, 1, 0, 1, 1, 0}, 0.5, 1) == Indices{2, 6});
    CHECK(findPeaks(std::vector<double>{1, 1, 0, 0, 1, 1}, 0.5, 1).empty());
    CHECK(findPeaks(std::vector<double>{0, 1}, 0.5, 1).empty());
    CHECK(findPeaks(std::vector<double>{0, 1, 0}, 0.5, 1) == Indices{1});
    CHECK(findPeaks(std::vector<double>{0, 1, 2, 1, 0, 1, 2, 3, 2, 1}, 0.5, 1) == Indices{2, 7});
}

TEST_CASE("A rise compares with the level a span before, with silence before the start", "[evaluate]")
{
    const RiseDetectorParams usual;
    CHECK(usual.floor.value == -30.0);
    CHECK(usual.rise.value == 12.0);
    CHECK(usual.spanFrames == 10);
    CHECK(usual.gapFrames == 50);
    using Frames = std::vector<std::size_t>;
    // A single frame of sound: level 1 beside the floor of 1/1000 is a rise of 1001 = 60 dB.
    const auto found = [](const std::vector<float>& x, double rise, std::size_t span)
    {
        return detectRises({x}, {.floor = Decibels(-60.0), .rise = Decibels(rise), .spanFrames = span, .gapFrames = 5});
    };
    std::vector<float> x(40, 0.0f);
    x[20] = 1.0f;
    CHECK(found(x, 60.0, 3) == Frames{20});
    CHECK(found(x, 60.01, 3).empty());
    std::vector<float> start(40, 0.0f);
    start[0] = 1.0f;
    CHECK(found(start, 60.0, 3) == Frames{0});
    std::vector<float> last(40, 0.0f);
    last[39] = 1.0f;
    CHECK(found(last, 60.0, 3) == Frames{39});
    // A ramp: twice the level within 4 frames, not within 2.
    std::vector<float> ramp(40, 0.5f);
    for (std::size_t i = 0; i < 5; ++i)
        ramp[20 + i] = 0.5f + 0.125f * static_cast<float>(i);
    std::fill(ramp.begin() + 25, ramp.end(), 1.0f);
    std::fill(ramp.begin(), ramp.begin() + 1, 0.5f);
    CHECK(found(ramp, 5.9, 4) == Frames{1, 24});
    CHECK(found(ramp, 5.9, 2) == Frames{0});
    // The largest rise of any envelope counts, and the first sets the floor.
    const std::vector<float> quiet(40, 0.01f);
    CHECK(
        detectRises({quiet, x}, {.floor = Decibels(-20.0), .rise = Decibels(55.0), .spanFrames = 3, .gapFrames = 5}) ==
        Frames{20});
    CHECK(detectRises({x, quiet}, {.floor = Decibels(-20.0), .rise = Decibels(55.0), .spanFrames = 3, .gapFrames = 5})
              .empty());
}
