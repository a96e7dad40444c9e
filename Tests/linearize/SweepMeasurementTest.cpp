#include "support/Catch.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/foundation/Random.h>
#include <pacini/linearize/MeasurementFindings.h>
#include <pacini/linearize/ResponseSmoothing.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
LevelMeasurement steppedLevel(double level, const std::vector<double>& distortion)
{
    LevelMeasurement out;
    out.level = level;
    for (std::size_t i = 0; i < distortion.size(); ++i)
    {
        out.response.frequency.push_back(100.0 * static_cast<double>(i + 1));
        out.response.level.push_back(5.0);
    }
    out.noise = out.snr = out.response;
    out.distortion = distortion;
    return out;
}

SweepMeasurement steppedMeasurement(const std::vector<std::pair<double, double>>& steps)
{
    SweepMeasurement out;
    for (const auto& [level, distortion] : steps)
        out.levels.push_back(steppedLevel(level, {99.0, distortion, 0.5 * distortion, 99.0}));
    return out;
}

/// A resonance at 67 Hz with Q 4 and its impulse response, `late` s later than usual.
SweepMeasurement springMeasurement(double q, double distortion, double level)
{
    SweepMeasurement out;
    LevelMeasurement one;
    one.response.frequency = logSpaced(20.0, 1000.0, 80);
    ResonanceModel model;
    model.q = q;
    for (const double f : one.response.frequency)
        one.response.level.push_back(model.level(f));
    for (const double f : one.response.frequency)
        one.distortion.push_back(f < 30.0 ? 90.0 : distortion * (f > 300.0 ? 1.0 : 0.5));
    one.level = level;
    out.levels = {one, one};
    out.levels[0].level = level - 10.0;
    for (double& v : out.levels[0].distortion)
        v *= 0.1;
    out.main = 1;
    out.impulseResponse = {4000.0, 50, std::vector<double>(50, 0.0)};
    const double w0 = 2.0 * std::numbers::pi * 67.0;
    for (int n = 0; n < 3000; ++n)
        out.impulseResponse.samples.push_back(std::exp(-0.5 * w0 * n / 4000.0 / q) * std::sin(w0 * n / 4000.0));
    return out;
}
} // namespace

TEST_CASE("A gain is taken out of responses and their noise, not out of their ratio", "[linearize]")
{
    auto measurement = steppedMeasurement({{0.0, 1.0}, {-6.0, 0.5}});
    takeOut(measurement, 1.5);
    for (const auto& level : measurement.levels)
    {
        CHECK(level.response.level == std::vector<double>(4, 3.5));
        CHECK(level.noise.level == std::vector<double>(4, 3.5));
        CHECK(level.snr.level == std::vector<double>(4, 5.0));
    }
    CHECK(measurement.main == 0);
    CHECK(measurement.latency == 0.0);
    CHECK(&measurement.response() == &measurement.levels[0].response);
    measurement.main = 1;
    CHECK(&measurement.response() == &measurement.levels[1].response);
    CHECK(LevelMeasurement{}.level == 0.0);
    CHECK(HarmonicResponse{}.order == 2);
    CHECK(ImpulseResponse{}.sampleRate == 0.0);
    CHECK(ImpulseResponse{}.origin == 0);
}

TEST_CASE("The largest distortion is that of the range, both ends included", "[linearize]")
{
    const auto level = steppedLevel(0.0, {7.0, 2.0, 3.0, 9.0});
    CHECK(largestDistortion(level, 200.0, 300.0) == 3.0);
    CHECK(largestDistortion(level, 200.0, 299.0) == 2.0);
    CHECK(largestDistortion(level, 201.0, 300.0) == 3.0);
    CHECK(largestDistortion(level, 100.0, 300.0) == 7.0);
    CHECK(largestDistortion(level, 0.0, 1e6) == 9.0);
    CHECK(largestDistortion(level, 110.0, 190.0) == 0.0);
}

TEST_CASE("The drive of a distortion lies between two steps, on a line of its logarithm", "[linearize]")
{
    const auto drive = [](const std::vector<std::pair<double, double>>& steps, double limit)
    {
        return driveAtDistortion(steppedMeasurement(steps), limit, 200.0, 300.0);
    };
    // in any order: 8 % at 0, 2 % at -10, 0.5 % at -20 dB
    const std::vector<std::pair<double, double>> steps{{-10.0, 2.0}, {0.0, 8.0}, {-20.0, 0.5}};
    CHECK(drive(steps, 4.0).value() == Approx(-5.0));
    CHECK(drive(steps, 1.0).value() == Approx(-15.0));
    CHECK(drive(steps, std::pow(2.0, 1.5)).value() == Approx(-7.5));
    CHECK(drive(steps, 2.0).value() == Approx(-10.0));
    CHECK(drive(steps, 8.0).value() == Approx(0.0).margin(1e-12));
    CHECK_FALSE(drive(steps, 8.01).has_value());
    CHECK(drive(steps, 0.5).value() == -20.0);
    CHECK(drive(steps, 0.1).value() == -20.0);
    CHECK(drive(steps, 0.0).value() == -20.0);
    CHECK_FALSE(drive({}, 1.0).has_value());
    CHECK(drive({{-3.0, 5.0}}, 1.0).value() == -3.0);
    CHECK(drive({{-3.0, 5.0}, {-13.0, 0.0}}, 1.0).value() == -3.0); // a logarithm of nothing
    // noise distorts the weakest
    CHECK(drive({{0.0, 8.0}, {-10.0, 2.0}, {-20.0, 50.0}}, 4.0).value() == Approx(-5.0));
}

TEST_CASE("Findings are those of the placements that are no outliers, medians of times and drives", "[linearize]")
{
    const std::vector<SweepMeasurement> measured{springMeasurement(4.0, 20.0, -3.0), springMeasurement(5.0, 40.0, -6.0),
                                                 springMeasurement(3.0, 12.0, 0.0), springMeasurement(9.0, 80.0, -1.0)};
    PlacementAverage average;
    average.response = measured[0].response();
    average.outliers = {{3, 1.0, 2.0}};
    std::vector<const SweepMeasurement*> placements;
    for (const auto& one : measured)
        placements.push_back(&one);
    const auto findings = findingsOf(placements, average, 0.0, 3.0).value();
    CHECK(findings.features.resonance.frequency == Approx(67.0).epsilon(1e-3));
    CHECK(findings.features.resonance.q == Approx(4.0).epsilon(1e-2));
    CHECK(findings.outliers == std::set<std::size_t>{3});
    REQUIRE(findings.times.has_value());
    const auto middle = burstTimes(measured[0].impulseResponse, findings.features.resonance.frequency).value();
    CHECK(findings.times->riseTime == middle.riseTime);
    CHECK(findings.times->fallTime == middle.fallTime);
    CHECK(findings.features.felt.low > 30.0);
    CHECK(findings.distortion == 40.0);
    // from 20 to 2, 40 to 4 and 12 to 1.2 % over 10 dB
    const auto at = [](double level, double most, double limit)
    {
        return level - 10.0 + 10.0 * std::log10(limit / (0.1 * most));
    };
    CHECK(findings.distortionDrive.value() == Approx(at(-3.0, 20.0, 3.0)));
    CHECK(findings.profileDrive.value() == Approx(at(-3.0, 20.0, 10.0)));
    const auto strict = findingsOf(placements, average, 0.0, 30.0).value();
    CHECK(strict.distortionDrive.value() == Approx(at(-6.0, 40.0, 30.0))); // one alone gets there
    CHECK_FALSE(findingsOf(placements, average, 0.0, 41.0)->distortionDrive.has_value());
    average.outliers = {{0, 0.0, 0.0}, {1, 0.0, 0.0}, {2, 0.0, 0.0}, {3, 0.0, 0.0}};
    const auto none = findingsOf(placements, average, 0.0, 3.0).value();
    CHECK_FALSE(none.times.has_value());
    CHECK(none.distortion == 0.0);
    CHECK_FALSE(none.profileDrive.has_value());
    average.response.level.pop_back();
    CHECK(findingsOf(placements, average, 0.0, 3.0).error().where == "points");
    CHECK(MeasurementFindings{}.distortion == 0.0);
}

TEST_CASE("Fits of a resonance are those that they were", "[linearize]")
{
    std::vector<double> values;
    Random random(13);
    const auto add = [&](const FrequencyResponse& response, double low, double high, double octaves)
    {
        const auto fit = fitResonance(response, low, high, octaves).value();
        values.insert(values.end(),
                      {std::log(fit.frequency), std::log(fit.q), fit.gain, static_cast<double>(fit.slope), fit.error});
    };
    for (const double q : {0.4, 1.9, 6.0, 60.0})
        for (const int slope : {0, 1, 2})
        {
            ResonanceModel model;
            model.q = q;
            model.slope = slope;
            model.frequency = 90.0;
            FrequencyResponse response{logSpaced(20.0, 900.0, 60), {}};
            for (const double f : response.frequency)
                response.level.push_back(model.level(f, 1.0 / 12.0) + random.uniform(-1.0, 1.0) +
                                         (f > 500.0 ? 6.0 : 0.0)); // another resonance begins
            add(response, 20.0, 900.0, 1.0 / 12.0);
            if (slope == 2)
                add(response, 30.0, 5000.0, 0.0);
        }
    // more than 400 points: each second or third one counts
    ResonanceModel model;
    FrequencyResponse dense{logSpaced(20.0, 900.0, 1201), {}};
    for (const double f : dense.frequency)
        dense.level.push_back(model.level(f) + random.uniform(-2.0, 2.0));
    add(dense, 20.0, 900.0, 0.0);
    add(dense, 20.0, 90.0, 0.0);
    // a peak at the end, of few points
    FrequencyResponse few{logSpaced(50.0, 70.0, 8), {}};
    for (const double f : few.frequency)
        few.level.push_back(model.level(f));
    add(few, 50.0, 70.0, 0.0);
    checkPinned("linearize/resonances", values, 1e-4);
    CHECK(fitResonance(few, 50.0, 70.0).ok());
    CHECK(fitResonance(few, 50.1, 70.0).error().message == "has fewer than 8 points in the range of the resonance");
    CHECK(fitResonance(few, 50.0, 69.9).error().code == ErrorCode::truncated);
    const ResonanceModel usual;
    CHECK(test::asNumbers(usual.frequency, usual.q, usual.gain, usual.slope, usual.error) ==
          test::Numbers{67.0, 1.0, 0.0, 2, 0.0});
}
