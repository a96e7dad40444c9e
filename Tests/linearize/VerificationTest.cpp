#include "support/Catch.h"

#include <pacini/linearize/Verification.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

using namespace pacini;

namespace
{
/// 100 points from 10 to 1000 Hz, evenly in octaves.
template <typename Level>
FrequencyResponse responseOf(Level&& level)
{
    FrequencyResponse response;
    for (int i = 0; i <= 100; ++i)
    {
        response.frequency.push_back(10.0 * std::pow(100.0, i / 100.0));
        response.level.push_back(level(response.frequency.back()));
    }
    return response;
}
} // namespace

TEST_CASE("A slope over octaves has the mean, the deviations and the outliers that paper gives")
{
    // -10 to 10 dB over two decades around 100 Hz: |d| has the mean 5, d^2 the mean 100 / 3.
    const auto slope = responseOf([](double f) { return 7.0 + 10.0 * std::log10(f / 100.0); });
    const auto judged = judgeLinearity(slope, {0.0, 0.0, 3.9});
    REQUIRE(judged);
    CHECK(judged->level == Approx(7.0));
    CHECK(judged->meanDeviation == Approx(5.0).epsilon(0.001));
    CHECK(judged->standardDeviation == Approx(10.0 / std::sqrt(3.0)).epsilon(0.001));
    CHECK(std::abs(judged->worstDeviation) == Approx(10.0));
    CHECK_FALSE(judged->passed());
    REQUIRE(judged->outliers.size() == 2);
    CHECK(judged->outliers[0].lowFrequency == Approx(10.0));
    CHECK(judged->outliers[0].deviation == Approx(-10.0));
    CHECK(judged->outliers[1].highFrequency == Approx(1000.0));
    CHECK(judged->outliers[1].lowFrequency > 100.0 * std::pow(10.0, 0.39));
    CHECK(judgeLinearity(slope, {0.0, 0.0, 10.001})->passed());
}

TEST_CASE("Only the range counts, and the spacing of the points does not")
{
    auto response = responseOf([](double f) { return f < 50.0 ? -60.0 : 3.0; });
    const auto judged = judgeLinearity(response, {50.0, 1000.0, 0.5});
    REQUIRE(judged);
    CHECK(judged->passed());
    CHECK(judged->level == Approx(3.0));
    CHECK(judged->lowFrequency >= 50.0);

    // A hundred more points in one place do not move the mean of a slope.
    auto slope = responseOf([](double f) { return 10.0 * std::log10(f / 100.0); });
    FrequencyResponse crowded;
    for (std::size_t i = 0; i < slope.size(); ++i)
    {
        crowded.frequency.push_back(slope.frequency[i]);
        crowded.level.push_back(slope.level[i]);
        for (int k = 1; i == 90 && k < 100; ++k)
        {
            const double f = slope.frequency[90] * std::pow(slope.frequency[91] / slope.frequency[90], k / 100.0);
            crowded.frequency.push_back(f);
            crowded.level.push_back(10.0 * std::log10(f / 100.0));
        }
    }
    CHECK(judgeLinearity(crowded, {})->level == Approx(judgeLinearity(slope, {})->level).margin(1e-9));
}

TEST_CASE("A response that cannot be judged is refused at its place")
{
    const auto flat = responseOf([](double) { return 0.0; });
    CHECK(judgeLinearity(flat, {900.0, 1000.0, 1.0}).error().where == "range");
    CHECK(judgeLinearity(flat, {0.0, 0.0, -1.0}).error().where == "tolerance");
    CHECK(judgeLinearity(flat, {0.0, 0.0, std::nan("")}).error().where == "tolerance");
    CHECK(judgeLinearity(flat, {0.0, 0.0, 100.01}).error().where == "tolerance");
    CHECK(judgeLinearity(flat, {0.0, 0.0, 0.0})->passed()); // the ends are in the range
    CHECK(judgeLinearity(flat, {0.0, 0.0, 100.0})->passed());
    const double eighth = flat.frequency[flat.size() - 8], seventh = flat.frequency[flat.size() - 7];
    CHECK(judgeLinearity(flat, {eighth, 0.0, 1.0}).ok());
    CHECK(judgeLinearity(flat, {seventh, 0.0, 1.0}).error().where == "range");
    auto broken = flat;
    broken.level[5] = std::numeric_limits<double>::infinity();
    CHECK(judgeLinearity(broken, {}).error().where == "points[5].level");
}

TEST_CASE("Between two points the level is on the line over the logarithm of frequency")
{
    const auto slope = responseOf([](double f) { return 20.0 * std::log10(f); });
    for (const double f : {10.0, 11.0, 123.4, 999.0, 1000.0})
        CHECK(levelAt(slope, f) == Approx(20.0 * std::log10(f)));
    CHECK(levelAt(slope, 1.0) == slope.level.front());
    CHECK(levelAt(slope, 5000.0) == slope.level.back());
}

TEST_CASE("The worst point and each outlier's worst are named, wherever in it they are")
{
    FrequencyResponse response;
    for (int i = 0; i < 40; ++i)
    {
        response.frequency.push_back(100.0 + i);
        response.level.push_back(0.0);
    }
    for (const auto& [at, level] : {std::pair(10, 5.0), std::pair(11, 7.0), std::pair(12, 6.0), std::pair(20, -5.0),
                                    std::pair(21, -9.0), std::pair(22, -9.0)})
        response.level[static_cast<std::size_t>(at)] = level;
    const auto judged = judgeLinearity(response, {101.0, 138.0, 4.5});
    REQUIRE(judged);
    CHECK(judged->lowFrequency == 101.0);
    CHECK(judged->highFrequency == 138.0);
    CHECK(judged->tolerance == 4.5);
    CHECK(judged->worstFrequency == 121.0); // the first of two equal ones
    CHECK(judged->worstDeviation == Approx(-9.0 - judged->level));
    REQUIRE(judged->outliers.size() == 2);
    CHECK(judged->outliers[0].lowFrequency == 110.0);
    CHECK(judged->outliers[0].highFrequency == 112.0);
    CHECK(judged->outliers[0].deviation == Approx(7.0 - judged->level));
    CHECK(judged->outliers[1].deviation == Approx(-9.0 - judged->level));
    // Where nothing deviates the first point of the range is as good as any.
    const auto flat = judgeLinearity(responseOf([](double) { return 0.0; }), {50.0, 0.0, 1.0});
    CHECK(flat->worstDeviation == 0.0);
    CHECK(flat->worstFrequency == flat->lowFrequency);

    // By default everything counts and 4 dB pass.
    response.level.assign(40, 0.0);
    response.level[0] = 4.2;
    CHECK_FALSE(judgeLinearity(response, {})->passed());
    response.level[0] = 3.9;
    CHECK(judgeLinearity(response, {})->passed());
    CHECK(judgeLinearity(response, {})->lowFrequency == 100.0);
}

TEST_CASE("A range below 1 Hz is kept to")
{
    FrequencyResponse slow;
    for (int i = 1; i <= 40; ++i)
    {
        slow.frequency.push_back(0.1 * i);
        slow.level.push_back(i < 5 || i > 30 ? 20.0 : 0.0);
    }
    CHECK(judgeLinearity(slow, {0.5, 3.0, 1.0})->passed());
    CHECK(judgeLinearity(slow, {0.5, 3.0, 1.0})->lowFrequency == Approx(0.5));
    CHECK(judgeLinearity(slow, {0.0, 0.9, 1.0}).value().highFrequency == Approx(0.9));
}

TEST_CASE("Means are those of the trapezoid rule over octaves, whatever the spacing")
{
    FrequencyResponse response;
    const double steps[] = {1.0, 0.1, 0.5, 2.0, 0.25, 0.3, 0.7, 1.1, 0.05, 0.4};
    double f = 20.0;
    for (int i = 0; i < 11; ++i)
    {
        response.frequency.push_back(f);
        response.level.push_back(6.0 * std::sin(1.7 * i) + i);
        f *= std::exp2(i < 10 ? steps[i] : 1.0);
    }
    const auto mean = [&](auto value, std::size_t first, std::size_t last)
    {
        double sum = 0.0, width = 0.0;
        for (std::size_t i = first; i < last; ++i)
        {
            sum += steps[i] * (value(response.level[i]) + value(response.level[i + 1])) / 2.0;
            width += steps[i];
        }
        return sum / width;
    };
    for (const auto& [first, last] :
         {std::pair<std::size_t, std::size_t>(0, 10), std::pair<std::size_t, std::size_t>(1, 8)})
    {
        const auto judged =
            judgeLinearity(response, {response.frequency[first], response.frequency[last], 4.0}).value();
        const double level = mean([](double v) { return v; }, first, last);
        CHECK(judged.lowFrequency == response.frequency[first]);
        CHECK(judged.highFrequency == response.frequency[last]);
        CHECK(judged.level == Approx(level));
        CHECK(judged.meanDeviation == Approx(mean([&](double v) { return std::abs(v - level); }, first, last)));
        CHECK(judged.standardDeviation ==
              Approx(std::sqrt(mean([&](double v) { return (v - level) * (v - level); }, first, last))));
        // the ends, as they come back from a text file
        CHECK(judgeLinearity(response,
                             {response.frequency[first] * (1.0 + 5e-10), response.frequency[last] * (1.0 - 5e-10), 4.0})
                  .value()
                  .level == judged.level);
    }
    CHECK(LinearityParams{}.lowFrequency == 0.0);
    CHECK(LinearityParams{}.highFrequency == 0.0);
    CHECK(LinearityParams{}.tolerance == 4.0);
    // exactly the tolerance passes: levels of 2 and -2 dB at four points of equal distance each side of 0
    FrequencyResponse square;
    for (int i = 0; i < 9; ++i)
    {
        square.frequency.push_back(std::exp2(i + 4));
        square.level.push_back(i == 2 ? 2.0 : (i == 6 ? -2.0 : 0.0));
    }
    CHECK(judgeLinearity(square, {0.0, 0.0, 2.0})->passed());
    CHECK_FALSE(judgeLinearity(square, {0.0, 0.0, 1.999})->passed());
    CHECK(judgeLinearity(square, {0.0, 0.0, 1.999})->outliers.size() == 2);
    CHECK(judgeLinearity(square, {0.0, 0.0, 1.999})->worstFrequency == 64.0);
}
