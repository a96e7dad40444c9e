#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/foundation/Random.h>
#include <pacini/linearize/ClockDrift.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
/// A point each quarter of a second of a drift and steps, with noise of `noise` s.
std::vector<DelayPoint> driftPoints(std::size_t count, double drift, const std::vector<DelayStep>& steps,
                                    double noise = 0.0)
{
    Random random(11);
    std::vector<DelayPoint> points;
    for (std::size_t i = 0; i < count; ++i)
    {
        DelayPoint point;
        point.time = 2.0 + 0.25 * static_cast<double>(i);
        point.sinceThen = point.time - 1.5;
        point.delay = drift * point.sinceThen + noise * random.uniform(-1.0, 1.0);
        for (const DelayStep& step : steps)
            point.delay += point.time >= step.time ? step.seconds : 0.0;
        point.deviation = 2e-6 * (1.0 + static_cast<double>(i % 3));
        points.push_back(point);
    }
    return points;
}

/// The same at one distance from the reference, where nothing leans.
std::vector<DelayPoint> levelPoints(std::size_t count, double delay, const std::vector<DelayStep>& steps)
{
    auto points = driftPoints(count, 0.0, steps);
    for (DelayPoint& point : points)
    {
        point.sinceThen = 1.0;
        point.delay += delay;
    }
    return points;
}

/// The middle of a sorted list, the upper one of two.
double driftMedian(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

std::vector<double> driftValues(const DelayFit& fit)
{
    std::vector<double> values{1e6 * fit.drift, static_cast<double>(fit.steps.size())};
    for (const DelayStep& step : fit.steps)
    {
        values.push_back(step.time);
        values.push_back(1e3 * step.seconds);
    }
    return values;
}
} // namespace

TEST_CASE("A drift without steps is that of its line, whatever the noise of single points", "[linearize]")
{
    for (const double drift : {-3e-4, 0.0, 5e-5})
        for (const std::size_t count : {1u, 2u, 5u, 6u, 40u})
        {
            CAPTURE(drift, count);
            const auto fit = fitDelays(driftPoints(count, drift, {}), 1e-5);
            REQUIRE(fit.has_value());
            CHECK(fit->drift == Approx(drift).margin(1e-12));
            CHECK(fit->steps.empty());
        }
    CHECK_FALSE(fitDelays({}, 1e-5).has_value());
    auto loners = driftPoints(40, 1e-4, {});
    loners[7].delay += 3e-3;
    loners[21].delay -= 5e-3;
    loners[39].delay += 4e-3;
    loners[0].delay += 4e-3;
    const auto fit = fitDelays(loners, 1e-5).value();
    CHECK(fit.drift == Approx(1e-4).margin(1e-12));
    CHECK(fit.steps.empty());
}

TEST_CASE("Steps are found between the points where they are, up to eight", "[linearize]")
{
    const std::vector<DelayStep> one{{6.1, -0.002}};
    const auto single = fitDelays(driftPoints(60, 4e-5, one), 1e-5).value();
    CHECK(single.drift == Approx(4e-5).margin(1e-12));
    REQUIRE(single.steps.size() == 1);
    CHECK(single.steps[0].time == Approx(6.125)); // half way from 6 to 6.25 s
    CHECK(single.steps[0].seconds == Approx(-0.002));

    const std::vector<DelayStep> three{{5.0, -0.004}, {9.1, 0.001}, {13.0, -0.02}};
    const auto several = fitDelays(driftPoints(60, -2e-5, three), 1e-5).value();
    CHECK(several.drift == Approx(-2e-5).margin(1e-12));
    REQUIRE(several.steps.size() == 3);
    for (std::size_t i = 0; i < 3; ++i)
    {
        CHECK(several.steps[i].seconds == Approx(three[i].seconds));
        CHECK(several.steps[i].time == Approx(three[i].time).margin(0.126));
        if (i > 0)
            CHECK(several.steps[i].time > several.steps[i - 1].time);
    }
    std::vector<DelayStep> many;
    for (int i = 0; i < 10; ++i)
        many.push_back({4.0 + 3.0 * i, 0.1 * std::pow(-0.2, (7 * i) % 10)});
    const auto most = fitDelays(levelPoints(140, 0.0, many), 1e-9).value();
    REQUIRE(most.steps.size() == 8); // without the two smallest
    many.erase(std::remove_if(many.begin(), many.end(), [](const DelayStep& s) { return std::abs(s.seconds) < 1e-6; }),
               many.end());
    REQUIRE(many.size() == 8);
    for (std::size_t i = 0; i < 8; ++i)
    {
        CHECK(most.steps[i].seconds == Approx(many[i].seconds).epsilon(0.1));
        CHECK(most.steps[i].time == Approx(many[i].time - 0.125));
    }
}

TEST_CASE("A step has three points on both sides and is as large as is asked for", "[linearize]")
{
    const auto steps = [](std::size_t count, double time, double seconds, double least)
    {
        return fitDelays(levelPoints(count, 1e-5, {{time, seconds}}), least)->steps.size();
    };
    CHECK(steps(40, 2.75, 0.001, 1e-5) == 1);  // 2, 2.25 and 2.5 s before it
    CHECK(steps(40, 11.25, 0.001, 1e-5) == 1); // 11.25, 11.5 and 11.75 s behind it
    CHECK(steps(40, 6.0, 0.001, 1e-3 - 1e-9) == 1);
    CHECK(steps(40, 6.0, 0.001, 1e-3 + 1e-9) == 0);
    CHECK(steps(40, 6.0, -0.001, 1e-3 + 1e-9) == 0);
    CHECK(steps(6, 2.75, 0.001, 1e-5) == 1);
    CHECK(steps(5, 2.75, 0.001, 1e-5) == 0);
}

TEST_CASE("What is late because of steps is the sum of those before", "[linearize]")
{
    const DelayFit fit{1e-5, {{3.0, -0.5}, {7.0, 0.25}}};
    CHECK(fit.steppedAt(2.999) == 0.0);
    CHECK(fit.steppedAt(3.0) == -0.5);
    CHECK(fit.steppedAt(7.0) == -0.25);
    CHECK(DelayFit{}.drift == 0.0);
    CHECK(DelayStep{}.time == 0.0);
    CHECK(DelayStep{}.seconds == 0.0);
    CHECK(detail::DriftSolution{}.error == 0.0);
}

TEST_CASE("The drift equations are those of weighted least squares", "[linearize]")
{
    auto points = driftPoints(9, 3e-5, {{3.0, 0.002}}, 1e-4);
    points[2].deviation = 1e-9; // counts as 1 us
    points[5].deviation = 1e-6;
    SECTION("of points that are certain") {}
    SECTION("of points that are not, whose weights are small")
    {
        for (DelayPoint& point : points)
            point.deviation *= 1e6;
    }
    const detail::DriftEquations equations(points);
    // by the normal equations of columns [sinceThen, 1 from the split on], solved by Cramer's rule
    const std::size_t split = 4;
    double tt = 0.0, ts = 0.0, ss = 0.0, td = 0.0, sd = 0.0;
    const auto weightOf = [&](std::size_t i)
    {
        const double deviation = std::max(points[i].deviation, 1e-6);
        return 1.0 / (deviation * deviation);
    };
    for (std::size_t i = 0; i < 9; ++i)
    {
        const double w = weightOf(i), t = points[i].sinceThen, s = i >= split ? 1.0 : 0.0, d = points[i].delay;
        tt += w * t * t;
        ts += w * t * s;
        ss += w * s * s;
        td += w * t * d;
        sd += w * s * d;
    }
    const double drift = (td * ss - sd * ts) / (tt * ss - ts * ts);
    const double step = (sd * tt - td * ts) / (tt * ss - ts * ts);
    double error = 0.0, plain = 0.0;
    for (std::size_t i = 0; i < 9; ++i)
    {
        error += weightOf(i) * std::pow(points[i].delay - drift * points[i].sinceThen - (i >= split ? step : 0.0), 2);
        plain += weightOf(i) * std::pow(points[i].delay - td / tt * points[i].sinceThen, 2);
    }
    const auto solved = equations.solve(std::vector<std::size_t>{split});
    REQUIRE(solved.values.size() == 2);
    CHECK(solved.values(0) == Approx(drift));
    CHECK(solved.values(1) == Approx(step));
    CHECK(solved.error == Approx(error));
    const auto without = equations.solve({});
    REQUIRE(without.values.size() == 1);
    CHECK(without.values(0) == Approx(td / tt));
    CHECK(without.error == Approx(plain));
    // two steps, in any order
    const auto two = equations.solve(std::vector<std::size_t>{6, 3});
    const auto turned = equations.solve(std::vector<std::size_t>{3, 6});
    CHECK(two.values(1) == Approx(turned.values(2)));
    CHECK(two.values(2) == Approx(turned.values(1)));
}

TEST_CASE("Points are kept when they are near the median of the five around them", "[linearize]")
{
    const auto kept = [](std::vector<DelayPoint> points)
    {
        std::vector<double> times;
        for (const DelayPoint& point : detail::withoutLoners(points))
            times.push_back(point.time);
        return times;
    };
    // a step stays whole, at the ends too
    CHECK(kept(levelPoints(20, 0.0, {{2.75, 0.01}})).size() == 20);
    CHECK(kept(levelPoints(20, 0.0, {{6.25, 0.01}})).size() == 20);
    CHECK(kept(levelPoints(20, 0.0, {{4.1, 0.01}})).size() == 20);
    for (const std::size_t at : {0u, 1u, 2u, 10u, 17u, 18u, 19u})
    {
        auto points = levelPoints(20, 0.0, {});
        points[at].delay = 2e-4;
        const auto times = kept(points);
        CAPTURE(at);
        CHECK(times.size() == 19);
        CHECK(std::find(times.begin(), times.end(), points[at].time) == times.end());
        points[at].delay = 0.9e-5; // 10 us beside the median belong to it
        CHECK(kept(points).size() == 20);
    }
    // Any noise, by the definition: ten times the usual distance and 10 us.
    for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 30u, 31u})
        for (std::uint64_t seed = 1; seed <= 12; ++seed)
        {
            Random random(seed);
            auto points = levelPoints(count, 0.0, {});
            double mean = 0.0, weights = 0.0;
            for (DelayPoint& point : points)
            {
                point.delay = 1e-5 * std::pow(random.uniform(-1.0, 1.0), 3) / (0.02 + random.uniform());
                mean += point.delay / (point.deviation * point.deviation);
                weights += 1.0 / (point.deviation * point.deviation);
            }
            mean /= weights;
            std::vector<double> distance;
            for (std::size_t i = 0; i < count; ++i)
            {
                std::size_t begin = i < 2 ? 0 : i - 2;
                while (begin > 0 && begin + 5 > count)
                    --begin;
                std::vector<double> around;
                for (std::size_t k = begin; k < std::min(count, begin + 5); ++k)
                    around.push_back(points[k].delay - mean);
                distance.push_back(std::abs(points[i].delay - mean - driftMedian(around)));
            }
            std::vector<double> wanted;
            for (std::size_t i = 0; i < count; ++i)
                if (distance[i] <= 10.0 * driftMedian(distance) + 1e-5)
                    wanted.push_back(points[i].time);
            CAPTURE(count, seed);
            CHECK(kept(points) == wanted);
        }
    CHECK(kept(driftPoints(20, 3e-4, {})).size() == 20); // a drift is no distance
}

TEST_CASE("Fits of noisy delays are those that they were", "[linearize]")
{
    const std::vector<DelayStep> two{{5.1, -0.0006}, {8.7, 0.0011}};
    std::vector<double> values;
    for (const double noise : {1e-6, 3e-5, 1e-4})
        for (const std::size_t count : {24u, 50u})
            for (const double v : driftValues(fitDelays(driftPoints(count, 7e-5, two, noise), 2e-5).value()))
                values.push_back(v);
    checkPinned("linearize/delay fit", values, 1e-6);
    // bands across a step hold some of both delays
    auto points = driftPoints(50, 7e-5, {{7.1, 0.001}});
    for (std::size_t i = 17; i < 25; ++i)
        points[i].delay += 1e-5 * (static_cast<double>(i) - 21.5) * (static_cast<double>(i) - 17.3);
    checkPinned("linearize/delay fit across a step", driftValues(fitDelays(points, 2e-5).value()), 1e-6);
    auto few = driftPoints(8, 7e-5, {{3.0, 0.001}});
    few[2].delay += 1e-5;
    few[6].delay -= 2e-5;
    checkPinned("linearize/delay fit of eight points", driftValues(fitDelays(few, 2e-5).value()), 1e-6);
    for (const std::size_t count : {11u, 12u, 13u, 14u, 15u, 16u})
    {
        auto some = driftPoints(count, 7e-5, {{3.3, 0.001}}, 2e-6);
        checkPinned("linearize/delay fit of " + std::to_string(count) + " points",
                    driftValues(fitDelays(some, 2e-5).value()), 1e-6);
    }
}
