#include "support/Catch.h"
#include "support/Golden.h"

#include <pacini/linearize/SweepSchedule.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace pacini;

namespace
{
SweepParams plain(const nlohmann::json& c)
{
    SweepParams params;
    params.sampleRate = c["fs"];
    params.duration = c["T"];
    params.lowFrequency = c["f1"];
    params.highFrequency = c["f2"];
    params.fadeIn = params.fadeOut = 0.0;
    return params;
}

/// One sweep of amplitude 1, without pauses.
std::vector<float> plainSweep(const SweepParams& params)
{
    return sampleSweep(measuringSweep(params), params.sampleRate);
}
} // namespace

TEST_CASE("A sweep without fades is the one of the reference", "[linearize]")
{
    const auto ess = test::golden("ess");
    const double tolerance = ess["tol"];
    for (const auto& c : ess["cases"])
    {
        const auto x = plainSweep(plain(c));
        REQUIRE(x.size() == c["n"].get<std::size_t>());
        const auto compare = [&](const nlohmann::json& values, std::size_t first)
        {
            for (std::size_t i = 0; i < values.size(); ++i)
                REQUIRE(std::abs(static_cast<double>(x[first + i]) - values[i].get<double>()) <= tolerance);
        };
        compare(c["first"], 0);
        compare(c["mid"], c["mid_index"]);
        compare(c["last"], x.size() - c["last"].size());
        double sum = 0.0;
        for (const float v : x)
            sum += static_cast<double>(v) * static_cast<double>(v);
        CHECK(std::sqrt(sum / static_cast<double>(x.size())) == Approx(c["rms"].get<double>()).epsilon(1e-5));
    }
}

TEST_CASE("The phase of a sweep of ten minutes is right to the end", "[linearize]")
{
    SweepParams params;
    params.duration = 600.0;
    params.highFrequency = 10000.0;
    params.fadeIn = params.fadeOut = 0.0;
    const ExponentialSweep sweep = measuringSweep(params);
    const long double growth = 600.0L / std::log(1000.0L);
    double largest = 0.0;
    for (double t = 0.001; t < 600.0; t += 0.997)
    {
        const long double turns = 10.0L * growth * std::expm1(static_cast<long double>(t) / growth);
        const long double expected = std::sin(2.0L * std::numbers::pi_v<long double> * (turns - std::floor(turns)));
        largest = std::max(largest, std::abs(sweep.at(t) - static_cast<double>(expected)));
    }
    CHECK(largest < 1e-7);
}

TEST_CASE("A sweep fades in and out and keeps its level between", "[linearize]")
{
    SweepParams params;
    params.duration = 2.0;
    params.fadeIn = 0.5;
    params.fadeOut = 0.1;
    const auto faded = plainSweep(params);
    params.fadeIn = params.fadeOut = 0.0;
    const auto full = plainSweep(params);
    CHECK(std::abs(faded.back()) < 1e-4f);
    CHECK(faded[12000] == Approx(0.5 * static_cast<double>(full[12000])).margin(1e-6)); // half way in
    for (std::size_t n = 24000; n < 91200; ++n)
        REQUIRE(faded[n] == full[n]);
}

TEST_CASE("A sweep seen by a faster clock lasts longer and is lower", "[linearize]")
{
    SweepParams params;
    const ExponentialSweep sweep = measuringSweep(params);
    const ExponentialSweep seen = sweep.byClock(1e-3);
    for (const double t : {0.05, 0.3, 7.0, 19.99})
        CHECK(seen.at(t * 1.001) == Approx(sweep.at(t)).margin(1e-8));
    CHECK(seen.frequencyAt(seen.timeOf(100.0)) == Approx(100.0));
    CHECK(sweep.timeOf(1500.0) == Approx(20.0));
}

TEST_CASE("A measurement plays every repeat of every level between markers, with pauses", "[linearize]")
{
    SweepParams params;
    params.duration = 1.0;
    params.levels = {-20.0, -6.0};
    params.repeats = 2;
    const auto schedule = makeSweepSchedule(params);
    const auto signal = makeSweepSignal(params).value();
    const auto sweep = plainSweep(params);
    REQUIRE(schedule.sweeps.size() == 4);
    REQUIRE(signal.size() == schedule.frames);
    CHECK(schedule.frames == 48000 * (7 + 4 + 1)); // seven pauses, four sweeps, two markers of half a second
    std::vector<float> expected(signal.size(), 0.0f);
    for (std::size_t k = 0; k < 4; ++k)
    {
        CHECK(schedule.sweeps[k].levelIndex == k / 2);
        CHECK(schedule.sweeps[k].repeat == static_cast<int>(k % 2));
        const double gain = std::pow(10.0, params.levels[k / 2] / 20.0);
        for (std::size_t n = 0; n < sweep.size(); ++n)
            expected[schedule.sweeps[k].startFrame + n] = static_cast<float>(gain * static_cast<double>(sweep[n]));
    }
    const std::size_t from = *schedule.firstMarker + 24000;
    for (std::size_t n = 0; n < signal.size(); ++n)
    {
        const bool marker = n < from || n >= *schedule.secondMarker;
        REQUIRE((marker || std::abs(signal[n] - expected[n]) < 1e-6f));
        REQUIRE(std::abs(signal[n]) <= 0.5012f);
    }
    for (std::size_t n = 0; n < 24000; ++n)
        REQUIRE(signal[*schedule.firstMarker + n] == signal[*schedule.secondMarker + n]);
    params.markerDuration = 0.0;
    CHECK_FALSE(makeSweepSchedule(params).firstMarker.has_value());
    CHECK(makeSweepSchedule(params).frames == 48000 * (5 + 4));
}

TEST_CASE("Wrong sweep parameters are named", "[linearize]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto where = [](auto change)
    {
        SweepParams params;
        change(params);
        const auto result = makeSweepSignal(params);
        REQUIRE_FALSE(result.ok());
        return result.error().where;
    };
    CHECK(validate(SweepParams{}).ok());
    CHECK(where([&](auto& p) { p.lowFrequency = nan; }) == "lowFrequency");
    CHECK(where([&](auto& p) { p.lowFrequency = 0.0; }) == "lowFrequency");
    CHECK(where([&](auto& p) { p.highFrequency = 10.0; }) == "highFrequency");
    CHECK(where([&](auto& p) { p.highFrequency = 24000.0; }) == "highFrequency");
    CHECK(where([&](auto& p) { p.duration = 0.1; }) == "duration");
    CHECK(where([&](auto& p) { p.fadeIn = -1.0; }) == "fadeIn");
    CHECK(where([&](auto& p) { p.fadeOut = 11.0; }) == "fadeOut");
    CHECK(where([&](auto& p) { p.repeats = 0; }) == "repeats");
    CHECK(where([&](auto& p) { p.pause = 0.0; }) == "pause");
    CHECK(where([&](auto& p) { p.levels.clear(); }) == "levels");
    CHECK(where([&](auto& p) { p.levels = {-6.0, -3.0, 1.0}; }) == "levels[2]");
    CHECK(where([&](auto& p) { p.markerDuration = 0.1; }) == "markerDuration");
    CHECK(where([&](auto& p) { p.sampleRate = 44100.5; }) == "sampleRate");
    CHECK(where([&](auto& p) { p.sampleRate = 1e9; }) == "sampleRate");
    SweepParams long_;
    long_.duration = 600.0;
    long_.repeats = 100;
    CHECK(makeSweepSignal(long_).error().code == ErrorCode::tooLarge);
}
