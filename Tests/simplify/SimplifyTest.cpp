#include "TestCurves.h"
#include "support/Catch.h"

#include <pacini/simplify/CurveError.h>
#include <pacini/simplify/Simplify.h>

#include <cmath>
#include <limits>

using namespace pacini;

namespace
{
constexpr SimplifyMethod everyMethod[] = {SimplifyMethod::visvalingam, SimplifyMethod::douglasPeucker,
                                          SimplifyMethod::optimal, SimplifyMethod::streaming,
                                          SimplifyMethod::lagrangian};

SimplifyParams toCount(SimplifyMethod method, std::size_t count)
{
    SimplifyParams params;
    params.method = method;
    params.count = count;
    return params;
}

SimplifyParams toBound(SimplifyMethod method, double maxError)
{
    SimplifyParams params;
    params.method = method;
    params.maxError = maxError;
    return params;
}

double rangeOf(const Curve& curve)
{
    const auto [least, most] =
        std::minmax_element(curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
    return most->value - least->value;
}
} // namespace

TEST_CASE("Every method keeps the count, the end points and the input's own points, and is idempotent", "[simplify]")
{
    for (const auto& [name, dense] : test::testCurves(400))
        for (SimplifyMethod method : everyMethod)
            for (std::size_t count : {0u, 2u, 3u, 5u, 17u, 60u, 399u})
            {
                CAPTURE(name, static_cast<int>(method), count);
                const auto params = toCount(method, count);
                const Curve curve = simplify(dense, params).value();
                CHECK(curve.size() <= std::max<std::size_t>(count, 2));
                CHECK(curve.front() == dense.front());
                CHECK(curve.back() == dense.back());
                std::size_t next = 0;
                for (const Breakpoint& p : curve)
                {
                    while (next < dense.size() && !(dense[next] == p))
                        ++next;
                    REQUIRE(next < dense.size());
                }
                CHECK(simplify(curve, params).value() == curve);
            }
}

TEST_CASE("A curve that has no more points than it may have comes back as it is, whatever could be improved",
          "[simplify]")
{
    for (auto [name, dense] : test::testCurves(60))
    {
        dense.push_back(dense.back()); // which any method would leave out
        for (SimplifyMethod method : everyMethod)
            for (const bool refit : {false, true})
            {
                CAPTURE(name, static_cast<int>(method), refit);
                for (const std::size_t more : {0u, 1u, 100u})
                {
                    auto params = toCount(method, dense.size() + more);
                    params.refit = refit;
                    params.lowest = 0.5;
                    CHECK(simplify(dense, params).value() == dense);
                }
                CHECK(simplify(dense, toCount(method, dense.size() - 1)).value().size() < dense.size());
            }
    }
}

TEST_CASE("Methods that can spend the whole count do, where the curve has use for it", "[simplify]")
{
    for (const char* name : {"noise", "strikes"})
    {
        const Curve dense =
            test::curveOfValues(name == std::string("noise") ? test::uniformNoise(2000, 4) : test::strikes(2000, 4));
        for (SimplifyMethod method :
             {SimplifyMethod::visvalingam, SimplifyMethod::douglasPeucker, SimplifyMethod::lagrangian})
            for (std::size_t count : {3u, 10u, 55u, 500u})
            {
                CAPTURE(name, static_cast<int>(method), count);
                CHECK(simplify(dense, toCount(method, count)).value().size() == count);
            }
    }
}

TEST_CASE("Every method keeps its error bound and the end points", "[simplify]")
{
    for (const auto& [name, dense] : test::testCurves(500))
        for (SimplifyMethod method : everyMethod)
            for (double relative : {0.0, 1e-4, 0.02, 0.2, 2.0})
            {
                const double bound = relative * std::max(rangeOf(dense), 0.01);
                CAPTURE(name, static_cast<int>(method), bound);
                const Curve curve = simplify(dense, toBound(method, bound)).value();
                CHECK(curveError(dense, curve).max <= bound + 1e-12 * 500.0);
                CHECK(curve.front() == dense.front());
                CHECK(curve.back() == dense.back());
                CHECK(curve.size() <= dense.size());
            }
}

TEST_CASE("Bounds whose square is infinite leave the end points of a curve of ordinary size", "[simplify]")
{
    for (const auto& [name, dense] : test::testCurves(400))
        for (SimplifyMethod method : everyMethod)
            for (double bound : {1e100, 1e160, 1e300, std::numeric_limits<double>::max()})
                for (bool refit : {false, true})
                {
                    CAPTURE(name, static_cast<int>(method), bound, refit);
                    SimplifyParams params = toBound(method, bound);
                    params.refit = refit;
                    const Curve curve = simplify(dense, params).value();
                    // One pass with a bounded delay has a point each time that is over.
                    const bool isStreaming = method == SimplifyMethod::streaming;
                    CHECK(curve.size() <= 2 + (isStreaming ? dense.size() / params.streamingDelay : 0));
                    CHECK(curve.front().time == dense.front().time);
                    CHECK(curve.back().time == dense.back().time);
                    CHECK(std::isfinite(curve.front().value));
                    CHECK(std::isfinite(curve.back().value));
                }
}

TEST_CASE("A second pass of splitting within a bound changes nothing", "[simplify]")
{
    for (const auto& [name, dense] : test::testCurves(500))
        for (double bound : {0.0, 0.02, 0.3})
        {
            const auto params = toBound(SimplifyMethod::douglasPeucker, bound);
            const Curve once = simplify(dense, params).value();
            CHECK(simplify(once, params).value() == once);
        }
}

TEST_CASE("With a bound and a count, the bound is held where the count allows it", "[simplify]")
{
    const Curve dense = test::curveOfValues(test::strikes(1000, 6));
    for (SimplifyMethod method : everyMethod)
    {
        CAPTURE(static_cast<int>(method));
        auto params = toBound(method, 0.05);
        const Curve free = simplify(dense, params).value();
        params.count = free.size();
        CHECK(simplify(dense, params).value() == free);
        params.count = free.size() / 2;
        CHECK(simplify(dense, params).value().size() <= free.size() / 2);
    }
}

TEST_CASE("Curves of no, one and two points come back as they are", "[simplify]")
{
    for (SimplifyMethod method : everyMethod)
        for (const auto& params : {toCount(method, 5), toCount(method, 0), toBound(method, 0.1)})
        {
            CHECK(simplify({}, params).value().empty());
            const Curve one{{1.0, -2.0}};
            const Curve two{{1.0, 2.0}, {1.0, 3.0}};
            CHECK(simplify(one, params).value() == one);
            CHECK(simplify(two, params).value() == two);
        }
}

TEST_CASE("Straight lines and constants become two points", "[simplify]")
{
    for (SimplifyMethod method : everyMethod)
    {
        CAPTURE(static_cast<int>(method));
        Curve line;
        for (int i = 0; i <= 300; ++i)
            line.push_back({0.25 * i, 2.0 - 0.5 * i});
        auto params = toBound(method, 1e-9);
        params.streamingDelay = 1000;
        CHECK(simplify(line, params).value() == Curve{line.front(), line.back()});
        for (Breakpoint& p : line)
            p.value = 0.3;
        CHECK(simplify(line, params).value() == Curve{line.front(), line.back()});
    }
}

TEST_CASE("Steps survive every method that has the points for them", "[simplify]")
{
    Curve dense;
    for (int i = 0; i <= 100; ++i)
        dense.push_back({0.01 * i, 0.2});
    for (int i = 100; i <= 200; ++i)
        dense.push_back({0.01 * i, 0.9});
    const Curve step{{0.0, 0.2}, {1.0, 0.2}, {1.0, 0.9}, {2.0, 0.9}};
    for (SimplifyMethod method : everyMethod)
    {
        CAPTURE(static_cast<int>(method));
        CHECK(simplify(dense, toBound(method, 1e-6)).value() == step);
        if (method != SimplifyMethod::streaming)
            CHECK(simplify(dense, toCount(method, 4)).value() == step);
    }
}

TEST_CASE("Refit lowers the RMS error, keeps the times, and respects bound and floor", "[simplify]")
{
    const Curve dense = test::curveOfValues(test::strikes(2000, 16));
    for (SimplifyMethod method : everyMethod)
    {
        CAPTURE(static_cast<int>(method));
        for (auto params : {toCount(method, 40), toBound(method, 0.04)})
        {
            params.lowest = 0.0;
            const Curve plain = simplify(dense, params).value();
            params.refit = true;
            const Curve fitted = simplify(dense, params).value();
            REQUIRE(fitted.size() == plain.size());
            for (std::size_t k = 0; k < plain.size(); ++k)
            {
                CHECK(fitted[k].time == plain[k].time);
                CHECK(fitted[k].value >= 0.0);
            }
            CHECK(curveError(dense, fitted).rms < curveError(dense, plain).rms);
            if (params.maxError)
                CHECK(curveError(dense, fitted).max <= 0.04 + 1e-12);
        }
    }
}

TEST_CASE("The choice of points does not depend on the units of value and time", "[simplify]")
{
    // Powers of two scale without rounding.
    for (const auto& [name, dense] : test::testCurves(600))
        for (SimplifyMethod method : everyMethod)
            for (double scale : {0x1.0p-40, 0x1.0p+30})
            {
                CAPTURE(name, static_cast<int>(method), scale);
                const auto scaled = [scale](Curve curve)
                {
                    for (Breakpoint& p : curve)
                        p = {p.time / scale, p.value * scale};
                    return curve;
                };
                const auto params = toCount(method, 25);
                CHECK(simplify(scaled(dense), params).value() == scaled(simplify(dense, params).value()));
                CHECK(simplify(scaled(dense), toBound(method, 0.125 * scale)).value() ==
                      scaled(simplify(dense, toBound(method, 0.125)).value()));
            }
}

TEST_CASE("Least squares by dynamic programming has the lowest RMS error of all methods", "[simplify]")
{
    for (std::uint64_t seed = 0; seed < 4; ++seed)
    {
        const Curve dense = test::curveOfValues(test::strikes(1500, 200 + seed));
        for (std::size_t count : {15u, 30u, 60u, 150u})
        {
            const double best =
                curveError(dense, simplify(dense, toCount(SimplifyMethod::lagrangian, count)).value()).rms;
            for (SimplifyMethod method : everyMethod)
            {
                CAPTURE(seed, count, static_cast<int>(method));
                CHECK(best <= 1.03 * curveError(dense, simplify(dense, toCount(method, count)).value()).rms);
            }
        }
    }
}

TEST_CASE("Very dense curves are simplified to few points by every fast method", "[simplify]")
{
    const Curve dense = test::curveOfValues(test::strikes(100'000, 300), 1e-5);
    for (SimplifyMethod method : {SimplifyMethod::visvalingam, SimplifyMethod::douglasPeucker,
                                  SimplifyMethod::streaming, SimplifyMethod::lagrangian})
    {
        CAPTURE(static_cast<int>(method));
        const Curve curve = simplify(dense, toCount(method, 100)).value();
        CHECK(curve.size() <= 100);
        CHECK(curve.size() >= 40);
        CHECK(curveError(dense, curve).max < curveError(dense, Curve{dense.front(), dense.back()}).max);
    }
}

TEST_CASE("Broken input and parameters are errors that name their place", "[simplify]")
{
    const auto failure = [](const Curve& dense, const SimplifyParams& params)
    {
        const auto result = simplify(dense, params);
        REQUIRE(!result);
        return result.error();
    };
    Curve dense = test::curveOfValues(test::uniformNoise(10, 1));
    const auto params = toCount(SimplifyMethod::visvalingam, 4);
    for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    {
        Curve broken = dense;
        broken[3].value = bad;
        CHECK(failure(broken, params).code == ErrorCode::notFinite);
        CHECK(failure(broken, params).where == "curve[3]");
        broken = dense;
        broken[4].time = bad;
        CHECK(failure(broken, params).where == "curve[4]");
        CHECK(failure(dense, toBound(SimplifyMethod::optimal, bad)).where == "params.maxError");
    }
    Curve backwards = dense;
    backwards[7].time = backwards[5].time;
    CHECK(failure(backwards, params).code == ErrorCode::invalidData);
    CHECK(failure(backwards, params).where == "curve[7].time");
    CHECK(failure(dense, toBound(SimplifyMethod::optimal, -1e-9)).code == ErrorCode::invalidArgument);
    CHECK(failure(dense, SimplifyParams{}).code == ErrorCode::invalidArgument);
    auto hasty = toBound(SimplifyMethod::streaming, 0.1);
    hasty.streamingDelay = 0;
    CHECK(failure(dense, hasty).where == "params.streamingDelay");
}

TEST_CASE("Every method ends and keeps its promise at any magnitude from 5e-324 to 1e308", "[simplify]")
{
    const auto scaled = [](Curve curve, double value, double time)
    {
        for (Breakpoint& p : curve)
            p = {p.time * time, p.value * value};
        return curve;
    };
    const auto largestError = [](const Curve& dense, const Curve& curve)
    {
        // In long double, whose range holds the square of any double.
        long double largest = 0.0L;
        std::size_t k = 0;
        for (const Breakpoint& p : dense)
        {
            while (k + 2 < curve.size() && curve[k + 1].time < p.time)
                ++k;
            const auto &a = curve[k], &b = curve[k + 1];
            const long double part =
                (test::wide(p.time) - test::wide(a.time)) / (test::wide(b.time) - test::wide(a.time));
            largest =
                std::max(largest, std::abs(test::wide(a.value) + part * (test::wide(b.value) - test::wide(a.value)) -
                                           test::wide(p.value)));
        }
        return largest;
    };
    std::vector<double> wide = test::uniformNoise(300, 8); // of both signs: differences exceed the largest double
    for (double& v : wide)
        v = 2.0 * v - 1.0;
    const Curve noise = test::curveOfValues(wide);
    for (double value : {5e-324, 1e-320, 1e-310, 1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300, 1e308, 1.7e308})
        for (double time : {1.0, 1e-300, 1e300})
            for (SimplifyMethod method : everyMethod)
            {
                CAPTURE(value, time, static_cast<int>(method));
                const Curve dense = scaled(noise, value, time);
                const Curve counted = simplify(dense, toCount(method, 50)).value();
                CHECK(counted.size() <= 50);
                CHECK(counted.front() == dense.front());
                CHECK(counted.back() == dense.back());
                if (value > 1e-310 && method != SimplifyMethod::streaming && method != SimplifyMethod::optimal)
                    CHECK(counted.size() == 50);
                if (value > 1e-310 && method == SimplifyMethod::optimal)
                    CHECK(counted.size() > 40);
                const double bound = 0.3 * value;
                auto params = toBound(method, bound);
                const Curve within = simplify(dense, params).value();
                CHECK(largestError(dense, within) <= test::wide(bound) * 1.000001L + 5e-324L);
                params.refit = true;
                const Curve fitted = simplify(dense, params).value();
                for (const Breakpoint& p : fitted)
                    REQUIRE((std::isfinite(p.time) && std::isfinite(p.value)));
            }
}

TEST_CASE("The choice of points is the same at extreme magnitudes as at ordinary ones", "[simplify]")
{
    for (const auto& [name, dense] : test::testCurves(300))
        for (SimplifyMethod method : everyMethod)
            for (double scale : {0x1.0p-900, 0x1.0p+1000})
            {
                CAPTURE(name, static_cast<int>(method), scale);
                Curve scaled = dense;
                for (Breakpoint& p : scaled)
                    p.value *= scale;
                Curve expected = simplify(dense, toCount(method, 25)).value();
                for (Breakpoint& p : expected)
                    p.value *= scale;
                CHECK(simplify(scaled, toCount(method, 25)).value() == expected);
            }
}
