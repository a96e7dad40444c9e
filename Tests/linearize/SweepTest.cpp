#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Numbers.h"

#include <pacini/linearize/SweepSchedule.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
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

TEST_CASE("Sweep parameters may be at the ends of their ranges but not beyond", "[linearize]")
{
    const auto where = [](auto change)
    {
        SweepParams params;
        change(params);
        const auto valid = validate(params);
        return valid.ok() ? std::string() : valid.error().where + ": " + valid.error().message;
    };
    const std::string fine;
    using Params = SweepParams;
    const auto small = [](Params& p)
    {
        p.lowFrequency = 1.0;
        p.highFrequency = 1.5;
    };
    CHECK(where([&](Params& p) { small(p), p.sampleRate = 2000.0; }) == fine);
    CHECK(where([&](Params& p) { p.sampleRate = 384000.0; }) == fine);
    for (const double bad : {1999.0, 384001.0, 4000.5})
        CHECK(where([&](Params& p) { small(p), p.sampleRate = bad; }) ==
              "sampleRate: must be a whole number of 2000 to 384000 Hz");
    CHECK(where([](Params& p) { p.lowFrequency = 2000.0, p.highFrequency = 3000.0; }) == fine);
    CHECK(where([](Params& p) { p.lowFrequency = 0.999; }) == "lowFrequency: must be 1 to 2000 Hz");
    CHECK(where([](Params& p) { p.lowFrequency = 2000.1, p.highFrequency = 4000.0; }) ==
          "lowFrequency: must be 1 to 2000 Hz");
    CHECK(where([](Params& p) { p.highFrequency = 15.0; }) == fine);
    CHECK(where([](Params& p) { p.highFrequency = 0.45 * 48000.0; }) == fine);
    for (const double bad : {14.99, 21600.1})
        CHECK(where([&](Params& p) { p.highFrequency = bad; }) ==
              "highFrequency: must be 1.5 times the low frequency to 0.45 of the sample rate");
    CHECK(where([](Params& p) { p.duration = 0.5; }) == fine);
    CHECK(where([](Params& p) { p.duration = 600.0; }) == fine);
    for (const double bad : {0.499, 600.1})
        CHECK(where([&](Params& p) { p.duration = bad; }) == "duration: must be 0.5 to 600 s");
    CHECK(where([](Params& p) { p.fadeIn = 10.0, p.fadeOut = 0.0; }) == fine);
    CHECK(where([](Params& p) { p.fadeIn = 10.01, p.fadeOut = 0.0; }) == "fadeIn: must be 0 s to half of the duration");
    CHECK(where([](Params& p) { p.fadeIn = -0.01; }) == "fadeIn: must be 0 s to half of the duration");
    CHECK(where([](Params& p) { p.fadeIn = 4.0, p.fadeOut = 6.0; }) == fine);
    for (const double bad : {-0.01, 6.01})
        CHECK(where([&](Params& p) { p.fadeIn = 4.0, p.fadeOut = bad; }) ==
              "fadeOut: must be 0 s or more, together with fadeIn at most half of the duration");
    CHECK(where([](Params& p) { p.duration = 1.0, p.repeats = 100; }) == fine);
    CHECK(where([](Params& p) { p.duration = 1.0, p.repeats = 101; }) == "repeats: must be 1 to 100");
    CHECK(where([](Params& p) { p.repeats = 0; }) == "repeats: must be 1 to 100");
    for (const double good : {0.2, 30.0})
        CHECK(where([&](Params& p) { p.pause = good; }) == fine);
    for (const double bad : {0.199, 30.1})
        CHECK(where([&](Params& p) { p.pause = bad; }) == "pause: must be 0.2 to 30 s");
    CHECK(where([](Params& p) { p.levels.assign(32, 0.0); }) == fine);
    CHECK(where([](Params& p) { p.levels.assign(33, 0.0); }) == "levels: must be 1 to 32 levels");
    CHECK(where([](Params& p) { p.levels = {0.0, -80.0}; }) == fine);
    for (const double bad : {0.01, -80.01})
        CHECK(where([&](Params& p) { p.levels = {0.0, bad}; }) == "levels[1]: must be -80 to 0 dB");
    for (const double good : {0.0, 0.2, 5.0})
        CHECK(where([&](Params& p) { p.markerDuration = good; }) == fine);
    for (const double bad : {-1.0, 0.199, 5.01})
        CHECK(where([&](Params& p) { p.markerDuration = bad; }) == "markerDuration: must be 0.2 to 5 s, or 0 for none");
    // two hours: 12 of 599 s and a pause of 1 s
    CHECK(where([](Params& p) { p.duration = 599.0, p.levels = {0.0, -10.0}, p.repeats = 6; }) == fine);
    CHECK(where(
              [](Params& p) {
                  p.duration = 599.1, p.levels = {0.0, -10.0}, p.repeats = 6;
              }) == "repeats: all sweeps together last more than two hours");
    const SweepParams defaults;
    CHECK(test::asNumbers(defaults.lowFrequency, defaults.highFrequency, defaults.duration, defaults.fadeIn,
                          defaults.fadeOut, defaults.repeats,
                          defaults.pause) == test::Numbers{10.0, 1500.0, 20.0, 0.1, 0.02, 1, 1.0});
    CHECK(defaults.levels == std::vector<double>{-10.0});
    CHECK(defaults.markerDuration == 0.5);
    CHECK(defaults.sampleRate == 48000.0);
}

TEST_CASE("The schedule has its markers at the level of the loudest sweep, on whole frames", "[linearize]")
{
    SweepParams params;
    params.duration = 1.00006;
    params.pause = 0.25007;
    params.levels = {-30.0, -6.0, -12.0};
    params.markerDuration = 0.3;
    params.sampleRate = 8000.0;
    const auto schedule = makeSweepSchedule(params);
    CHECK(schedule.markerLevel == -6.0);
    CHECK(schedule.firstMarker.value() == 2001);
    REQUIRE(schedule.sweeps.size() == 3);
    CHECK(schedule.sweeps[0] == ScheduledSweep{2001 + 2400 + 2001, 0, -30.0, 0});
    CHECK(schedule.sweeps[2].startFrame == 2001 + 2400 + 2001 + 2 * (8000 + 2001));
    CHECK(schedule.secondMarker.value() == 2001 + 2400 + 2001 + 3 * (8000 + 2001));
    CHECK(schedule.frames == 2001 + 2400 + 2001 + 3 * (8000 + 2001) + 2400 + 2001);
    CHECK(ScheduledSweep{} == ScheduledSweep{0, 0, 0.0, 0});
    CHECK(SweepSchedule{}.markerLevel == 0.0);
    CHECK(SweepSchedule{}.frames == 0);

    const auto marker = markerSweep(params);
    CHECK(marker.seconds() == 0.3);
    CHECK(marker.lowFrequency() == 10.0);
    CHECK(marker.frequencyAt(0.3) == Approx(1500.0));
    // fades of 6 ms: half way at 3 ms, on both sides
    const ExponentialSweep plain(10.0, 1500.0, 0.3, 0.0, 0.0);
    for (const double t : {0.003, 0.297})
        CHECK(marker.at(t) == Approx(0.5 * plain.at(t)).margin(1e-9));
    for (const double t : {0.0061, 0.15, 0.2939})
        CHECK(marker.at(t) == plain.at(t));
    CHECK(plain.at(-1e-9) == 0.0);
    CHECK(plain.at(0.3) == 0.0);
    CHECK(plain.at(0.2999) != 0.0);
    const auto signal = makeSweepSignal(params).value();
    const auto samples = sampleSweep(marker, 8000.0, std::pow(10.0, -6.0 / 20.0));
    REQUIRE(samples.size() == 2400);
    for (std::size_t n = 0; n < 2400; ++n)
    {
        CHECK(signal[2001 + n] == Approx(samples[n]).margin(1e-7));
        CHECK(signal[*schedule.secondMarker + n] == signal[2001 + n]);
    }
    const auto whole = sampleSweep(plain, 1000.0);
    CHECK(whole[150] == Approx(plain.at(0.15)).margin(1e-7));
    const auto slow = plain.byClock(0.25);
    CHECK(slow.seconds() == Approx(0.375));
    CHECK(slow.growthTime() == Approx(1.25 * plain.growthTime()));
    CHECK(slow.lowFrequency() == Approx(8.0));
    CHECK(marker.byClock(0.25).at(1.25 * 0.003) == Approx(marker.at(0.003)));
    CHECK(marker.byClock(0.25).at(1.25 * 0.298) == Approx(marker.at(0.298)));
}
