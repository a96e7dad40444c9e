#include "TestCurves.h"
#include "support/Catch.h"
#include "support/HeapGuard.h"

#include <pacini/simplify/CurveError.h>
#include <pacini/simplify/DouglasPeucker.h>
#include <pacini/simplify/StreamingSimplifier.h>
#include <pacini/simplify/Visvalingam.h>

#include <algorithm>
#include <limits>

using namespace pacini;

namespace
{
Curve stream(const Curve& dense, const StreamingParams& params)
{
    StreamingSimplifier simplifier;
    simplifier.prepare(params);
    Curve out;
    for (const Breakpoint& p : dense)
        simplifier.push(p, [&](const Breakpoint& v) { out.push_back(v); });
    simplifier.finish([&](const Breakpoint& v) { out.push_back(v); });
    return out;
}

StreamingParams within(double tolerance, std::size_t maxDelay)
{
    return {StreamingRule::tolerance, tolerance, 0.0, maxDelay, -std::numeric_limits<double>::infinity()};
}

StreamingParams atRate(double rate, std::size_t maxDelay)
{
    return {StreamingRule::rate, 0.0, rate, maxDelay};
}

std::vector<StreamingParams> allParams()
{
    return {within(0.0, 50),   within(0.01, 1), within(0.05, 20), within(0.2, 5000), atRate(0.0, 30),
            atRate(0.02, 250), atRate(0.1, 40), atRate(0.5, 7),   atRate(1.0, 1)};
}
} // namespace

TEST_CASE("The stream stays within its tolerance of every point and ends exactly", "[simplify]")
{
    for (const auto& [name, dense] : test::testCurves(1500))
        for (double tolerance : {0.0, 0.003, 0.05, 0.5, 300.0})
            for (std::size_t delay : {1u, 3u, 100u, 100'000u})
            {
                CAPTURE(name, tolerance, delay);
                const Curve out = stream(dense, within(tolerance, delay));
                CHECK(curveError(dense, out).max <= tolerance + 1e-12);
                CHECK(out.front() == dense.front());
                CHECK(out.back() == dense.back());
                CHECK(std::is_sorted(out.begin(), out.end(),
                                     [](const Breakpoint& a, const Breakpoint& b) { return a.time < b.time; }));
            }
}

TEST_CASE("The stream never keeps more points than its rate allows, and keeps points of the input", "[simplify]")
{
    for (const auto& [name, dense] : test::testCurves(2000))
        for (double rate : {0.01, 0.04, 0.2})
            for (std::size_t delay : {10u, 50u, 600u})
            {
                CAPTURE(name, rate, delay);
                const Curve out = stream(dense, atRate(rate, delay));
                const double raised = std::max(rate, 2.0 / static_cast<double>(delay));
                CHECK(static_cast<double>(out.size()) <= 3.0 + raised * static_cast<double>(dense.size()));
                CHECK(out.front() == dense.front());
                CHECK(out.back() == dense.back());
                // In the input's order, both sides of steps too.
                std::size_t found = 0;
                for (const Breakpoint& p : dense)
                    found += found < out.size() && out[found] == p ? 1u : 0u;
                CHECK(found == out.size());
            }
}

TEST_CASE("After every point, the last vertex is less than the delay old", "[simplify]")
{
    for (const auto& [name, dense] : test::testCurves(1200))
        for (const StreamingParams& params : allParams())
        {
            CAPTURE(name, params.maxDelay, params.tolerance, params.pointsPerInput);
            StreamingSimplifier simplifier;
            simplifier.prepare(params);
            double finalUntil = -1.0;
            for (std::size_t k = 0; k < dense.size(); ++k)
            {
                simplifier.push(dense[k],
                                [&](const Breakpoint& v)
                                {
                                    REQUIRE(v.time >= finalUntil);
                                    finalUntil = v.time;
                                });
                REQUIRE(finalUntil <= dense[k].time);
                if (k >= params.maxDelay)
                    REQUIRE(finalUntil >= dense[k - params.maxDelay + 1].time);
            }
        }
}

TEST_CASE("What is decided depends on the points so far, not on what comes or how it arrives", "[simplify]")
{
    const Curve dense = test::curveOfValues(test::strikes(2000, 61));
    for (const StreamingParams& params : allParams())
    {
        // Two streams that share their first 1000 points decide the same during them.
        const auto decidedBy = [&](const Curve& curve)
        {
            StreamingSimplifier simplifier;
            simplifier.prepare(params);
            Curve out;
            for (std::size_t k = 0; k < 1000; ++k)
                simplifier.push(curve[k], [&](const Breakpoint& v) { out.push_back(v); });
            return out;
        };
        Curve other = dense;
        for (std::size_t k = 1000; k < other.size(); ++k)
            other[k].value = 1.0 - other[k].value;
        CHECK(decidedBy(dense) == decidedBy(other));

        // The sink may change from call to call, and pieces may be of any length.
        const Curve whole = stream(dense, params);
        StreamingSimplifier simplifier;
        simplifier.prepare(params);
        Curve pieces;
        for (std::size_t start = 0, length = 1; start < dense.size(); start += length, length = length * 3 % 101)
        {
            Curve piece;
            for (std::size_t k = start; k < std::min(start + length, dense.size()); ++k)
                simplifier.push(dense[k], [&](const Breakpoint& v) { piece.push_back(v); });
            pieces.insert(pieces.end(), piece.begin(), piece.end());
        }
        simplifier.finish([&](const Breakpoint& v) { pieces.push_back(v); });
        CHECK(pieces == whole);
    }
}

TEST_CASE("A prepared stream makes no heap traffic, and starts anew like a fresh one", "[simplify]")
{
    const Curve dense = test::irregular(5000, 71);
    for (const StreamingParams& params : allParams())
    {
        const Curve expected = stream(dense, params);
        StreamingSimplifier simplifier;
        simplifier.prepare(params);
        Curve out;
        out.reserve(dense.size() + 2);
        const auto sink = [&](const Breakpoint& v)
        {
            out.push_back(v);
        };
        const test::HeapGuard guard;
        for (const Breakpoint& p : dense)
            simplifier.push(p, sink);
        simplifier.finish(sink);
        const bool first = out == expected;
        out.clear();
        for (std::size_t k = 0; k < 333; ++k)
            simplifier.push(dense[k + 17], sink);
        simplifier.reset();
        out.clear();
        for (const Breakpoint& p : dense)
            simplifier.push(p, sink);
        simplifier.finish(sink);
        CHECK(guard.traffic() == 0);
        CHECK(first);
        CHECK(out == expected);
    }
}

TEST_CASE("Points that are not finite or go back in time are passed over", "[simplify]")
{
    const Curve good = test::curveOfValues(test::strikes(500, 81));
    Curve bad;
    for (std::size_t k = 0; k < good.size(); ++k)
    {
        if (k % 50 == 10)
        {
            const double infinity = std::numeric_limits<double>::infinity();
            for (const double value : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity, 2e100, -2e100})
                bad.push_back({good[k].time, value});
            for (const double time : {std::numeric_limits<double>::quiet_NaN(), infinity, 2e100})
                bad.push_back({time, 0.0});
            bad.push_back({good[k].time - 1.0, 5.0});
        }
        bad.push_back(good[k]);
    }
    for (const StreamingParams& params : allParams())
    {
        CHECK(stream(bad, params) == stream(good, params));
        const Curve largest{{-1e100, -1e100}, {1.0, 1e100}, {1e100, 1.0}}; // these count
        CHECK(stream(largest, params).front() == largest.front());
        CHECK(stream(largest, params).back() == largest.back());
        CHECK(stream({{0.0, 1.0}, {1.0, 1e100}}, params).size() == 2);
    }
}

TEST_CASE("Empty streams and streams of one point work", "[simplify]")
{
    for (const StreamingParams& params : allParams())
    {
        CHECK(stream({}, params).empty());
        CHECK(stream({{1.0, 2.0}}, params) == Curve{{1.0, 2.0}});
        CHECK(stream({{1.0, 2.0}, {2.0, 9.0}}, params) == Curve{{1.0, 2.0}, {2.0, 9.0}});
    }
}

TEST_CASE("A stream with a delay of a quarter second is as good as removal with the whole curve in sight", "[simplify]")
{
    double streamed = 0.0, removed = 0.0;
    for (std::uint64_t seed = 0; seed < 8; ++seed)
    {
        const Curve dense = test::curveOfValues(test::strikes(6000, 90 + seed));
        const Curve out = stream(dense, atRate(0.03, 250));
        streamed += curveError(dense, out).rms;
        removed += curveError(dense, curveOf(dense, visvalingamToCount(dense, out.size()))).rms;
    }
    CHECK(streamed < 1.1 * removed);
}

TEST_CASE("The swing filter needs no more points than splitting at the same bound", "[simplify]")
{
    std::size_t swung = 0, split = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed)
    {
        const Curve dense = test::curveOfValues(test::strikes(4000, 190 + seed));
        swung += stream(dense, within(0.03, 100'000)).size();
        split += douglasPeuckerToBound(dense, 0.03).size();
    }
    CHECK(swung < split);
}

TEST_CASE("With a floor, no vertex of the stream falls below it and the tolerance is kept all the same", "[simplify]")
{
    bool dips = false;
    for (std::uint64_t seed = 0; seed < 8; ++seed)
    {
        const Curve dense = test::curveOfValues(test::strikes(3000, 290 + seed));
        auto params = within(0.1, 1000);
        const auto below = [](const Curve& curve)
        {
            return std::any_of(curve.begin(), curve.end(), [](const Breakpoint& p) { return p.value < 0.0; });
        };
        dips = dips || below(stream(dense, params));
        params.lowest = 0.0;
        const Curve out = stream(dense, params);
        CHECK(!below(out));
        CHECK(curveError(dense, out).max <= 0.1 + 1e-12);
    }
    CHECK(dips);
}
