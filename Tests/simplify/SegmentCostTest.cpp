#include "TestCurves.h"
#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/simplify/ComputableCurve.h>
#include <pacini/simplify/CurveError.h>
#include <pacini/simplify/DouglasPeucker.h>
#include <pacini/simplify/GreedyBudget.h>
#include <pacini/simplify/SegmentCost.h>
#include <pacini/simplify/Simplify.h>
#include <pacini/simplify/SlopeCone.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace pacini;

namespace
{

/// The weighted squared error of a segment, in long double, by its definition: the samples of (start, end].
long double plainError(const DenseSamples& samples, std::size_t start, std::size_t end)
{
    const long double span = test::wide(samples.time(end)) - test::wide(samples.time(start));
    const long double rise = test::wide(samples.value(end)) - test::wide(samples.value(start));
    long double sum = 0.0L;
    for (std::size_t m = start + 1; m <= end; ++m)
    {
        const long double u = test::wide(samples.time(end)) - test::wide(samples.time(m));
        const long double e =
            test::wide(samples.value(m)) - (test::wide(samples.value(end)) - (span > 0.0L ? u * rise / span : 0.0L));
        sum += test::wide(samples.weight(m)) * e * e;
    }
    return sum;
}

/// All costs and bounds of a curve against their definition.
template <bool Even>
void checkSegmentCosts(const DenseSamples& samples, std::size_t longest, double tolerance)
{
    constexpr std::size_t block = SegmentCost<Even>::block;
    SegmentCost<Even> segments(longest);
    REQUIRE(segments.span() >= longest);
    REQUIRE(segments.span() < longest + block);
    REQUIRE(segments.span() % block == 0);
    for (int pass = 0; pass < 2; ++pass)
    {
        segments.begin(samples);
        std::vector<double> costs;
        std::array<double, block> via{};
        for (std::size_t j = 0; j < samples.size(); ++j)
        {
            segments.advance();
            const bool look = j < 40 || j % 7 == 3;
            for (std::size_t lag = block; look && j > 0 && lag <= segments.span(); lag += block)
            {
                segments.costsVia(lag, via.data());
                for (std::size_t k = 0; k < block; ++k)
                {
                    CAPTURE(j, lag, k);
                    if (j + k < lag)
                    {
                        REQUIRE(via[k] >= 0.5 * SegmentCost<Even>::unreachable);
                        continue;
                    }
                    const std::size_t start = j + k - lag;
                    const auto right = static_cast<double>(plainError(samples, start, j)) + costs[start];
                    REQUIRE(std::abs(via[k] - right) <= tolerance * std::max(1.0, std::abs(right)));
                }
                const double bound = segments.lowerBound(lag);
                const std::size_t oldest = j > segments.span() ? j - segments.span() : 0;
                for (std::size_t start = oldest; start + lag < j; ++start)
                {
                    CAPTURE(j, lag, start);
                    REQUIRE(bound <= static_cast<double>(plainError(samples, start, j)) + costs[start] + tolerance);
                }
            }
            costs.push_back(std::abs(std::sin(0.37 * static_cast<double>(j))) + 0.01 * static_cast<double>(j));
            segments.setCost(costs.back());
            for (std::size_t lag = 0; lag <= std::min(j, segments.span()); ++lag)
                REQUIRE(segments.costAt(lag) == costs[j - lag]);
        }
    }
}

/// The bounds as they are, which depends on how the window is laid out.
template <bool Even>
std::vector<double> segmentBounds(const DenseSamples& samples, std::size_t longest)
{
    SegmentCost<Even> segments(longest);
    segments.begin(samples);
    std::vector<double> bounds;
    for (std::size_t j = 0; j < samples.size(); ++j)
    {
        segments.advance();
        for (std::size_t lag = 8; lag <= segments.span(); lag += 8)
            if (const double bound = segments.lowerBound(lag); bound < 1e200)
                bounds.push_back(bound);
            else
                bounds.push_back(-1.0);
        segments.setCost(std::abs(std::sin(0.37 * static_cast<double>(j))) + 0.01 * static_cast<double>(j));
    }
    return bounds;
}

} // namespace

TEST_CASE("The costs of all segments in the window are their squared errors, across many windows", "[simplify]")
{
    const auto values = test::strikes(900, 5);
    const Curve uneven = test::irregular(700, 6);
    std::vector<double> times, weights, unevenValues = test::valuesOf(uneven);
    for (const Breakpoint& p : uneven)
    {
        times.push_back(p.time);
        weights.push_back(p.value > 0.8 ? 0.0 : 0.2 + std::abs(p.value));
    }
    // Steps are costed by the segmenter's callers' own rule; here times rise.
    for (std::size_t i = 1; i < times.size(); ++i)
        times[i] = std::max(times[i], times[i - 1] + 1e-3);
    for (const std::size_t longest : {1u, 8u, 17u, 40u})
    {
        checkSegmentCosts<true>({values, {}, {}}, longest, 1e-9);
        checkSegmentCosts<false>({values, {}, {}}, longest, 1e-9);
        checkSegmentCosts<false>({unevenValues, times, weights}, longest, 1e-6);
        checkSegmentCosts<false>({unevenValues, times, {}}, longest, 1e-6);
    }
}

TEST_CASE("The bounds of older starts are the pinned ones", "[simplify]")
{
    const auto values = test::strikes(700, 7);
    const Curve uneven = test::irregular(500, 8);
    const auto unevenValues = test::valuesOf(uneven);
    std::vector<double> times;
    for (const Breakpoint& p : uneven)
        times.push_back(p.time);
    for (const std::size_t longest : {8u, 30u, 150u})
    {
        const std::string line = "simplify/bounds, window " + std::to_string(longest);
        checkPinned(line + ", even", segmentBounds<true>({values, {}, {}}, longest));
        checkPinned(line + ", uneven", segmentBounds<false>({unevenValues, times, {}}, longest));
    }
}

TEST_CASE("A step costs the distance of its last value alone, and its bound is that of the starts", "[simplify]")
{
    const std::vector<double> values = {0.0, 1.0, 1.0, 1.0, 4.0};
    const std::vector<double> times = {0.0, 1.0, 1.0, 1.0, 1.0};
    SegmentCost<false> segments(8);
    segments.begin({values, times, {}});
    std::array<double, 8> via{};
    for (std::size_t j = 0; j < values.size(); ++j)
    {
        segments.advance();
        if (j == 4)
        {
            segments.costsVia(8, via.data());
            // From the three points at the same time: the line stands at the end's value.
            CHECK(via[7] == Approx(0.5));
            CHECK(via[6] == Approx(0.5 + 9.0));
            CHECK(via[5] == Approx(0.5 + 18.0));
            CHECK(via[4] == Approx(0.5 + 27.0));
            CHECK(via[3] > 1e299);
        }
        segments.setCost(0.5);
    }
}

TEST_CASE("The error of a growing segment is that of its definition, both ways, and never negative", "[simplify]")
{
    const Curve curve = test::irregular(60, 9);
    const auto values = test::valuesOf(curve);
    std::vector<double> times, weights;
    for (const Breakpoint& p : curve)
    {
        times.push_back(p.time);
        weights.push_back(0.5 + p.value * p.value);
    }
    for (const DenseSamples& samples : {DenseSamples{values, {}, {}}, {values, times, {}}, {values, times, weights}})
        for (const std::size_t i : {0u, 13u, 40u})
        {
            GrowingSegment forwards(samples, i), backwards(samples, 59);
            for (std::size_t j = i + 1; j < 60; ++j)
            {
                CHECK(forwards.errorTo(j) >= 0.0);
                CHECK(forwards.errorTo(j) == Approx(squaredError(samples, i, j)).margin(1e-12));
                forwards.include(j);
            }
            for (std::size_t j = 58; j > i; --j)
            {
                if (samples.time(j) < samples.time(59))
                    CHECK(backwards.errorTo(j) == Approx(squaredError(samples, j, 59)).margin(1e-12));
                backwards.include(j);
            }
            std::vector<double> scratch;
            const SegmentSplit split = bestSplit(samples, i, 59, scratch);
            double best = 0.0;
            for (std::size_t m = i + 1; m < 59; ++m)
                best = std::max(best, squaredError(samples, i, 59) - squaredError(samples, i, m) -
                                          squaredError(samples, m, 59));
            CHECK(split.gain <= best * (1.0 + 1e-9) + 1e-12);
            if (samples.times.empty())
                CHECK(split.gain == Approx(best));
            CHECK(split.index > i);
            CHECK(split.index < 59);
        }
}

TEST_CASE("A segment that nothing can improve is split nowhere, and of equal splits the first is taken", "[simplify]")
{
    std::vector<double> scratch;
    const std::vector<double> line = {1.0, 2.0, 3.0, 4.0};
    CHECK(bestSplit({line, {}, {}}, 0, 3, scratch).index == 0);
    CHECK(bestSplit({line, {}, {}}, 0, 3, scratch).gain == 0.0);
    CHECK(bestSplit({line, {}, {}}, 1, 2, scratch).index == 1);
    const std::vector<double> two = {0.0, 1.0, 0.0, 1.0, 0.0};
    CHECK(bestSplit({two, {}, {}}, 0, 4, scratch).index == 1);
    CHECK(scratch.size() >= 4);
}

TEST_CASE("The largest deviation is the first of equal ones, and a vertical line stands at its first value",
          "[simplify]")
{
    const Curve curve = {{0.0, 0.0}, {1.0, 1.0}, {2.0, -1.0}, {3.0, 1.0}, {4.0, 0.0}};
    CHECK(maxDeviation(curve, 0, 4).value == 1.0);
    CHECK(maxDeviation(curve, 0, 4).index == 1);
    CHECK(maxDeviation(curve, 1, 3).value == 2.0);
    CHECK(maxDeviation(curve, 1, 3).index == 2);
    CHECK(maxDeviation(curve, 2, 3).value == 0.0);
    CHECK(maxDeviation(curve, 2, 3).index == 2);
    const Curve step = {{1.0, 5.0}, {1.0, 2.0}, {1.0, 9.0}, {1.0, 7.0}};
    CHECK(maxDeviation(step, 0, 3).value == 4.0);
    CHECK(maxDeviation(step, 0, 3).index == 2);
    const Curve sloped = {{0.0, 1.0}, {1.0, 4.0}, {4.0, 9.0}};
    CHECK(maxDeviation(sloped, 0, 2).value == Approx(1.0));
}

TEST_CASE("Chords and squared errors follow times and weights", "[simplify]")
{
    const std::vector<double> values = {1.0, 4.0, 9.0, 3.0};
    const std::vector<double> times = {0.0, 1.0, 4.0, 4.0};
    const std::vector<double> weights = {5.0, 0.25, 2.0, 7.0};
    CHECK(chordSlope(DenseSamples{values, {}, {}}, 0, 2) == 4.0);
    CHECK(chordSlope(DenseSamples{values, times, {}}, 0, 2) == 2.0);
    CHECK(chordSlope(DenseSamples{values, times, {}}, 2, 3) == 0.0);
    CHECK(squaredError({values, {}, {}}, 0, 2) == 1.0);
    CHECK(squaredError({values, times, {}}, 0, 2) == 1.0);
    CHECK(squaredError({values, times, weights}, 0, 2) == 0.25);
    CHECK(squaredError({values, times, weights}, 0, 1) == 0.0);
    CHECK(squaredError({values, times, weights}, 0, 3) == Approx(0.25 * 2.5 * 2.5 + 2.0 * 6.0 * 6.0));
    const std::vector<std::size_t> kept = {0, 2, 3};
    CHECK(squaredError({values, times, weights}, kept) == 0.25);
    CHECK(DenseSamples{values, {}, {}}.evenlySpaced());
    CHECK_FALSE(DenseSamples{values, times, {}}.evenlySpaced());
    CHECK(DenseSamples{values, times, weights}.weighted());
    CHECK_FALSE(DenseSamples{values, times, {}}.weighted());
    CHECK(DenseSamples{values, {}, {}}.time(3) == 3.0);
    CHECK(DenseSamples{values, {}, {}}.weight(3) == 1.0);
}

TEST_CASE("Times within a millionth of a step of even ones are left out, others are kept", "[simplify]")
{
    const auto even = [](std::vector<double> times)
    {
        Curve curve;
        for (const double t : times)
            curve.push_back({t, t * t});
        const DenseColumns columns(curve);
        const DenseSamples samples = columns.samples();
        CHECK(samples.size() == curve.size());
        if (!samples.evenlySpaced())
            for (std::size_t i = 0; i < curve.size(); ++i)
                CHECK(samples.time(i) == times[i]);
        return samples.evenlySpaced();
    };
    CHECK(even({}));
    CHECK(even({3.0}));
    CHECK(even({3.0, 9.0}));
    CHECK(even({3.0, 5.0, 7.0}));
    CHECK(even({3.0, 5.0 + 1.9e-6, 7.0}));
    CHECK(even({3.0, 5.0 - 1.9e-6, 7.0}));
    CHECK_FALSE(even({3.0, 5.0 + 2.1e-6, 7.0}));
    CHECK_FALSE(even({3.0, 5.0 - 2.1e-6, 7.0}));
    CHECK_FALSE(even({3.0, 3.0, 3.0}));
    CHECK_FALSE(even({3.0, 3.0, 7.0}));
    CHECK(even({1.0, 2.0, 3.0, 4.0, 5.0}));
    CHECK_FALSE(even({1.0, 2.0, 3.0, 4.5, 5.0}));
}

TEST_CASE("Curves are scaled only where their squares leave the range, by powers of two", "[simplify]")
{
    const auto scaledBy = [](double value, double time)
    {
        const Curve curve = {{0.0, 0.0}, {0.5 * time, -value}, {time, 0.25 * value}};
        const ComputableCurve computable(curve);
        REQUIRE(computable.points().size() == 3);
        // Back in the old units, everything is as it was.
        const Curve back = computable.unscaled(computable.points());
        CHECK(back == curve);
        CHECK(computable.scaled(curve) == Curve(computable.points().begin(), computable.points().end()));
        CHECK(computable.scaled(value) == -computable.points()[1].value);
        CHECK(computable.scaled(std::span<const Breakpoint>(curve))[2].time == computable.points()[2].time);
        return std::pair(-computable.points()[1].value, computable.points()[2].time);
    };
    CHECK(scaledBy(0.7, 3.0) == std::pair(0.7, 3.0));
    CHECK(scaledBy(0x1.8p199, 0x1.8p-201) == std::pair(0x1.8p199, 0x1.8p-201)); // exponents of 200 and -200
    CHECK(scaledBy(0x1.8p-201, 0x1.8p199) == std::pair(0x1.8p-201, 0x1.8p199));
    CHECK(scaledBy(0x1.8p200, 1.0) == std::pair(0.75, 1.0));
    CHECK(scaledBy(0x1.8p-202, 1.0) == std::pair(0.75, 1.0));
    CHECK(scaledBy(1.0, 0x1.8p200) == std::pair(1.0, 0.75));
    CHECK(scaledBy(1.0, 0x1.8p-202) == std::pair(1.0, 0.75));
    CHECK(scaledBy(0x1p300, 0x1p-300) == std::pair(0.5, 0.5));
    // A vertex above the largest double comes back as the largest one.
    const double most = std::numeric_limits<double>::max();
    const Curve huge = {{0.0, most}, {1.0, -most}};
    const ComputableCurve computable(huge);
    const Curve above = {{0.0, 1.5}, {1.0, -1.5}};
    CHECK(computable.unscaled(above) == huge);
    // An empty curve and one of zeros stay as they are.
    CHECK(ComputableCurve(Curve{}).points().empty());
    const Curve zeros = {{0.0, 0.0}, {0.0, 0.0}};
    CHECK(ComputableCurve(zeros).points()[1] == Breakpoint{0.0, 0.0});
}

TEST_CASE("A slope cone holds the lines within the tolerance of its points and above the floor", "[simplify]")
{
    SlopeCone cone({1.0, 2.0}, 0.5, -std::numeric_limits<double>::infinity());
    CHECK(cone.nearest(1e9) == 1e9);
    CHECK(cone.nearest(-1e9) == -1e9);
    CHECK(cone.contains({1.0, 77.0})); // at the apex's time any line goes through the apex
    CHECK(cone.include({1.0, 2.5}));
    CHECK(cone.include({1.0, 1.5}));
    CHECK_FALSE(cone.include({1.0, 2.75}));
    CHECK_FALSE(cone.include({1.0, 1.25}));
    REQUIRE(cone.include({3.0, 4.0})); // slopes of 0.75 to 1.25
    CHECK(cone.nearest(9.0) == 1.25);
    CHECK(cone.nearest(0.0) == 0.75);
    CHECK(cone.nearest(1.0) == 1.0);
    CHECK(cone.contains({2.0, 2.75}));
    CHECK(cone.contains({2.0, 3.25}));
    CHECK_FALSE(cone.contains({2.0, 2.6875}));
    CHECK_FALSE(cone.contains({2.0, 3.3125}));
    CHECK_FALSE(cone.include({5.0, 8.0})); // needs 1.375 at least
    CHECK(cone.nearest(9.0) == 1.25);      // as it was
    REQUIRE(cone.include({5.0, 7.5}));     // 1.25 at least: one line is left
    CHECK(cone.nearest(0.0) == 1.25);
    CHECK(cone.nearest(9.0) == 1.25);
    SlopeCone floored({0.0, 1.0}, 0.5, 0.0);
    REQUIRE(floored.include({1.0, 0.25})); // -1 instead of -1.25
    CHECK(floored.nearest(-9.0) == -1.0);
    CHECK(floored.nearest(9.0) == -0.25);
    SlopeCone below({0.0, 1.0}, 0.5, 0.0);
    REQUIRE(below.include({1.0, -0.25})); // the point is below the floor: it is the floor
    CHECK(below.nearest(-9.0) == -1.25);
    CHECK(below.nearest(9.0) == -0.75);
}

TEST_CASE("The least that a curve keeps is its minimum, two points, or all that it has", "[simplify]")
{
    const std::vector<double> values(5, 0.0);
    CHECK(BudgetCurve{}.weight == 1.0);
    CHECK(BudgetCurve{}.minimum == 2);
    CHECK(BudgetCurve{{values, {}, {}}, 1.0, 0}.leastPoints() == 2);
    CHECK(BudgetCurve{{values, {}, {}}, 1.0, 2}.leastPoints() == 2);
    CHECK(BudgetCurve{{values, {}, {}}, 1.0, 3}.leastPoints() == 3);
    CHECK(BudgetCurve{{values, {}, {}}, 1.0, 9}.leastPoints() == 5);
    CHECK(BudgetCurve{{std::span(values).first(1), {}, {}}, 1.0, 0}.leastPoints() == 1);
    CHECK(BudgetCurve{}.leastPoints() == 0);
    const std::vector<KeptPoints> kept = {{0, 1, 4}, {}, {0, 9}};
    CHECK(pointsOf(kept) == 5);
    CHECK(pointsOf({}) == 0);
}

TEST_CASE("A single point with weight is met by its vertex, wherever it is", "[simplify]")
{
    const Curve dense = {{0.0, 3.0}, {1.0, 5.0}, {2.0, 7.0}};
    const Curve vertices = {{0.0, 0.0}, {2.0, 0.0}};
    CHECK(refit(dense, vertices, std::vector{1.0, 0.0, 0.0})[0].value == Approx(3.0));
    CHECK(refit(dense, vertices, std::vector{1.0, 0.0, 0.0})[1].value == Approx(0.0).margin(1e-6));
    CHECK(refit(dense, vertices, std::vector{0.0, 0.0, 1e-9})[1].value == Approx(7.0));
    CHECK(refit(dense, vertices, std::vector{0.0, 1.0, 0.0})[0].value == Approx(5.0));
    CHECK(refit(dense, vertices, std::vector{0.0, 0.0, 0.0}) == vertices);
    CHECK(refit({}, vertices) == vertices);
    CHECK(refit(dense, {}).empty());
}

TEST_CASE("The defaults of simplification are as documented", "[simplify]")
{
    const SimplifyParams params;
    CHECK(params.method == SimplifyMethod::lagrangian);
    CHECK_FALSE(params.count);
    CHECK_FALSE(params.maxError);
    CHECK_FALSE(params.refit);
    CHECK(params.lowest == -std::numeric_limits<double>::infinity());
    CHECK(params.streamingDelay == 250);
    const StreamingParams streaming;
    CHECK(streaming.rule == StreamingRule::tolerance);
    CHECK(streaming.tolerance == 0.01);
    CHECK(streaming.pointsPerInput == 0.02);
    CHECK(streaming.maxDelay == 250);
    CHECK(streaming.lowest == -std::numeric_limits<double>::infinity());
    CHECK(CurveError{}.max == 0.0);
    CHECK(CurveError{}.rms == 0.0);
    CHECK(Deviation{}.value == 0.0);
    CHECK(Deviation{}.index == 0);
    const auto messageOf = [](const Curve& curve, const SimplifyParams& bad)
    {
        const auto result = simplify(curve, bad);
        REQUIRE_FALSE(result.ok());
        return result.error().where + ": " + result.error().message;
    };
    const Curve curve = {{0.0, 1.0}, {1.0, 2.0}, {2.0, 1.0}};
    CHECK(messageOf(curve, {}) == "params: need a count or a maxError");
    CHECK(messageOf(curve, {SimplifyMethod::optimal, {}, -1e-9}) == "params.maxError: is not 0 or more");
    CHECK(messageOf(curve, {SimplifyMethod::optimal, 3, std::nan("")}) == "params.maxError: is not 0 or more");
    CHECK(messageOf(curve, {SimplifyMethod::optimal, 3, std::numeric_limits<double>::infinity()}) ==
          "params.maxError: is not 0 or more");
    SimplifyParams delay{SimplifyMethod::streaming, 3, {}};
    delay.streamingDelay = 0;
    CHECK(messageOf(curve, delay) == "params.streamingDelay: is below 1 point");
    delay.streamingDelay = 1;
    CHECK(simplify(curve, delay).ok());
    CHECK(messageOf({{0.0, 1.0}, {1.0, std::nan("")}}, {SimplifyMethod::optimal, 3, {}}) ==
          "curve[1]: is not a finite point");
    CHECK(messageOf({{0.0, 1.0}, {std::nan(""), 1.0}}, {SimplifyMethod::optimal, 3, {}}) ==
          "curve[1]: is not a finite point");
    CHECK(messageOf({{1.0, 1.0}, {0.5, 1.0}}, {SimplifyMethod::optimal, 3, {}}) ==
          "curve[1].time: is earlier than the point before it");
    CHECK(simplify(Curve{{1.0, 1.0}, {1.0, 2.0}}, {SimplifyMethod::optimal, 3, {}}).ok());
    CHECK(simplify(curve, {SimplifyMethod::optimal, {}, 0.0})->size() == 3);
    // A count below 2 counts as 2, with which every method keeps the ends.
    for (const auto method : {SimplifyMethod::visvalingam, SimplifyMethod::douglasPeucker, SimplifyMethod::optimal,
                              SimplifyMethod::streaming, SimplifyMethod::lagrangian})
        for (const std::size_t count : {0u, 1u, 2u})
            CHECK(*simplify(curve, {method, count, {}}) == Curve{{0.0, 1.0}, {2.0, 1.0}});
}
