#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/foundation/Gaussian.h>
#include <pacini/linearize/PlacementAverage.h>
#include <pacini/linearize/ResponseSmoothing.h>
#include <pacini/linearize/SimulatedRig.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
/// Analytic responses of the wristband on `count` people: mass, spring and damper of the skin from half to twice the
/// usual, the level by up to 0.5 dB, each point with 0.2 dB of noise.
std::vector<FrequencyResponse> wearers(std::size_t count, std::uint64_t seed, BodyPoint point)
{
    RigParams rig;
    rig.point = point;
    Random random(seed);
    Gaussian noise(seed + 99);
    std::vector<FrequencyResponse> out;
    for (std::size_t i = 0; i < count; ++i)
    {
        auto worn = rig;
        for (double* part : {&worn.body->skinMass, &worn.body->skinStiffness, &worn.body->skinDamping})
            *part *= std::exp2(random.uniform(-1.0, 1.0));
        worn.contact = random.uniform(-0.5, 0.5);
        FrequencyResponse response{logSpaced(20.0, 1000.0, 120), {}};
        for (const double f : response.frequency)
            response.level.push_back(rigLevel(worn, f) + 0.2 * noise.next());
        out.push_back(response);
    }
    return out;
}

/// The largest distance of `average` from the plain mean of `clean` from 30 to 1000 Hz.
double bias(const FrequencyResponse& average, const std::vector<FrequencyResponse>& clean)
{
    auto mean = average;
    for (std::size_t k = 0; k < mean.size(); ++k)
    {
        mean.level[k] = 0.0;
        for (const auto& response : clean)
            mean.level[k] += response.level[k] / static_cast<double>(clean.size());
    }
    double largest = 0.0;
    for (std::size_t k = 0; k < mean.size(); ++k)
        if (mean.frequency[k] >= 30.0)
            largest = std::max(largest, std::abs(average.level[k] - mean.level[k]));
    return largest;
}
} // namespace

TEST_CASE("Loosely worn placements hardly move the average of fourteen, and are named", "[linearize]")
{
    double worst = 0.0;
    for (const BodyPoint point : {BodyPoint::device, BodyPoint::skin})
        for (std::uint64_t seed = 1; seed <= 20; ++seed)
            for (const std::size_t loose : {0u, 2u, 4u})
            {
                CAPTURE(seed, loose);
                auto placements = wearers(14, seed, point);
                const std::vector<FrequencyResponse> clean(placements.begin() + static_cast<std::ptrdiff_t>(loose),
                                                           placements.end());
                for (std::size_t i = 0; i < loose; ++i)
                    for (double& level : placements[i].level)
                        level -= 6.0;
                const auto average = averagePlacements(placements).value();
                const double error = bias(average.response, clean);
                worst = std::max(worst, error);
                CHECK(error <= (loose == 4 ? 0.6 : 0.35));
                std::size_t named = 0;
                for (const auto& outlier : average.outliers)
                {
                    named += outlier.index < loose ? 1 : 0;
                    if (outlier.index < loose)
                        CHECK(outlier.offset == Approx(-6.0).margin(2.5));
                }
                CHECK(named == loose);
                CHECK(average.outliers.size() <= loose + 1);
            }
    INFO("largest bias " << worst << " dB");
    CHECK(worst < 0.5);
}

TEST_CASE("A placement of another shape is left out even at the same level", "[linearize]")
{
    auto placements = wearers(9, 5, BodyPoint::device);
    const auto clean = std::vector<FrequencyResponse>(placements.begin(), placements.end() - 1);
    for (std::size_t k = 0; k < placements[8].size(); ++k)
        placements[8].level[k] += k % 40 < 20 ? 8.0 : -8.0; // resonances of something loose
    const auto average = averagePlacements(placements).value();
    REQUIRE(average.outliers.size() == 1);
    CHECK(average.outliers[0].index == 8);
    CHECK(average.outliers[0].shape > 3.0);
    CHECK(bias(average.response, clean) < 0.35);
}

TEST_CASE("The spread of placements is their standard deviation", "[linearize]")
{
    std::vector<FrequencyResponse> placements(5,
                                              FrequencyResponse{logSpaced(20.0, 1000.0, 30), std::vector<double>(30)});
    for (std::size_t i = 0; i < 5; ++i)
        for (double& level : placements[i].level)
            level = 10.0 + 0.5 * static_cast<double>(i);
    const auto average = averagePlacements(placements).value();
    CHECK(average.response.level[7] == Approx(11.0));
    CHECK(average.spread[7] == Approx(0.5 * std::sqrt(2.5)));
    CHECK(average.offsets[4] == Approx(1.0));
    CHECK(average.outliers.empty());
    const auto one = averagePlacements(std::span(placements).first(1)).value();
    CHECK(one.response.level == placements[0].level);
    CHECK(one.spread[0] == 0.0);
}

TEST_CASE("Placements that cannot be averaged are named", "[linearize]")
{
    const auto good = wearers(3, 1, BodyPoint::device);
    CHECK(averagePlacements({}).error().where == "placements");
    auto bad = good;
    bad[1].level[4] = std::numeric_limits<double>::quiet_NaN();
    CHECK(averagePlacements(bad).error().where == "placements[1].points[4].level");
    bad = good;
    bad[2].frequency[3] += 0.01;
    CHECK(averagePlacements(bad).error().where == "placements[2]");
    bad = good;
    bad[2].frequency.pop_back();
    bad[2].level.pop_back();
    CHECK(averagePlacements(bad).error().where == "placements[2]");
    PlacementAverageParams params;
    params.offsetLimit = -1.0;
    CHECK(averagePlacements(good, params).error().where == "offsetLimit");
    params = {};
    params.lowFrequency = 5000.0;
    CHECK(averagePlacements(good, params).error().where == "lowFrequency");
}

TEST_CASE("A level counts as loose beyond two and a half deviations of the closest half", "[linearize]")
{
    // The closest three of five are 0, 1 and 2 dB. A normal distribution whose half is as wide as that has a deviation
    // of 1 dB / 0.6745, so that up to 3.707 dB from 1 dB belong to it.
    PlacementAverageParams params;
    params.offsetLimit = 0.0;
    const auto outliers = [&](const std::vector<double>& levels)
    {
        std::vector<FrequencyResponse> placements;
        for (const double level : levels)
            placements.push_back({logSpaced(20.0, 1000.0, 20), std::vector<double>(20, level)});
        std::vector<std::size_t> out;
        const auto average = averagePlacements(placements, params).value();
        for (const PlacementOutlier& outlier : average.outliers)
            out.push_back(outlier.index);
        return out;
    };
    CHECK(outliers({4.69, 2.0, 50.0, 0.0, 1.0}) == std::vector<std::size_t>{2});
    CHECK(outliers({4.72, 2.0, 50.0, 0.0, 1.0}) == std::vector<std::size_t>{0, 2});
    CHECK(outliers({50.0, 0.0, 1.0, 2.0, -2.69}) == std::vector<std::size_t>{0});
    CHECK(outliers({50.0, 0.0, 1.0, 2.0, -2.72}) == std::vector<std::size_t>{0, 4});
    params.offsetLimit = 3.8;
    CHECK(outliers({4.79, 2.0, 50.0, 0.0, 1.0}) == std::vector<std::size_t>{2});
    CHECK(outliers({4.81, 2.0, 50.0, 0.0, 1.0}) == std::vector<std::size_t>{0, 2});
}

TEST_CASE("The order of the placements does not matter", "[linearize]")
{
    // Shapes and levels that all differ: what each of them adds is there whichever is the first.
    std::vector<FrequencyResponse> placements = wearers(5, 9, BodyPoint::device);
    for (double& level : placements[0].level)
        level += 40.0;
    const auto first = averagePlacements(placements).value();
    std::rotate(placements.begin(), placements.begin() + 1, placements.end());
    const auto last = averagePlacements(placements).value();
    REQUIRE(first.outliers.size() == 1);
    CHECK(first.outliers[0].index == 0);
    REQUIRE(last.outliers.size() == 1);
    CHECK(last.outliers[0].index == 4);
    for (std::size_t i = 0; i < 5; ++i)
        CHECK(first.offsets[(i + 1) % 5] == Approx(last.offsets[i]).margin(1e-9));
    CHECK(first.outliers[0].shape == Approx(last.outliers[0].shape));
    for (std::size_t k = 0; k < first.response.size(); ++k)
        CHECK(first.response.level[k] == Approx(last.response.level[k]).margin(1e-9));
}

TEST_CASE("Medians, their deviations and Huber's mean are those of their definitions", "[linearize]")
{
    CHECK(detail::medianOf({3.0, 1.0, 2.0}) == 2.0);
    CHECK(detail::medianOf({4.0, 1.0, 3.0, 2.0}) == 2.5);
    CHECK(detail::medianOf({7.0}) == 7.0);
    CHECK(detail::robustDeviation({1.0, 2.0, 4.0, 9.0, -3.0}, 2.0) == Approx(1.4826 * 2.0));
    // Nothing stands out: the plain mean. One of five is far: it counts as if it were 6 dB from the mean m of all, so
    // that the other four, which are at 0, balance it: 4 m = 6.
    CHECK(detail::huberMean({0.0, 1.0, 2.0, 5.0}) == Approx(2.0));
    CHECK(detail::huberMean({0.0, 0.0, 0.0, 0.0, 100.0}) == Approx(1.5).epsilon(1e-3));
}

TEST_CASE("The limits of the average may be 0 to 60 dB, and only its range is compared", "[linearize]")
{
    const auto good = wearers(3, 1, BodyPoint::device);
    for (const auto& [limit, allowed] :
         {std::pair(0.0, true), std::pair(60.0, true), std::pair(-0.01, false), std::pair(60.01, false)})
    {
        PlacementAverageParams params;
        params.offsetLimit = limit;
        CHECK(averagePlacements(good, params).ok() == allowed);
        params = {};
        params.shapeLimit = limit;
        CHECK(averagePlacements(good, params).ok() == allowed);
    }
    const std::vector<FrequencyResponse> many(1001,
                                              FrequencyResponse{logSpaced(20.0, 1000.0, 8), std::vector<double>(8)});
    CHECK(averagePlacements(std::span(many).first(1000)).ok());
    CHECK(averagePlacements(many).error().where == "placements");
}

TEST_CASE("Averages of placements of any kind are those that they were", "[linearize]")
{
    std::vector<double> values;
    for (const std::size_t count : {1u, 2u, 3u, 4u, 7u, 10u})
        for (const double loose : {0.0, -7.0})
        {
            auto placements = wearers(count, count, BodyPoint::device);
            for (double& level : placements[count / 2].level)
                level += loose;
            for (std::size_t k = 40; k < 60; ++k)
                placements[0].level[k] += 9.0; // what Huber's mean holds back
            PlacementAverageParams params;
            params.lowFrequency = 40.0;
            params.highFrequency = 500.0;
            const auto average = averagePlacements(placements, params).value();
            for (const auto* list : {&average.response.level, &average.spread, &average.offsets})
                for (const double v : *list)
                    values.push_back(v);
            for (const PlacementOutlier& outlier : average.outliers)
                values.insert(values.end(), {static_cast<double>(outlier.index), outlier.offset, outlier.shape});
        }
    checkPinned("linearize/placements", values, 1e-6);

    Random random(2);
    std::vector<double> means;
    for (const std::size_t count : {1u, 2u, 3u, 5u, 8u, 13u})
        for (int i = 0; i < 4; ++i)
        {
            std::vector<double> column;
            for (std::size_t k = 0; k < count; ++k)
                column.push_back(30.0 * std::pow(random.uniform(-1.0, 1.0), 5));
            const auto half = detail::shortestHalf(column);
            means.insert(means.end(), {detail::huberMean(column), half.centre, half.deviation});
        }
    checkPinned("linearize/robust means", means, 1e-6);
    CHECK(detail::shortestHalf({0.0, 1.0, 10.0, 11.0, 11.5}).centre == Approx(10.75));
    CHECK(detail::shortestHalf({0.0, 1.0, 10.0, 11.0, 11.5}).deviation == Approx(1.4826 * 0.75));
    CHECK(detail::shortestHalf({3.0}).centre == 3.0);
    CHECK(detail::shortestHalf({3.0, 5.0}).centre == 4.0);
    CHECK(detail::shortestHalf({9.0, 1.0, 3.0, 2.0}).centre == 2.0);
    CHECK(detail::Concentration{}.centre == 0.0);
    CHECK(detail::Concentration{}.deviation == 0.0);

    const PlacementAverageParams defaults;
    CHECK(defaults.lowFrequency == 30.0);
    CHECK(defaults.highFrequency == 1000.0);
    CHECK(defaults.offsetLimit == 2.5);
    CHECK(defaults.shapeLimit == 3.0);
    CHECK(PlacementOutlier{}.index == 0);
    CHECK(PlacementOutlier{}.offset == 0.0);
    CHECK(PlacementOutlier{}.shape == 0.0);
}

TEST_CASE("A placement exactly at the limits belongs to the others, and both ends of the range are compared",
          "[linearize]")
{
    const auto flat = [](double level)
    {
        return FrequencyResponse{{10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0}, std::vector<double>(8, level)};
    };
    PlacementAverageParams params;
    params.lowFrequency = 30.0;
    params.highFrequency = 60.0;
    params.offsetLimit = 4.0;
    params.shapeLimit = 2.0;
    // the others are all at 0 dB
    std::vector<FrequencyResponse> placements{flat(0.0), flat(0.0), flat(0.0), flat(4.0), flat(-4.0)};
    CHECK(averagePlacements(placements, params)->outliers.empty());
    placements[3] = flat(4.001);
    CHECK(averagePlacements(placements, params)->outliers.size() == 1);
    // four points are compared; of distances 0, 0, 4 and 4 around their median 2 all are 2
    placements = {flat(0.0), flat(0.0), flat(0.0), flat(0.0), flat(0.0)};
    placements[1].level = {90.0, 90.0, 4.0, 4.0, 0.0, 0.0, 90.0, 90.0};
    const auto average = averagePlacements(placements, params).value();
    CHECK(average.outliers.empty());
    CHECK(average.offsets[1] - average.offsets[0] == Approx(2.0));
    params.shapeLimit = 1.999;
    const auto strict = averagePlacements(placements, params).value();
    REQUIRE(strict.outliers.size() == 1);
    CHECK(strict.outliers[0].index == 1);
    CHECK(strict.outliers[0].shape == Approx(2.0));
    CHECK(strict.outliers[0].offset == Approx(2.0));
    // without a shape that fits all are taken
    params.shapeLimit = 0.0;
    for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t k = 0; k < 8; ++k)
            placements[i].level[k] = static_cast<double>((3 * k * (i + 2) + k * k * (i + 1)) % 11);
    const auto all = averagePlacements(placements, params).value();
    CHECK(all.outliers.empty());
    params.highFrequency = 30.0;
    CHECK(averagePlacements(placements, params).ok());
    params.lowFrequency = 31.0;
    params.highFrequency = 39.0;
    CHECK(averagePlacements(placements, params).error().message == "leaves no frequency to compare the responses at");
    placements[2].level[1] = 401.0;
    params = {};
    CHECK(averagePlacements(placements, params).error().where == "placements[2].points[1].level");
}
