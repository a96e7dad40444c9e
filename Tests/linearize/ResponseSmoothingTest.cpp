#include "support/Catch.h"
#include "support/Numbers.h"

#include <pacini/linearize/FrequencyResponse.h>
#include <pacini/linearize/LagWindow.h>
#include <pacini/linearize/MeasurementParams.h>
#include <pacini/linearize/RecordedChannels.h>
#include <pacini/linearize/ResponseSmoothing.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

using namespace pacini;

TEST_CASE("A mean over octaves is the integral of the lines between the powers", "[linearize]")
{
    const std::vector<double> frequency{100.0, 130.0, 200.0, 210.0, 400.0, 900.0};
    const std::vector<double> power{1.0, 5.0, 2.0, 8.0, 0.5, 3.0};
    const SmoothedPower smoothed(frequency, power);
    const auto lineAt = [&](double f)
    {
        f = std::clamp(f, 100.0, 900.0);
        std::size_t i = 1;
        while (i + 1 < frequency.size() && frequency[i] < f)
            ++i;
        const double part = std::log(f / frequency[i - 1]) / std::log(frequency[i] / frequency[i - 1]);
        return power[i - 1] + part * (power[i] - power[i - 1]);
    };
    for (const double f : {20.0, 100.0, 101.0, 130.0, 150.0, 205.0, 300.0, 700.0, 900.0, 2000.0})
        for (const double octaves : {0.0, 0.1, 0.5, 1.0, 3.0})
        {
            const double low = std::clamp(f * std::exp2(-octaves / 2.0), 100.0, 900.0);
            const double high = std::clamp(f * std::exp2(octaves / 2.0), 100.0, 900.0);
            double mean = 0.0;
            constexpr int pieces = 4000;
            for (int i = 0; i < pieces; ++i)
                mean += lineAt(low * std::pow(high / low, (i + 0.5) / pieces)) / pieces;
            CAPTURE(f, octaves);
            CHECK(smoothed.at(f, octaves) == Approx(mean).epsilon(2e-4));
        }
    CHECK(smoothed.at(130.0, 0.0) == Approx(5.0));
    CHECK(smoothed.at(50.0, 0.0) == Approx(1.0));
    CHECK(smoothed.at(5000.0, 1.0 / 3.0) == Approx(3.0));
    // two points are enough
    const SmoothedPower two(std::vector<double>{100.0, 400.0}, std::vector<double>{2.0, 4.0});
    CHECK(two.at(200.0, 0.0) == Approx(3.0));
    CHECK(two.at(200.0, 1.0) == Approx(3.0));
    CHECK(two.at(400.0, 2.0) == Approx(3.5));
}

TEST_CASE("Frequencies evenly in octaves have both ends exactly", "[linearize]")
{
    const auto f = logSpaced(10.0, 1000.0, 5);
    REQUIRE(f.size() == 5);
    CHECK(f.front() == 10.0);
    CHECK(f[1] == Approx(10.0 * std::sqrt(10.0)));
    CHECK(f[2] == Approx(100.0));
    CHECK(f[3] == Approx(100.0 * std::sqrt(10.0)));
    CHECK(f.back() == 1000.0);
    CHECK(logSpaced(17.3, 1931.7, 97).back() == 1931.7);
    CHECK(logSpaced(3.0, 7.0, 2) == std::vector<double>{3.0, 7.0});
}

TEST_CASE("A lag window rises and falls by raised cosines and is 1 between", "[linearize]")
{
    const LagWindow window{-2.0, -1.0, 3.0, 7.0};
    CHECK(window.at(-2.0) == 0.0);
    CHECK(window.at(-2.1) == 0.0);
    CHECK(window.at(-1.75) == Approx(0.5 - 0.5 * std::cos(0.25 * std::numbers::pi)));
    CHECK(window.at(-1.5) == Approx(0.5));
    CHECK(window.at(-1.0) == 1.0);
    CHECK(window.at(0.0) == 1.0);
    CHECK(window.at(3.0) == 1.0);
    CHECK(window.at(4.0) == Approx(0.5 - 0.5 * std::cos(0.75 * std::numbers::pi)));
    CHECK(window.at(5.0) == Approx(0.5));
    CHECK(window.at(7.0) == 0.0);
    CHECK(window.at(8.0) == 0.0);
    const auto sides = LagWindow::withSides(-1.0, 4.0, 0.2);
    CHECK(sides.begin == -1.0);
    CHECK(sides.flatBegin == Approx(0.0).margin(1e-12));
    CHECK(sides.flatEnd == Approx(3.0));
    CHECK(sides.end == 4.0);
    const LagWindow none;
    CHECK(none.begin == 0.0);
    CHECK(none.flatBegin == 0.0);
    CHECK(none.flatEnd == 0.0);
    CHECK(none.end == 0.0);
    CHECK(none.at(0.0) == 0.0);
}

TEST_CASE("A cut of a circular response has its lags in order, times the window", "[linearize]")
{
    std::vector<double> circular;
    for (int i = 0; i < 20; ++i)
        circular.push_back(100.0 + i);
    const LagWindow window{-0.31, -0.15, 0.2, 0.45};
    const auto cut = cutResponse(circular, 10.0, window);
    CHECK(cut.firstLag == -3);
    REQUIRE(cut.samples.size() == 8); // lags -3 to 4
    double energy = 0.0;
    for (std::size_t i = 0; i < 8; ++i)
    {
        const int lag = static_cast<int>(i) - 3;
        const double w = window.at(0.1 * lag);
        CHECK(cut.samples[i] == Approx(w * circular[static_cast<std::size_t>(lag < 0 ? lag + 20 : lag)]));
        energy += w * w;
    }
    CHECK(cut.windowEnergy == Approx(energy));
    // around the circle more than once
    const auto around = cutResponse(circular, 10.0, {-5.05, -5.0, 2.5, 2.55});
    CHECK(around.firstLag == -50);
    CHECK(around.samples[0] == Approx(circular[10]));
    CHECK(around.samples[50] == Approx(circular[0]));
    CHECK(around.samples[75] == Approx(circular[5]));
    CHECK(ResponseCut{}.firstLag == 0);
    CHECK(ResponseCut{}.windowEnergy == 0.0);
}

TEST_CASE("A part of a recording is free of its mean and zero where nothing was recorded", "[linearize]")
{
    const RecordedChannels recording{10.0, {{1.0, 2.0, 3.0, 4.0}, {5.0, 5.0, 5.0, 9.0}}};
    CHECK(recording.frames() == 4);
    CHECK(recording.seconds() == Approx(0.4));
    CHECK(recording.part(0, 0, 4) == std::vector<double>{-1.5, -0.5, 0.5, 1.5});
    CHECK(recording.part(1, 1, 3) == std::vector<double>{5.0 - 19.0 / 3.0, 5.0 - 19.0 / 3.0, 9.0 - 19.0 / 3.0});
    CHECK(recording.part(0, -2, 4) == std::vector<double>{0.0, 0.0, -0.5, 0.5});
    CHECK(recording.part(0, 3, 3) == std::vector<double>{0.0, 0.0, 0.0});
    CHECK(recording.part(0, 2, 4) == std::vector<double>{-0.5, 0.5, 0.0, 0.0});
    CHECK(recording.part(0, 9, 2) == std::vector<double>{0.0, 0.0});
    CHECK(recording.part(0, -9, 2) == std::vector<double>{0.0, 0.0});
    const RecordedChannels none{10.0, {}};
    CHECK(none.frames() == 0);
}

TEST_CASE("The reduced rate is the lowest whole division that holds the margin", "[linearize]")
{
    CHECK(reducedRate(48000, 1500.0, 2.5) == 4000); // 12.8: by 12
    CHECK(reducedRate(48000, 1500.0, 2.0) == 3000); // exactly 16
    CHECK(reducedRate(48000, 1600.0, 2.5) == 4000); // exactly 12
    CHECK(reducedRate(44100, 1500.0, 2.5) == 4410); // 11.76: neither 11 but 10
    CHECK(reducedRate(48000, 20000.0, 2.5) == 48000);
    CHECK(reducedRate(47, 1.0, 2.5) == 47); // a prime
    CHECK(reducedRate(9, 1.0, 3.0) == 3);
    CHECK(reducedRate(8, 1.0, 4.0) == 4);
}

TEST_CASE("Channels at a reduced rate keep what is below it, scaled and without their mean", "[linearize]")
{
    std::vector<std::vector<float>> recording(2);
    for (int n = 0; n < 8000; ++n)
    {
        recording[0].push_back(static_cast<float>(0.25 + 0.5 * std::sin(2.0 * std::numbers::pi * 50.0 * n / 8000.0)));
        recording[1].push_back(
            static_cast<float>(-0.125 + 0.5 * std::sin(2.0 * std::numbers::pi * 3000.0 * n / 8000.0)));
    }
    const double scale[] = {3.0, -2.0};
    const auto reduced = reduceRate(recording, 8000, 300.0, 2.5, scale);
    CHECK(reduced.rate == 800.0);
    REQUIRE(reduced.channels.size() == 2);
    REQUIRE(reduced.frames() == 800);
    for (std::size_t n = 100; n < 700; ++n)
    {
        CHECK(reduced.channels[0][n] ==
              Approx(1.5 * std::sin(2.0 * std::numbers::pi * 50.0 * static_cast<double>(n) / 800.0)).margin(1e-3));
        CHECK(std::abs(reduced.channels[1][n]) < 1e-3);
    }
    const auto same = reduceRate(recording, 8000, 3000.0, 2.5, scale);
    CHECK(same.rate == 8000.0);
    CHECK(same.channels[1][100] ==
          Approx(-1.0 * std::sin(2.0 * std::numbers::pi * 3000.0 * 100.0 / 8000.0)).margin(1e-3));
}

TEST_CASE("Parameters of an analysis may be at the ends of their ranges but not beyond", "[linearize]")
{
    const auto where = [](auto change, std::size_t channels = 2)
    {
        MeasurementParams params;
        change(params);
        const auto valid = validate(params, channels);
        CHECK((valid.ok() || valid.error().code == ErrorCode::invalidArgument));
        return valid.ok() ? std::string() : valid.error().where + ": " + valid.error().message;
    };
    using Params = MeasurementParams;
    const std::string fine;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(where([](Params&) {}) == fine);
    CHECK(where([](Params& p) { p.fullScale = {2.0, 3.0}; }) == fine);
    CHECK(where(
              [](Params& p) {
                  p.fullScale = {2.0, 3.0, 4.0};
              }) == "fullScale: must be one value, or one for each channel");
    CHECK(where([](Params& p) { p.fullScale.clear(); }) == "fullScale: must be one value, or one for each channel");
    CHECK(where(
              [](Params& p) {
                  p.fullScale = {2.0, 3.0};
              },
              3) == "fullScale: must be one value, or one for each channel");
    for (const double good : {1e-6, 1e6, -1e-6, -1e6})
        CHECK(where([&](Params& p) { p.fullScale = {1.0, good}; }) == fine);
    for (const double bad : {0.0, 0.99e-6, 1.01e6, -1.01e6, nan})
        CHECK(where([&](Params& p) { p.fullScale = {1.0, bad}; }) == "fullScale[1]: must be 0.000001 to 1000000 m/s^2");
    for (const double good : {0.0, 2.0})
        CHECK(where([&](Params& p) { p.smoothing = good; }) == fine);
    for (const double bad : {-0.01, 2.01, nan})
        CHECK(where([&](Params& p) { p.smoothing = bad; }) == "smoothing: must be 0 to 2 octaves");
    for (const std::size_t good : {8u, 10000u})
        CHECK(where([&](Params& p) { p.points = good; }) == fine);
    for (const std::size_t bad : {7u, 10001u})
        CHECK(where([&](Params& p) { p.points = bad; }) == "points: must be 8 to 10000");
    CHECK(where([](Params& p) { p.lowFrequency = 0.1; }) == fine);
    for (const double bad : {0.099, nan, 200001.0})
        CHECK(where([&](Params& p) { p.lowFrequency = bad; }) == "lowFrequency: must be 0.1 to 200000 Hz");
    CHECK(where([](Params& p) { p.lowFrequency = 100.0, p.highFrequency = 1.1 * 100.0; }) == fine);
    CHECK(where([](Params& p) { p.lowFrequency = 100.0, p.highFrequency = 109.9; }) ==
          "highFrequency: must be 1.1 times lowFrequency to 200000 Hz");
    CHECK(where([](Params& p) { p.lowFrequency = 200000.0; }) ==
          "highFrequency: must be 1.1 times lowFrequency to 200000 Hz");
    CHECK(where([](Params& p) { p.highFrequency = 200001.0; }) ==
          "highFrequency: must be 1.1 times lowFrequency to 200000 Hz");
    for (const int good : {1, 9})
        CHECK(where([&](Params& p) { p.harmonics = good; }) == fine);
    for (const int bad : {0, 10})
        CHECK(where([&](Params& p) { p.harmonics = bad; }) == "harmonics: must be 1 to 9");
    for (const double good : {0.0, 5000.0})
    {
        CHECK(where([&](Params& p) { p.driftWarning = good; }) == fine);
        CHECK(where([&](Params& p) { p.driftLimit = good; }) == fine);
    }
    for (const double bad : {-0.01, 5000.1, nan})
    {
        CHECK(where([&](Params& p) { p.driftWarning = bad; }) == "driftWarning: must be 0 to 5000 ppm");
        CHECK(where([&](Params& p) { p.driftLimit = bad; }) == "driftLimit: must be 0 to 5000 ppm");
    }
    for (const double good : {-100.0, 200.0})
        CHECK(where([&](Params& p) { p.wantedSnr = good; }) == fine);
    for (const double bad : {-100.1, 200.1, nan})
        CHECK(where([&](Params& p) { p.wantedSnr = bad; }) == "wantedSnr: must be -100 to 200 dB");
    const MeasurementParams defaults;
    CHECK(defaults.fullScale == std::vector<double>{1.0});
    CHECK(defaults.smoothing == 1.0 / 12.0);
    CHECK(test::asNumbers(defaults.points, defaults.lowFrequency, defaults.highFrequency, defaults.harmonics) ==
          test::Numbers{240, 1.0, 200000.0, 5});
    CHECK(test::asNumbers(defaults.driftWarning, defaults.driftLimit, defaults.wantedSnr, defaults.equalized) ==
          test::Numbers{20.0, 2000.0, 10.0, false});
}

TEST_CASE("A response has 8 to 100000 points, in their ranges and order", "[linearize]")
{
    FrequencyResponse good;
    for (int i = 0; i < 8; ++i)
    {
        good.frequency.push_back(100.0 + i);
        good.level.push_back(0.0);
    }
    const auto where = [&](auto change)
    {
        auto response = good;
        change(response);
        const auto valid = validate(response);
        return valid.ok() ? std::string() : valid.error().where + ": " + valid.error().message;
    };
    using Response = FrequencyResponse;
    CHECK(where([](Response&) {}).empty());
    CHECK(where([](Response& r) { r.frequency[0] = 0.1, r.frequency[7] = 200000.0; }).empty());
    CHECK(where([](Response& r) { r.level[0] = -400.0, r.level[7] = 400.0; }).empty());
    CHECK(where([](Response& r) { r.frequency[0] = 0.099; }) == "points[0].frequency: must be 0.1 to 200000 Hz");
    CHECK(where([](Response& r) { r.frequency[7] = 200000.1; }) == "points[7].frequency: must be 0.1 to 200000 Hz");
    CHECK(where([](Response& r) { r.level[3] = 400.1; }) == "points[3].level: must be -400 to 400 dB");
    CHECK(where([](Response& r) { r.level[3] = -400.1; }) == "points[3].level: must be -400 to 400 dB");
    CHECK(where([](Response& r) { r.frequency[1] = 100.0; }) ==
          "points[1].frequency: must be above the one before; sort the lines by frequency, without duplicates");
    CHECK(where([](Response& r) { r.level.pop_back(); }) == "points: has a different number of levels and frequencies");
    CHECK(where([](Response& r) { r.level.pop_back(), r.frequency.pop_back(); }) ==
          "points: has fewer than 8 points; measure at more frequencies");
    Response many;
    for (int i = 0; i < 100001; ++i)
    {
        many.frequency.push_back(1.0 + i);
        many.level.push_back(0.0);
    }
    CHECK(validate(many).error().code == ErrorCode::tooLarge);
    CHECK(validate(many).error().message == "has more than 100000 points; thin or smooth the response first");
    many.frequency.pop_back();
    many.level.pop_back();
    CHECK(validate(many).ok());
}
