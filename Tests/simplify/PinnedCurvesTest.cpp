#include "TestCurves.h"
#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/simplify/AnchoredCurve.h>
#include <pacini/simplify/BudgetSpread.h>
#include <pacini/simplify/CurveError.h>
#include <pacini/simplify/Simplify.h>
#include <pacini/simplify/SimplifyLanes.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace pacini;

namespace
{

/// Unlike curves without ties: noise, struck sounds, irregular times with steps, a sine, and strikes between a very
/// quiet floor.
std::vector<std::pair<std::string, Curve>> pinnedCurves()
{
    std::vector<std::pair<std::string, Curve>> curves;
    curves.emplace_back("noise", test::curveOfValues(test::uniformNoise(150, 11)));
    curves.emplace_back("strikes", test::curveOfValues(test::strikes(1200, 12)));
    curves.emplace_back("irregular", test::irregular(160, 13));
    std::vector<double> sweep(300), quiet = test::strikes(900, 14);
    for (std::size_t i = 0; i < sweep.size(); ++i)
        sweep[i] = 300.0 + 200.0 * std::sin(1e-3 * std::pow(static_cast<double>(i), 1.7));
    curves.emplace_back("sweep", test::curveOfValues(sweep, 0.01));
    const auto floor = test::uniformNoise(900, 15);
    for (std::size_t i = 0; i < quiet.size(); ++i)
        quiet[i] = (i / 200 % 2 == 0 ? quiet[i] : 0.0) + 1e-5 * floor[i];
    curves.emplace_back("quiet", test::curveOfValues(quiet));
    return curves;
}

void addPinned(std::vector<double>& all, const Curve& curve)
{
    all.push_back(static_cast<double>(curve.size()));
    for (const Breakpoint& p : curve)
    {
        all.push_back(p.time);
        all.push_back(p.value);
    }
}

void addPinned(std::vector<double>& all, const KeptPoints& kept)
{
    all.push_back(static_cast<double>(kept.size()));
    for (const std::size_t i : kept)
        all.push_back(static_cast<double>(i));
}

constexpr std::pair<SimplifyMethod, const char*> pinnedMethods[] = {
    {SimplifyMethod::visvalingam, "visvalingam"}, {SimplifyMethod::douglasPeucker, "douglasPeucker"},
    {SimplifyMethod::optimal, "optimal"},         {SimplifyMethod::streaming, "streaming"},
    {SimplifyMethod::lagrangian, "lagrangian"},
};

} // namespace

TEST_CASE("Every method chooses the pinned points of unlike curves", "[simplify]")
{
    for (const auto& [name, dense] : pinnedCurves())
    {
        const Curve& curve = dense; // for lambdas
        double low = 1e300, high = -1e300;
        for (const Breakpoint& p : curve)
        {
            low = std::min(low, p.value);
            high = std::max(high, p.value);
        }
        const double range = high - low;
        for (const auto& [method, methodName] : pinnedMethods)
        {
            CAPTURE(name, methodName);
            std::vector<double> counted, bounded, refitted;
            const auto run = [&](std::vector<double>& all, const SimplifyParams& params)
            {
                const auto simplified = simplify(curve, params);
                REQUIRE(simplified.ok());
                addPinned(all, *simplified);
            };
            if (method == SimplifyMethod::optimal && curve.size() > 200)
                continue; // it takes long
            for (const std::size_t count : {2u, 3u, 5u, 11u, 24u, 60u})
                run(counted, {method, count, {}});
            for (const double share : {0.3, 0.1, 0.03, 0.004})
                run(bounded, {method, {}, share * range});
            run(bounded, {method, 20, 0.02 * range});
            run(bounded, {method, {}, 0.0});
            run(refitted, {method, {}, 0.07 * range, true});
            run(refitted, {method, 12, {}, true, low});
            run(refitted, {method, {}, 0.2 * range, true, low});
            run(refitted, {method, 9, 0.01 * range, true, low + 0.1 * range});
            if (method == SimplifyMethod::streaming)
                for (const std::size_t delay : {1u, 2u, 17u, 60u})
                {
                    run(bounded, {method, {}, 0.05 * range, false, low, delay});
                    run(counted, {method, 30, {}, false, low, delay});
                }
            const std::string line = std::string("simplify/") + methodName + ", " + name + ", ";
            checkPinned(line + "count", counted);
            checkPinned(line + "bound", bounded);
            checkPinned(line + "refit", refitted);
        }
    }
}

TEST_CASE("A long dense curve is thinned to the pinned points before the search", "[simplify]")
{
    const Curve curve = test::curveOfValues(test::strikes(6000, 21));
    for (const std::size_t count : {4u, 10u, 20u})
    {
        std::vector<double> all;
        addPinned(all, lagrangianToCount(curve, count));
        checkPinned("simplify/thinned to " + std::to_string(count), all);
    }
    // 24 samples per point wanted are searched as they are, 25 are thinned first.
    std::vector<double> borders;
    for (const std::size_t count : {239u, 240u, 241u, 250u})
        addPinned(borders, lagrangianToCount(curve, count));
    checkPinned("simplify/at 24 samples per point", borders);
}

TEST_CASE("The segmenter chooses the pinned points at unlike prices and windows", "[simplify]")
{
    for (const auto& [name, dense] : pinnedCurves())
    {
        const Curve& curve = dense; // for lambdas
        const auto values = test::valuesOf(curve);
        std::vector<double> times, weights;
        for (const Breakpoint& p : curve)
        {
            times.push_back(p.time);
            weights.push_back(0.1 + std::abs(std::sin(0.3 * static_cast<double>(times.size()))));
        }
        const double scale = name == "sweep" ? 1e4 : 1.0;
        std::vector<double> all;
        for (const std::size_t window : {1u, 7u, 8u, 9u, 40u, 256u})
        {
            LagrangianSegmenter segmenter(window);
            KeptPoints kept;
            for (const double price : {1e-10, 1e-6, 1e-3, 0.1, 3.0})
            {
                const std::size_t count = segmenter.solve({values, {}, {}}, scale * price, kept);
                CHECK(count == kept.size());
                addPinned(all, kept);
                segmenter.solve({values, times, weights}, scale * price, kept);
                addPinned(all, kept);
                segmenter.solve({values, {}, weights}, scale * price, kept);
                addPinned(all, kept);
            }
        }
        checkPinned("simplify/segmenter, " + name, all);
    }
}

TEST_CASE("A shared budget is spread as pinned", "[simplify]")
{
    const auto curves = pinnedCurves();
    std::vector<std::vector<double>> values, times;
    for (const auto& [name, curve] : curves)
    {
        values.push_back(test::valuesOf(curve));
        times.emplace_back();
        for (const Breakpoint& p : curve)
            times.back().push_back(p.time);
        if (name == "sweep")
            for (double& v : values.back())
                v *= 1e-3;
    }
    for (const std::size_t budget : {10u, 12u, 19u, 39u, 40u, 41u, 70u, 150u, 400u, 1200u, 2500u, 4000u})
        for (const double first : {0.0, 1e-3})
        {
            std::vector<BudgetCurve> tasks;
            for (std::size_t c = 0; c < values.size(); ++c)
            {
                const auto ownTimes = c == 2 ? std::span<const double>(times[c]) : std::span<const double>();
                tasks.push_back({{values[c], ownTimes, {}}, 1.0 + 0.7 * static_cast<double>(c), 2});
            }
            if (budget > 12)
                tasks[0].minimum = 5;
            const auto shares = BudgetSpread(64).spread(tasks, budget, first);
            REQUIRE(shares.ok());
            std::vector<double> all = {shares->pointCost};
            for (const KeptPoints& kept : shares->kept)
                addPinned(all, kept);
            all.push_back(weightedError(tasks, shares->kept));
            checkPinned("simplify/budget of " + std::to_string(budget) + (first > 0.0 ? ", first price" : ""), all);
        }
}

TEST_CASE("Anchored curves have the pinned points", "[simplify]")
{
    for (const auto& [name, dense] : pinnedCurves())
    {
        const Curve& curve = dense; // for lambdas
        const double end = curve.back().time, start = curve.front().time;
        const auto at = [&](double share)
        {
            return start + share * (end - start);
        };
        std::vector<double> weights;
        for (std::size_t i = 0; i < curve.size(); ++i)
            weights.push_back(i < curve.size() / 2 ? 0.1 : 2.0);
        const std::vector<double> anchors = {start - 1.0, start, at(0.1),  at(0.2501), curve[curve.size() / 2].time,
                                             at(0.77),    end,   end + 1.0};
        std::vector<double> all;
        for (const std::size_t count : {2u, 8u, 13u, 40u})
            for (const double tolerance : {0.0, 0.05, 0.4})
            {
                addPinned(all, anchoredCurve(curve, anchors, {count, tolerance}));
                addPinned(all, anchoredCurve(curve, anchors, {count, tolerance}, weights));
                addPinned(all, anchoredCurve(curve, {}, {count, tolerance}, weights));
            }
        checkPinned("simplify/anchored, " + name, all);
    }
}

TEST_CASE("Errors over points and over time are the pinned ones", "[simplify]")
{
    const auto curves = pinnedCurves();
    for (const auto& [name, dense] : curves)
    {
        std::vector<double> all;
        for (const auto& [otherName, other] : curves)
            for (const ErrorMean mean : {ErrorMean::points, ErrorMean::time})
            {
                const CurveError error = curveError(dense, other, mean);
                all.push_back(error.max);
                all.push_back(error.rms);
            }
        checkPinned("simplify/curve errors, " + name, all);
    }
}

TEST_CASE("Streams of both rules hand over the pinned vertices", "[simplify]")
{
    for (const auto& [name, dense] : pinnedCurves())
    {
        const Curve& curve = dense; // for lambdas
        std::vector<double> all;
        const auto run = [&](const StreamingParams& params)
        {
            StreamingSimplifier simplifier;
            simplifier.prepare(params);
            std::size_t pushed = 0;
            const auto sink = [&](const Breakpoint& p)
            {
                all.push_back(static_cast<double>(pushed)); // when it was decided
                all.push_back(p.time);
                all.push_back(p.value);
            };
            const auto pushAll = [&]
            {
                pushed = 0;
                for (const Breakpoint& p : curve)
                {
                    ++pushed;
                    simplifier.push(p, sink);
                }
                simplifier.finish(sink);
            };
            const std::size_t before = all.size();
            pushAll();
            const std::vector<double> first(all.begin() + static_cast<std::ptrdiff_t>(before), all.end());
            all.resize(before);
            pushAll(); // a new curve is as the first
            CHECK(std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(before), all.end()) == first);
        };
        for (const double tolerance : {0.0, 0.01, 0.2})
            for (const std::size_t delay : {1u, 3u, 50u, 600u})
            {
                run({StreamingRule::tolerance, tolerance, 0.02, delay});
                run({StreamingRule::tolerance, tolerance, 0.02, delay, 0.0});
                run({StreamingRule::tolerance, tolerance, 0.02, delay, 0.3});
            }
        for (const double rate : {0.0, 0.03, 0.3, 1.0})
            for (const std::size_t delay : {1u, 2u, 5u, 20u, 90u})
                run({StreamingRule::rate, 0.01, rate, delay});
        checkPinned("simplify/streams, " + name, all);
    }
}
