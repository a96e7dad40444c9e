#include "document/DrawnCurve.h"

#include "support/Catch.h"

#include <pacini/foundation/Random.h>

#include <cmath>

using namespace pacini;

namespace
{
const CurveLimits tenSeconds{10.0, {0.0, 1000.0}};
const TimeAxis axis{0.0, 0.01};
const ValueAxis decibels{ValueScale::decibels, 0.001, 1.0, 120.0};
const ValueAxis linear{ValueScale::linear, 0.0, 1.0, 120.0};
} // namespace

TEST_CASE("A stroke that goes back counts where it went last")
{
    Stroke stroke;
    stroke.begin(10.0, 50.0);
    stroke.to(20.0, 50.0);
    stroke.to(15.0, 30.0);
    CHECK(stroke.columns().size() == 11);
    CHECK(stroke.columns().at(12) == 50.0);
    CHECK(stroke.columns().at(15) == 30.0);
    CHECK(stroke.columns().at(18) == Approx(42.0));
}

TEST_CASE("A drawn curve passes within a pixel of the stroke with few points, on every scale")
{
    for (const ValueAxis& values : {decibels, linear, ValueAxis{ValueScale::logarithmic, 20.0, 1500.0, 90.0}})
    {
        Stroke stroke;
        stroke.begin(100.0, 60.0);
        for (int x = 103; x <= 500; x += 3)
            stroke.to(x, 45.0 + 30.0 * std::sin(0.02 * x));
        const Curve points = pointsOf(stroke, axis, values, {10.0, {0.0, 1500.0}});
        CHECK(points.size() > 4);
        CHECK(points.size() < 40);
        const Curve old = {{0.0, 0.3}, {10.0, 0.3}};
        const EditedCurve drawn = withDrawn(old, points, {10.0, {0.0, 1500.0}});
        for (const auto& [x, y] : stroke.columns())
            CHECK(values.yOf(x < stroke.columns().rbegin()->first
                                 ? valueAt(drawn.curve, axis.timeAt(x))
                                 : valueBefore(drawn.curve, axis.timeAt(x))) == Approx(y).margin(1.01));
        // Nothing changes beside it.
        CHECK(valueAt(drawn.curve, 0.99) == 0.3);
        CHECK(valueAt(drawn.curve, 5.01) == 0.3);
        REQUIRE(drawn.selection.size() == points.size());
        for (std::size_t i = 0; i < points.size(); ++i)
            CHECK(drawn.curve[drawn.selection[i]] == points[i]);
    }
}

TEST_CASE("A stroke stays inside the clip and inside the lane")
{
    Stroke stroke;
    stroke.begin(-50.0, -40.0);
    stroke.to(1500.0, 300.0);
    const Curve points = pointsOf(stroke, axis, linear, tenSeconds);
    REQUIRE(points.size() >= 2);
    CHECK(points.front().time >= 0.0);
    CHECK(points.back().time <= 10.0);
    CHECK(points.front().value == 1.0);
    CHECK(points.back().value == 0.0);
}

TEST_CASE("A click with the pencil adds one point")
{
    Stroke stroke;
    stroke.begin(200.0, 60.0);
    const Curve old = {{0.0, 0.2}, {10.0, 0.2}};
    const EditedCurve drawn = withDrawn(old, pointsOf(stroke, axis, linear, tenSeconds), tenSeconds);
    CHECK(drawn.curve == Curve{{0.0, 0.2}, {2.0, 0.5}, {10.0, 0.2}});
    CHECK(drawn.selection == Indices{1});
}

TEST_CASE("A curve that was empty holds only what was drawn")
{
    Stroke stroke;
    stroke.begin(100.0, 60.0);
    stroke.to(200.0, 0.0);
    const EditedCurve drawn = withDrawn({}, pointsOf(stroke, axis, linear, tenSeconds), tenSeconds);
    CHECK(drawn.curve == Curve{{1.0, 0.5}, {2.0, 1.0}});
}

TEST_CASE("A bent line passes through the pointer, keeps its ends and is a parabola on the screen")
{
    Random random(4);
    for (int i = 0; i < 100; ++i)
    {
        const ValueAxis& values = i % 2 == 0 ? decibels : linear;
        const Curve curve = {
            {0.0, 0.1}, {1.0, random.uniform(0.05, 0.5)}, {5.0, random.uniform(0.05, 0.5)}, {9.0, 0.2}};
        const double grabbed = random.uniform(1.5, 4.5);
        const double dy = random.uniform(-20.0, 20.0);
        const EditedCurve bent = bentLine(curve, 1, grabbed, dy, axis, values, tenSeconds);
        REQUIRE(bent.curve.size() == curve.size() + bent.selection.size());
        CHECK(bent.curve.size() < 60);
        CHECK(bent.curve[1] == curve[1]);
        CHECK(bent.curve[bent.curve.size() - 2] == curve[2]);
        CHECK(bent.curve.back() == curve.back());
        const auto height = [&](const Curve& c, double time)
        {
            return values.yOf(valueAt(c, time));
        };
        const double x = (grabbed - 1.0) / 4.0;
        for (const double time : {1.3, 2.0, grabbed, 3.3, 4.9})
        {
            const double t = (time - 1.0) / 4.0;
            const double wanted = height(curve, time) + dy * t * (1.0 - t) / (x * (1.0 - x));
            if (wanted > 1.0 && wanted < values.height - 1.0)
                CHECK(height(bent.curve, time) == Approx(wanted).margin(0.7));
        }
    }
}

TEST_CASE("Lines of no length or behind the last point do not bend")
{
    const Curve curve = {{0.0, 0.1}, {1.0, 0.5}, {1.0, 0.2}};
    CHECK(bentLine(curve, 1, 1.0, 10.0, axis, linear, tenSeconds).curve == curve);
    CHECK(bentLine(curve, 2, 1.5, 10.0, axis, linear, tenSeconds).curve == curve);
    CHECK(bentLine({}, 0, 0.0, 10.0, axis, linear, tenSeconds).curve.empty());
}
