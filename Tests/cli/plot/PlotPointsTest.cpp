#include "cli/plot/SeriesDrawing.h"
#include "cli/plot/ShownCurve.h"
#include "cli/plot/Waveform.h"
#include "support/Catch.h"

#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::plot;

namespace
{
/// Lowest and highest value per column of pixels.
std::map<long, std::pair<double, double>> extremes(const std::vector<Point>& points)
{
    std::map<long, std::pair<double, double>> columns;
    for (const Point& point : points)
    {
        auto [entry, first] = columns.try_emplace(std::lround(std::floor(point.x)), point.y, point.y);
        entry->second.first = std::min(entry->second.first, point.y);
        entry->second.second = std::max(entry->second.second, point.y);
    }
    return columns;
}
} // namespace

TEST_CASE("Thinned lines keep the extremes of every column of pixels with at most four points", "[plot]")
{
    Random random(5);
    std::vector<Point> points;
    for (int i = 0; i < 20000; ++i)
        points.push_back({i * 0.0371, random.uniform(-1.0, 1.0)});
    const auto kept = thinned(points);
    CHECK(extremes(kept) == extremes(points));
    CHECK(kept.size() <= 4 * extremes(points).size());
    CHECK(kept.front() == points.front());
    CHECK(kept.back() == points.back());
    CHECK(thinned(kept) == kept);
}

TEST_CASE("Lines that are not dense, or that turn back, stay as they are", "[plot]")
{
    const std::vector<Point> sparse = {{0.0, 1.0}, {3.5, 2.0}, {9.0, 0.0}};
    CHECK(thinned(sparse) == sparse);
    const std::vector<Point> turning = {{5.1, 1.0}, {5.2, 2.0}, {5.0, 0.0}, {5.3, 1.0}, {5.2, 0.5}, {5.1, 0.6}};
    CHECK(thinned(turning) == turning);
    CHECK(thinned({}).empty());
}

TEST_CASE("A waveform has the extremes of all its samples, however it comes in blocks", "[plot]")
{
    constexpr double fs = 8000.0;
    constexpr std::size_t columns = 50;
    const TimeRange range{1.0, 21.0};
    Random random(6);
    std::vector<float> samples(24 * 8000 * 2);
    for (float& sample : samples)
        sample = static_cast<float>(random.uniform(-1.0, 1.0));
    std::vector<Point> all; // x in columns
    for (std::size_t frame = 0; frame < samples.size() / 2; ++frame)
    {
        const double time = static_cast<double>(frame) / fs;
        if (time >= range.from - 1.0 / fs && time <= range.to + 1.0 / fs)
            all.push_back({(time - 1.0) * 2.5, 0.5 * (static_cast<double>(samples[2 * frame]) +
                                                      static_cast<double>(samples[2 * frame + 1]))});
    }
    for (const std::size_t block : {std::size_t{2}, std::size_t{1024}, samples.size()})
    {
        Waveform waveform(range, columns, fs, 2);
        for (std::size_t i = 0; i < samples.size(); i += block)
            waveform.push(std::span(samples).subspan(i, std::min(block, samples.size() - i)));
        auto points = waveform.points();
        CHECK(points.size() <= 4 * (columns + 2));
        double highest = 0.0;
        for (const Point& point : points)
            highest = std::max(highest, point.y);
        double expected = 0.0;
        for (const Point& point : all)
            expected = std::max(expected, point.y);
        CHECK(highest == expected);
        CHECK(std::is_sorted(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; }));
        CHECK(points.front().x >= range.from - 1.0 / fs - 1e-9);
        CHECK(points.back().x <= range.to + 1.0 / fs + 1e-9);
    }
}

TEST_CASE("A short part of a waveform keeps every sample", "[plot]")
{
    std::vector<float> samples(1000);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = static_cast<float>(i);
    Waveform waveform({0.01, 0.02}, 400, 8000.0, 1); // 81 samples on 400 columns
    waveform.push(samples);
    const auto points = waveform.points();
    REQUIRE(points.size() >= 81);
    for (const Point& point : points)
        CHECK(point.x * 8000.0 == Approx(point.y));
}

TEST_CASE("The shown part of a curve holds its end values and ends at the edges", "[plot]")
{
    const Curve curve = {{1.0, 2.0}, {2.0, 4.0}, {2.0, 1.0}, {3.0, 0.0}};
    CHECK(shownCurve(curve, {0.0, 4.0}, 3.5) ==
          std::vector<Point>{{0.0, 2.0}, {1.0, 2.0}, {2.0, 4.0}, {2.0, 1.0}, {3.0, 0.0}, {3.5, 0.0}});
    CHECK(shownCurve(curve, {1.5, 1.75}, 3.5) == std::vector<Point>{{1.5, 3.0}, {1.75, 3.5}});
    CHECK(shownBreakpoints(curve, {1.5, 2.5}) == std::vector<Point>{{2.0, 4.0}, {2.0, 1.0}});
    CHECK(shownCurve({}, {0.0, 4.0}, 3.5).empty());
    CHECK(shownCurve(curve, {5.0, 6.0}, 3.5).empty());
}

TEST_CASE("Column peaks are those of the curve sampled finely, and see every breakpoint", "[plot]")
{
    Random random(7);
    Curve curve;
    for (int i = 0; i < 60; ++i)
        curve.push_back({0.05 * i, random.uniform(0.0, 1.0)});
    const TimeRange range{0.2, 2.7};
    const auto peaks = columnPeaks(curve, range, 2.5, 20);
    for (std::size_t c = 0; c < peaks.size(); ++c)
    {
        double expected = 0.0;
        for (int k = 0; k <= 5000; ++k)
        {
            const double time = range.from + (static_cast<double>(c) + k / 5000.0) * 0.125;
            if (time <= 2.5)
                expected = std::max(expected, valueAt(curve, time));
        }
        CHECK(peaks[c] >= expected - 1e-9);
        CHECK(peaks[c] <= expected + 0.01);
    }
    CHECK(peaks.back() == 0.0);
    CHECK(columnPeaks({}, range, 2.5, 3) == std::vector<double>{0.0, 0.0, 0.0});
}
