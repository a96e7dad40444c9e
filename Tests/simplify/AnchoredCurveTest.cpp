#include "support/Catch.h"

#include <pacini/foundation/Random.h>
#include <pacini/simplify/AnchoredCurve.h>
#include <pacini/simplify/CurveError.h>

#include <algorithm>
#include <cmath>

using namespace pacini;

namespace
{
Curve wandering(std::uint64_t seed, std::size_t points)
{
    Random random(seed);
    Curve curve;
    double time = 0.0, value = 0.5;
    for (std::size_t i = 0; i < points; ++i)
    {
        curve.push_back({time, value});
        if (random.next() % 16 != 0) // else a step
            time += random.uniform(0.001, 0.02);
        value = std::clamp(value + random.uniform(-0.2, 0.2), 0.0, 1.0);
    }
    return curve;
}

bool hasPointAt(const Curve& curve, double time)
{
    return std::any_of(curve.begin(), curve.end(), [&](const Breakpoint& point) { return point.time == time; });
}
} // namespace

TEST_CASE("Anchored curves keep their anchors, their ends and their budget", "[simplify]")
{
    for (std::uint64_t seed = 1; seed <= 50; ++seed)
    {
        CAPTURE(seed);
        const Curve dense = wandering(seed, 200);
        const double end = dense.back().time;
        Random random(seed);
        std::vector<double> anchors(seed % 12);
        for (double& time : anchors)
            time = random.uniform(-0.1, end + 0.1);
        if (!anchors.empty())
            anchors.front() = dense[dense.size() / 2].time;
        std::sort(anchors.begin(), anchors.end());
        const Curve curve = anchoredCurve(dense, anchors, {40, 0.0});
        REQUIRE(curve.size() <= 40);
        REQUIRE(curve.front() == dense.front());
        REQUIRE(curve.back() == dense.back());
        for (const double time : anchors)
            if (time > 0.0 && time < end)
            {
                REQUIRE(hasPointAt(curve, time));
                REQUIRE(std::abs(valueAt(curve, time) - valueAt(dense, time)) < 1e-12);
            }
        REQUIRE(std::is_sorted(curve.begin(), curve.end(),
                               [](const Breakpoint& a, const Breakpoint& b) { return a.time < b.time; }));
        // A budget twice as large is no worse.
        REQUIRE(curveError(dense, anchoredCurve(dense, anchors, {80, 0.0})).rms <= curveError(dense, curve).rms + 1e-9);
    }
}

TEST_CASE("An anchored curve that can be within its tolerance is, with fewer points than its budget", "[simplify]")
{
    Curve ramp;
    for (int i = 0; i <= 1000; ++i)
        ramp.push_back({0.001 * i, 0.001 * i + (i % 2) * 0.001});
    const Curve curve = anchoredCurve(ramp, std::vector<double>{0.25}, {100, 0.002});
    REQUIRE(curve.size() == 3);
    REQUIRE(curveError(ramp, curve).max <= 0.002 + 1e-12);
}

TEST_CASE("More anchors than the budget all stay", "[simplify]")
{
    const Curve dense = wandering(3, 100);
    std::vector<double> anchors;
    for (int i = 1; i < 20; ++i)
        anchors.push_back(dense.back().time * i / 20.0);
    const Curve curve = anchoredCurve(dense, anchors, {5, 0.0});
    REQUIRE(curve.size() == anchors.size() + 2);
}

TEST_CASE("Weights draw points to where they are", "[simplify]")
{
    const Curve dense = wandering(5, 300);
    std::vector<double> weights(dense.size(), 1e-6);
    std::fill(weights.begin(), weights.begin() + 100, 1.0);
    const double until = dense[99].time;
    const auto early = [&](const Curve& curve)
    {
        return std::count_if(curve.begin(), curve.end(), [&](const Breakpoint& p) { return p.time <= until; });
    };
    REQUIRE(early(anchoredCurve(dense, {}, {60, 0.0}, weights)) > 50);
    REQUIRE(early(anchoredCurve(dense, {}, {60, 0.0})) < 40);
}

TEST_CASE("Curves of no or one point come back as they are", "[simplify]")
{
    REQUIRE(anchoredCurve(Curve{}, {}, {2, 0.0}).empty());
    REQUIRE(anchoredCurve(Curve{{1.0, 2.0}}, std::vector<double>{0.5}, {2, 0.0}) == Curve{{1.0, 2.0}});
}
