#include "document/view/Columns.h"
#include "document/view/EventKind.h"
#include "document/view/HitTest.h"
#include "document/view/LevelCurve.h"
#include "document/view/Snap.h"
#include "document/view/TimeAxis.h"
#include "document/view/TimeTicks.h"
#include "document/view/ValueAxis.h"
#include "support/Catch.h"

#include <pacini/foundation/Random.h>

#include <cmath>

using namespace pacini;

namespace
{
Curve noisyCurve(std::uint64_t seed, std::size_t points, double duration)
{
    Random random(seed);
    Curve curve;
    for (std::size_t i = 0; i < points; ++i)
        curve.push_back({random.uniform(0.0, duration), random.uniform()});
    std::sort(curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    return curve;
}
} // namespace

TEST_CASE("Axes map there and back, and zooming holds what is under the pointer")
{
    Random random(1);
    for (int i = 0; i < 500; ++i)
    {
        TimeAxis time{random.uniform(0.0, 100.0), random.uniform(1e-4, 0.1)};
        const double x = random.uniform(0.0, 1000.0);
        CHECK(time.xOf(time.timeAt(x)) == Approx(x).margin(1e-6));
        const TimeAxis closer = time.zoomed(random.uniform(0.2, 5.0), x);
        CHECK(closer.timeAt(x) == Approx(time.timeAt(x)));
        for (const ValueScale scale : {ValueScale::linear, ValueScale::decibels, ValueScale::logarithmic})
        {
            const ValueAxis value{scale, scale == ValueScale::logarithmic ? 30.0 : 0.001,
                                  scale == ValueScale::logarithmic ? 1000.0 : 1.0, 200.0};
            const double y = random.uniform(0.0, 199.0);
            CHECK(value.yOf(value.valueAtY(y)) == Approx(y).margin(1e-6));
            const ValueAxis zoomed = value.zoomed(random.uniform(0.5, 4.0), y);
            CHECK(zoomed.valueAtY(y) == Approx(value.valueAtY(y)));
        }
    }
    const ValueAxis dB{ValueScale::decibels, 0.001, 1.0, 60.0};
    CHECK(dB.yOf(1.0) == Approx(0.0).margin(1e-12));
    CHECK(dB.yOf(0.1) == Approx(20.0)); // -20 dB of 60, one pixel each
    CHECK(dB.yOf(0.0) == Approx(60.0));
    CHECK(dB.valueAtY(60.0) == 0.0);
    const TimeAxis before{-5.0, 0.01};
    CHECK(before.keptInside(20.0, 500.0).start == 0.0);
    CHECK(TimeAxis{19.0, 0.01}.keptInside(20.0, 500.0).start == Approx(15.0));
}

TEST_CASE("The hit test finds the point that a search of all points finds")
{
    const Curve curve = noisyCurve(3, 20000, 60.0);
    const ValueAxis value{ValueScale::linear, 0.0, 1.0, 300.0};
    Random random(5);
    int hits = 0;
    for (int i = 0; i < 300; ++i)
    {
        const TimeAxis time{random.uniform(0.0, 50.0), random.uniform(1e-5, 1e-2)};
        const double x = random.uniform(0.0, 1000.0);
        const double y = random.uniform(0.0, 300.0);
        double nearest = 8.0;
        for (const Breakpoint& p : curve)
            nearest = std::min(nearest, std::hypot(time.xOf(p.time) - x, value.yOf(p.value) - y));
        const auto hit = pointAt(curve, time, value, x, y, 8.0);
        CHECK(hit.has_value() == (nearest < 8.0));
        if (hit)
            CHECK(std::hypot(time.xOf(curve[*hit].time) - x, value.yOf(curve[*hit].value) - y) == Approx(nearest));
        hits += hit ? 1 : 0;
    }
    CHECK(hits > 30);
}

TEST_CASE("Columns hold every value that the curve has in them, and none that it has not")
{
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
        const Curve curve = noisyCurve(seed, seed == 1 ? 0 : 40 * seed * seed, 10.0);
        Random random(seed);
        const TimeAxis time{random.uniform(-2.0, 8.0), random.uniform(1e-4, 0.02)};
        std::vector<Column> columns(400);
        curveColumns(curve, time, columns);
        for (std::size_t i = 0; i < columns.size(); ++i)
        {
            const double a = time.timeAt(static_cast<double>(i));
            const double b = time.timeAt(static_cast<double>(i) + 1.0);
            double low = std::min(valueAt(curve, a), valueAt(curve, b));
            double high = std::max(valueAt(curve, a), valueAt(curve, b));
            for (const Breakpoint& p : curve)
                if (p.time >= a && p.time <= b)
                {
                    low = std::min(low, p.value);
                    high = std::max(high, p.value);
                }
            CHECK(columns[i].low == Approx(low).margin(1e-5));
            CHECK(columns[i].high == Approx(high).margin(1e-5));
        }
    }
}

TEST_CASE("Peaks of a sound are those of its samples at every zoom")
{
    Random random(2);
    std::vector<float> samples(200'003);
    for (float& s : samples)
        s = static_cast<float>(random.uniform(-1.0, 1.0));
    const WaveformPeaks peaks(samples, 48000.0);
    for (const double perPixel : {1e-5, 1e-4, 1e-3, 5e-3, 2e-2})
    {
        const TimeAxis time{random.uniform(-0.5, 2.0), perPixel};
        std::vector<Column> columns(300);
        peaks.columns(time, columns);
        for (std::size_t i = 0; i < columns.size(); ++i)
        {
            const double from = time.timeAt(static_cast<double>(i)) * 48000.0;
            const double to = time.timeAt(static_cast<double>(i) + 1.0) * 48000.0;
            const auto begin = static_cast<std::size_t>(std::clamp(from, 0.0, 200003.0));
            const auto end = static_cast<std::size_t>(std::clamp(std::max(to, 0.0), 0.0, 200003.0));
            if (end < begin + 2)
                continue;
            const auto [low, high] = std::minmax_element(samples.begin() + static_cast<std::ptrdiff_t>(begin),
                                                         samples.begin() + static_cast<std::ptrdiff_t>(end));
            REQUIRE(columns[i].low == *low);
            REQUIRE(columns[i].high == *high);
        }
    }
}

TEST_CASE("The pointer sticks to the nearest event or line within reach")
{
    const TimeAxis axis{0.0, 0.01};
    const double events[] = {0.52, 2.0};
    const TimeGrid grid{0.25, 0.0, 0.3};
    CHECK(snapped(0.53, axis, 5.0, events, grid) == 0.52);
    CHECK(snapped(0.505, axis, 5.0, events, grid) == 0.5);
    CHECK(snapped(0.6, axis, 5.0, events, grid) == 0.6);
    CHECK(snapped(2.04, axis, 5.0, events) == 2.0);
    CHECK(snapped(1.0, axis, 5.0, {}) == 1.0);
}

TEST_CASE("Times of a ruler are round and at least 90 pixels apart, and its lines are a fifth of that")
{
    for (double perPixel = 1e-6; perPixel < 100.0; perPixel *= 1.37)
    {
        const double step = tickStep(perPixel);
        CHECK(step / perPixel >= 89.9);
        CHECK((step / perPixel <= 231.0 || step >= 60.0));
        if (step < 60.0)
        {
            const double leading = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
            CHECK((leading == Approx(1.0) || leading == Approx(2.0) || leading == Approx(5.0)));
        }
        CHECK(rulerGrid(perPixel).step == Approx(step / 5.0));
    }
}

TEST_CASE("A clip without an envelope has the power sum of its bands for its level")
{
    Clip clip;
    clip.duration = 2.0;
    clip.bands = {{80.0, 100.0, 120.0, 0, {{0.0, 0.3}, {2.0, 0.3}}, {}},
                  {180.0, 200.0, 220.0, 0, {{0.5, 0.0}, {1.5, 0.8}}, {}}};
    LevelCurves levels;
    const Curve level = levels.of(std::make_shared<const Clip>(clip));
    CHECK(valueAt(level, 0.0) == Approx(0.3));
    CHECK(level[2].time == 1.5);
    CHECK(level[2].value == Approx(std::sqrt(0.09 + 0.64)));
    CHECK(level.back().value == Approx(std::sqrt(0.09 + 0.64)));
    auto another = std::make_shared<Clip>(clip);
    another->envelope = {{0.0, 0.1}};
    CHECK(levels.of(another) == another->envelope);
    another->envelope.clear();
    another->bands.clear();
    CHECK(levels.of(another).empty());
}

TEST_CASE("Events of the kinds that are selected are all selected")
{
    Clip clip;
    clip.duration = 1.0;
    clip.transients = {{0.1, 0.5, 0.1}, {0.2, 0.5, 0.5}, {0.3, 0.5, 0.9}, {0.4, 0.5, 0.2}, {0.5, 0.5, 0.55}};
    Selection selected;
    selected.transients = {3};
    CHECK(selectKinds(clip, selected).transients == Indices{0, 3});
    selected.transients = {1, 2, 99};
    CHECK(selectKinds(clip, selected).transients == Indices{1, 2, 4});
    CHECK(selectKinds(clip, {}).transients.empty());
}
