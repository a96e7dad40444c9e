#include "EqualizerReference.h"
#include "support/Catch.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/linearize/EqualizerFitProblem.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
FrequencyResponse problemResponse(std::size_t points, double low, double high)
{
    FrequencyResponse response;
    response.frequency = logFrequencies(points, low, high);
    for (std::size_t i = 0; i < points; ++i)
        response.level.push_back(3.0 * std::sin(0.13 * static_cast<double>(i)) - 0.01 * static_cast<double>(i));
    return response;
}

EqualizerFitProblem problemOf(const FrequencyResponse& response, const EqualizerFitParams& params = {})
{
    const auto problem = makeEqualizerFitProblem(response, params);
    REQUIRE(problem.ok());
    return *problem;
}

/// Zeros with `height` from `first` to `last`, both included.
std::vector<double> problemRun(std::size_t n, std::size_t first, std::size_t last, double height)
{
    std::vector<double> level(n, 0.0);
    for (std::size_t i = first; i <= last; ++i)
        level[i] = height;
    return level;
}

std::vector<std::size_t> problemDropouts(const std::vector<double>& level, double noise = 0.0)
{
    std::vector<std::size_t> at;
    const auto dropouts = detail::dropoutsOf(level, noise);
    REQUIRE(dropouts.size() == level.size());
    for (std::size_t i = 0; i < dropouts.size(); ++i)
        if (dropouts[i])
            at.push_back(i);
    return at;
}

std::vector<std::size_t> problemIndices(std::size_t first, std::size_t last)
{
    std::vector<std::size_t> out;
    for (std::size_t i = first; i <= last; ++i)
        out.push_back(i);
    return out;
}
} // namespace

TEST_CASE("The noise of a curve is the median of its third differences over the root of twenty", "[linearize]")
{
    const double unit = 1.4826 / std::sqrt(20.0);
    CHECK(detail::noiseOf({1.0, 4.0, 2.0, 10.0}) == Approx(15.0 * unit));
    CHECK(detail::noiseOf({1.0, 4.0, 2.0, -20.0}) == Approx(15.0 * unit)); // -21 + 6
    std::vector<double> square, cube;
    for (int i = 0; i < 20; ++i)
    {
        square.push_back(2.0 + 3.0 * i - 0.5 * i * i);
        cube.push_back(0.25 * i * i * i - i);
    }
    CHECK(detail::noiseOf(square) == Approx(0.0).margin(1e-12));
    CHECK(detail::noiseOf(cube) == Approx(1.5 * unit)); // third difference 6 * 0.25
    // A drop-out moves four of the seventeen differences, not their median.
    cube[10] -= 40.0;
    CHECK(detail::noiseOf(cube) == Approx(1.5 * unit));
    // Five differences: 6, 0, 0, 0, 12 with the median 0; of 6, 6, 0 and 12 the larger middle one.
    CHECK(detail::noiseOf({6.0, 0.0, 0.0, 0.0, 0.0, 6.0}) == Approx(6.0 * unit));
    // Noise of deviation 1: sums of uniform numbers.
    Random random(4);
    std::vector<double> noise;
    for (int i = 0; i < 4000; ++i)
    {
        double sum = -6.0;
        for (int k = 0; k < 12; ++k)
            sum += random.uniform();
        noise.push_back(sum);
    }
    CHECK(detail::noiseOf(noise) == Approx(1.0).epsilon(0.05));
}

TEST_CASE("One to four points that jump away and come back are drop-outs, more are not", "[linearize]")
{
    for (const double height : {-7.0, 7.0})
    {
        CHECK(problemDropouts(problemRun(64, 30, 30, height)) == problemIndices(30, 30));
        CHECK(problemDropouts(problemRun(64, 30, 31, height)) == problemIndices(30, 31));
        CHECK(problemDropouts(problemRun(64, 30, 32, height)) == problemIndices(30, 32));
        CHECK(problemDropouts(problemRun(64, 30, 33, height)) == problemIndices(30, 33));
        CHECK(problemDropouts(problemRun(64, 30, 34, height)).empty());
        CHECK(problemDropouts(problemRun(64, 1, 1, height)) == problemIndices(1, 1));
        CHECK(problemDropouts(problemRun(64, 62, 62, height)) == problemIndices(62, 62));
        // at both ends
        CHECK(problemDropouts(problemRun(64, 63, 63, height)) == problemIndices(63, 63));
        CHECK(problemDropouts(problemRun(64, 60, 63, height)) == problemIndices(60, 63));
        CHECK(problemDropouts(problemRun(64, 59, 63, height)).empty());
        CHECK(problemDropouts(problemRun(64, 0, 0, height)) == problemIndices(0, 0));
        CHECK(problemDropouts(problemRun(64, 0, 3, height)) == problemIndices(0, 3));
        CHECK(problemDropouts(problemRun(64, 0, 4, height)).empty());
    }
    // anywhere, on any level
    for (std::size_t length = 1; length <= 4; ++length)
        for (std::size_t first = 0; first + length <= 64; ++first)
        {
            auto level = problemRun(64, first, first + length - 1, -8.0);
            for (double& v : level)
                v += 100.0;
            CAPTURE(first, length);
            CHECK(problemDropouts(level) == problemIndices(first, first + length - 1));
        }
    // 6 dB at the start are no jump, so that what jumps at the end is compared with what was before it
    auto ends = problemRun(64, 60, 63, 7.0);
    ends[0] = 6.0;
    CHECK(problemDropouts(ends) == problemIndices(60, 63));
    CHECK(problemDropouts(std::vector<double>(64, 3.0)).empty());
    // two runs one point apart, and a step, which never comes back
    auto two = problemRun(64, 10, 12, 9.0);
    two[14] = two[15] = -9.0;
    CHECK(problemDropouts(two) == std::vector<std::size_t>{10, 11, 12, 14, 15});
    two[0] = -30.0; // from the other end
    CHECK(problemDropouts(two) == std::vector<std::size_t>{0, 10, 11, 12, 14, 15});
    CHECK(problemDropouts(problemRun(64, 30, 58, 9.0)).empty());
    // all of a run are apart from the point before it, whatever they are from each other
    std::vector<double> uneven(64, 0.0);
    uneven[20] = 7.0;
    uneven[21] = -8.0;
    uneven[22] = 20.0;
    CHECK(problemDropouts(uneven) == problemIndices(20, 22));
    // steps of 5 dB are no jump
    CHECK(problemDropouts({0, 5, 10, 15, 20, 15, 10, 5, 0, 5, 10, 15, 20, 25, 30, 35}).empty());
}

TEST_CASE("A drop-out is more than six decibels, more among few points and in noise", "[linearize]")
{
    const auto found = [](std::size_t n, double height, double noise)
    {
        return !problemDropouts(problemRun(n, 9, 10, height), noise).empty();
    };
    CHECK_FALSE(found(64, 6.0, 0.0));
    CHECK(found(64, 6.001, 0.0));
    CHECK_FALSE(found(256, 6.0, 0.0));
    CHECK(found(256, 6.001, 0.0));
    CHECK_FALSE(found(32, 12.0, 0.0));
    CHECK(found(32, 12.001, 0.0));
    CHECK_FALSE(found(64, 16.0, 2.0));
    CHECK(found(64, 16.001, 2.0));
    CHECK_FALSE(found(16, 26.5, 0.5));
    CHECK(found(16, 26.501, 0.5));
    // at the start the same
    CHECK(problemDropouts(problemRun(32, 0, 1, 12.0)).empty());
    CHECK(problemDropouts(problemRun(32, 0, 1, 12.001)) == problemIndices(0, 1));
    // fewer points than a run may be long
    CHECK(problemDropouts({0.0, 0.0, 0.0}).empty());
    CHECK(problemDropouts({0.0, 200.0, 0.0}) == problemIndices(1, 1));
    CHECK(problemDropouts({0.0}).empty());
}

TEST_CASE("A problem has the points in the range, their weights and the bounds of its sections", "[linearize]")
{
    const FrequencyResponse response = problemResponse(100, 20.0, 2000.0);
    EqualizerFitParams params;
    params.sampleRate = 16000.0;
    params.maxBoost = 7.5;
    params.boostOutside = true;
    params.shelves = false;
    for (std::size_t i = 0; i < 100; ++i)
        params.weights.push_back(i % 3 == 0 ? 0.0 : 1.0 + static_cast<double>(i));
    params.lowFrequency = response.frequency[10]; // the ends belong to the range
    params.highFrequency = response.frequency[79];
    const auto problem = problemOf(response, params);
    CHECK(problem.fs == 16000.0);
    CHECK(problem.maxBoost == 7.5);
    CHECK(problem.boostOutside);
    CHECK_FALSE(problem.shelves);
    CHECK_FALSE(problem.highpass.has_value());
    CHECK(problem.highestGuard() == Approx(0.4999 * 16000.0));
    REQUIRE(problem.points() == 70);
    double sum = 0.0;
    for (std::size_t i = 0; i < 70; ++i)
        sum += params.weights[i + 10];
    for (std::size_t i = 0; i < 70; ++i)
    {
        CHECK(problem.frequency[i] == response.frequency[i + 10]);
        CHECK(problem.level[i] == response.level[i + 10]);
        CHECK(problem.warped[i] == Approx(std::pow(std::tan(std::numbers::pi * problem.frequency[i] / 16000.0), 2)));
        CHECK(problem.fixed[i] == 0.0);
        CHECK(problem.given[i] == Approx(params.weights[i + 10] * 70.0 / sum));
        CHECK(problem.weight[i] == problem.given[i]);
    }
    CHECK(problem.dropouts == 0);
    CHECK(problem.noise == Approx(detail::noiseOf(problem.level)));
    CHECK(problem.outlier == std::numeric_limits<double>::infinity());
    CHECK(problem.lowestFrequency == Approx(0.5 * response.frequency[10]));
    CHECK(problem.highestFrequency == Approx(2.0 * response.frequency[79]));
    CHECK(problem.lowestQ == 0.1);
    CHECK(problem.highestQ == Approx(0.7 / (std::log(100.0) / 99.0)));
    REQUIRE(problem.allPoints() == problem.frequency.size());
    REQUIRE(problem.allPoints() == problem.fixed.size());

    const EqualizerFitProblem empty;
    CHECK(test::asNumbers(empty.fs, empty.maxBoost, empty.boostOutside, empty.shelves, empty.lowestFrequency) ==
          test::Numbers{48000.0, 12.0, false, true, 1.0});
    CHECK(test::asNumbers(empty.highestFrequency, empty.lowestQ, empty.highestQ, empty.dropouts, empty.noise) ==
          test::Numbers{20000.0, 0.1, 60.0, 0, 0.0});
    CHECK(empty.outlier == std::numeric_limits<double>::infinity());

    // A range below 1 Hz, and a drop-out at its first point.
    FrequencyResponse slow = problemResponse(40, 0.2, 20.0);
    slow.level[0] = 100.0;
    const auto slowest = problemOf(slow);
    CHECK(slowest.points() == 40);
    CHECK(slowest.dropouts == 1);
    CHECK(slowest.weight[0] == 0.0);
    EqualizerFitParams below;
    below.lowFrequency = slow.frequency[2];
    CHECK(problemOf(slow, below).points() == 38);
    below = {};
    below.highFrequency = 0.9;
    CHECK(problemOf(slow, below).frequency[problemOf(slow, below).points() - 1] <= 0.9);

    // By default everything in the response.
    const auto whole = problemOf(response);
    CHECK(whole.points() == 100);
    CHECK(whole.fs == 48000.0);
    CHECK(whole.maxBoost == 12.0);
    CHECK_FALSE(whole.boostOutside);
    CHECK(whole.shelves);
    CHECK(whole.given == std::vector<double>(100, 1.0));
}

TEST_CASE("The sections of a problem stay an octave around it, below 0.48 of the rate and 20 kHz", "[linearize]")
{
    const auto bounds = [](double low, double high, std::size_t points, double fs)
    {
        EqualizerFitParams params;
        params.sampleRate = fs;
        const auto problem = problemOf(problemResponse(points, low, high), params);
        return std::vector<double>{problem.lowestFrequency, problem.highestFrequency, problem.highestQ};
    };
    CHECK(bounds(1.5, 15.0, 20, 48000.0)[0] == 1.0);
    CHECK(bounds(2.5, 15.0, 20, 48000.0)[0] == Approx(1.25));
    CHECK(bounds(20.0, 2000.0, 20, 48000.0)[1] == Approx(4000.0));
    CHECK(bounds(20.0, 2000.0, 20, 6000.0)[1] == Approx(2880.0));
    CHECK(bounds(20.0, 15000.0, 20, 96000.0)[1] == Approx(20000.0));
    CHECK(bounds(20.0, 2000.0, 8, 48000.0)[2] == 2.0);
    CHECK(bounds(20.0, 2000.0, 400, 48000.0)[2] == 60.0);
    CHECK(bounds(20.0, 200.0, 21, 48000.0)[2] == Approx(0.7 * 20.0 / std::log(10.0)));
}

TEST_CASE("Guards stand six octaves to both sides of the points and between those that are far apart", "[linearize]")
{
    const auto guards = [](const EqualizerFitProblem& problem)
    {
        return std::vector<double>(problem.frequency.begin() + static_cast<std::ptrdiff_t>(problem.points()),
                                   problem.frequency.end());
    };
    // Steps of 1/24 octave up to half an octave, of 1/8 up to one and a half, of 1/2 up to six.
    const auto dense = problemOf(problemResponse(200, 100.0, 200.0), fitParamsAt(1e6));
    const auto outside = guards(dense);
    for (const double f : outside)
        CHECK((f < 100.0 || f > 200.0));
    CHECK(outside[0] == Approx(100.0 * std::exp2(-1.0 / 24.0)));
    CHECK(outside[1] == Approx(200.0 * std::exp2(1.0 / 24.0)));
    CHECK(outside.back() <= 200.0 * 64.0001);
    CHECK(outside.back() > 200.0 * 32.0);
    checkPinned("linearize/guards outside of dense points", outside);

    FrequencyResponse sparse = problemResponse(8, 100.0, 200.0);
    for (int i = 0; i < 4; ++i)
    {
        sparse.frequency.push_back(300.0 * std::pow(2.0, i));
        sparse.level.push_back(0.5 * i);
    }
    checkPinned("linearize/guards of points an octave apart", guards(problemOf(sparse)));
    checkPinned("linearize/guards below half of the rate", guards(problemOf(sparse, fitParamsAt(6000.0))));
    const auto limited = problemOf(sparse, fitParamsAt(6000.0));
    for (const double f : guards(limited))
        CHECK(f < 0.4999 * 6000.0);
    EqualizerFitProblem one;
    one.fs = 10000.0;
    one.addGuard(4999.0);
    CHECK(one.frequency.empty());
    one.addGuard(4998.9);
    CHECK(one.frequency.size() == 1);
}

TEST_CASE("Drop-outs lose their weight unless fewer than eight points would remain", "[linearize]")
{
    // Drop-outs at 12 and 13 of 24 points, beside which `others` points have weight.
    const auto problem = [](std::size_t others, double heavy = 1.0)
    {
        FrequencyResponse response{logFrequencies(24, 100.0, 1000.0), std::vector<double>(24, 1.0)};
        response.level[12] = response.level[13] = -50.0;
        EqualizerFitParams params;
        params.weights.assign(24, 0.0);
        params.weights[12] = 1.0;
        params.weights[13] = heavy;
        for (std::size_t i = 0; i < others; ++i)
            params.weights[i] = 1.0;
        return problemOf(response, params);
    };
    const auto enough = problem(8);
    CHECK(enough.dropouts == 2);
    CHECK(enough.weight[12] == 0.0);
    CHECK(enough.weight[13] == 0.0);
    CHECK(enough.given[12] == Approx(2.4));
    CHECK(enough.weight[0] == Approx(2.4));
    CHECK(enough.weight[14] == 0.0);
    CHECK(problem(8, 1000.0).dropouts == 2); // any weight counts
    const auto few = problem(7);
    CHECK(few.dropouts == 0);
    CHECK(few.weight == few.given);
    CHECK(few.weight[12] == Approx(24.0 / 9.0));
}

TEST_CASE("A problem of fewer than eight points names what left them out", "[linearize]")
{
    const FrequencyResponse response = problemResponse(20, 100.0, 1000.0);
    const auto failure = [&](const EqualizerFitParams& params)
    {
        const auto problem = makeEqualizerFitProblem(response, params);
        REQUIRE_FALSE(problem.ok());
        CHECK(problem.error().code == ErrorCode::invalidArgument);
        CHECK(problem.error().message ==
              "leaves fewer than 8 points to fit to; points from 0.49 of the sample rate on do not count");
        return problem.error().where;
    };
    EqualizerFitParams params;
    params.lowFrequency = response.frequency[12];
    CHECK(makeEqualizerFitProblem(response, params).ok());
    params.lowFrequency = response.frequency[12] + 1e-6;
    CHECK(failure(params) == "lowFrequency");
    params = {};
    params.highFrequency = response.frequency[7];
    CHECK(makeEqualizerFitProblem(response, params).ok());
    params.highFrequency = response.frequency[7] - 1e-6;
    CHECK(failure(params) == "highFrequency");
    params.lowFrequency = 50.0;
    CHECK(failure(params) == "lowFrequency");
    params = {};
    params.weights.assign(20, 0.0);
    for (std::size_t i = 0; i < 8; ++i)
        params.weights[2 * i] = 1e-3;
    CHECK(makeEqualizerFitProblem(response, params).ok());
    params.weights[4] = 0.0;
    CHECK(failure(params) == "weights");
    params.highFrequency = response.frequency[7]; // of eight points not all have weight
    CHECK(failure(params) == "weights");
    params.highFrequency = response.frequency[6];
    CHECK(failure(params) == "highFrequency");
    const FrequencyResponse slow = problemResponse(20, 0.2, 2.0);
    params = {};
    params.lowFrequency = params.highFrequency = 0.0;
    params.highFrequency = 0.4;
    CHECK(makeEqualizerFitProblem(slow, params).error().where == "highFrequency");
    params.lowFrequency = 0.3;
    CHECK(makeEqualizerFitProblem(slow, params).error().where == "lowFrequency");
    FrequencyResponse high = problemResponse(20, 490.0, 900.0);
    CHECK(makeEqualizerFitProblem(high, fitParamsAt(1000.0)).error().where == "sampleRate");
    // the eighth point just below and exactly at 0.49 of the rate
    FrequencyResponse edge{{100, 110, 120, 130, 140, 150, 160, 490}, std::vector<double>(8, 0.0)};
    CHECK(makeEqualizerFitProblem(edge, fitParamsAt(1001.0)).ok());
    CHECK(makeEqualizerFitProblem(edge, fitParamsAt(1000.0)).error().where == "sampleRate");
}

TEST_CASE("A high-pass is in the levels of a problem, as it will run", "[linearize]")
{
    EqualizerFitParams params;
    params.sampleRate = 8000.0;
    params.highpass = EqualizerSection{EqualizerType::highpass, 80.0, 0.0, 0.7071067811865476, 2};
    const FrequencyResponse response = problemResponse(30, 30.0, 1000.0);
    const auto problem = problemOf(response, params);
    for (std::size_t i = 0; i < problem.allPoints(); ++i)
    {
        const double wanted = cookbookLevel(*params.highpass, problem.frequency[i], 8000.0);
        CHECK(problem.fixed[i] == Approx(wanted).margin(1e-6));
        if (i < problem.points())
            CHECK(problem.level[i] == Approx(response.level[i] + wanted).margin(1e-6));
    }
}

TEST_CASE("More than 1024 points become their weighted means over steps of equal ratio", "[linearize]")
{
    const auto full = problemOf(problemResponse(1024, 20.0, 2000.0));
    CHECK(thinned(full).points() == 1024);
    CHECK(thinned(full).frequency == full.frequency);

    EqualizerFitParams params;
    for (std::size_t i = 0; i < 3000; ++i)
        params.weights.push_back(i > 1000 && i < 1010 ? 0.0 : 1.0 + static_cast<double>(i % 7));
    FrequencyResponse response = problemResponse(3000, 20.0, 2000.0);
    response.level[2000] += 300.0; // a drop-out has no part in the means
    const auto problem = problemOf(response, params);
    CHECK(problem.dropouts == 1);
    const auto thin = thinned(problem);
    CHECK(thin.points() <= 1024);
    CHECK(thin.points() >= 1000);
    CHECK(thin.given == thin.weight);
    double sum = 0.0;
    for (const double w : thin.weight)
        sum += w;
    CHECK(sum == Approx(static_cast<double>(thin.points())));
    CHECK(thin.noise == Approx(detail::noiseOf(thin.level)));
    CHECK(thin.lowestFrequency == Approx(0.5 * thin.frequency[0]));
    CHECK(thin.highestFrequency == Approx(2.0 * thin.frequency[thin.points() - 1]));
    CHECK(thin.allPoints() == thin.warped.size());
    CHECK(thin.allPoints() == thin.fixed.size());
    // the first mean by hand: the points below a 1024th of the range
    double weight = 0.0, level = 0.0, logarithm = 0.0;
    for (std::size_t i = 0; std::log(problem.frequency[i] / 20.0) / std::log(100.0) * 1024.0 < 1.0; ++i)
    {
        weight += problem.weight[i];
        level += problem.weight[i] * problem.level[i];
        logarithm += problem.weight[i] * std::log(problem.frequency[i]);
    }
    CHECK(thin.level[0] == Approx(level / weight));
    CHECK(thin.frequency[0] == Approx(std::exp(logarithm / weight)));
    checkPinned("linearize/thinned levels", thin.level);
    checkPinned("linearize/thinned weights", thin.weight);
    checkPinned("linearize/thinned frequencies and guards", thin.frequency);

    // Points crowded in one place leave steps empty.
    FrequencyResponse crowded = problemResponse(1200, 100.0, 110.0);
    for (int i = 1; i <= 20; ++i)
    {
        crowded.frequency.push_back(110.0 * std::pow(1.1, i));
        crowded.level.push_back(0.1 * i);
    }
    const auto few = thinned(problemOf(crowded));
    CHECK(few.points() < 100);
    CHECK(few.level.back() == Approx(2.0));
    checkPinned("linearize/thinned crowd", few.level);
    checkPinned("linearize/thinned crowd weights", few.weight);
}
