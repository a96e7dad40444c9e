#include "linearize/DroppedFrames.h"
#include "linearize/QuickSweep.h"
#include "support/Catch.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/linearize/SimulatedRig.h>
#include <pacini/linearize/SweepAnalysis.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
RigParams riggedAt(double rate)
{
    RigParams rig;
    rig.sampleRate = rate;
    rig.bits = 0;
    return rig;
}

void pinMeasurement(const std::string& name, const SweepMeasurement& m)
{
    for (std::size_t i = 0; i < m.levels.size(); ++i)
    {
        const std::string at = "linearize/measured " + name + ", level " + std::to_string(i) + ", ";
        checkPinned(at + "response", m.levels[i].response.level, 1e-4);
        checkPinned(at + "snr", m.levels[i].snr.level, 1e-3);
        checkPinned(at + "distortion", m.levels[i].distortion, 1e-3);
        for (const HarmonicResponse& harmonic : m.levels[i].harmonics)
            checkPinned(at + "order " + std::to_string(harmonic.order), harmonic.response.level, 1e-3);
    }
    checkPinned("linearize/measured " + name + ", impulse", m.impulseResponse.samples, 1e-4);
    checkPinned("linearize/measured " + name + ", clock and latency",
                {static_cast<double>(m.main), m.latency, m.driftPpm.value_or(-1.0), m.impulseResponse.sampleRate,
                 static_cast<double>(m.impulseResponse.origin), static_cast<double>(m.warnings.size())},
                1e-3);
}
} // namespace

TEST_CASE("The rig is by default a wristband with three axes of 12 bits and a clock 50 ppm off", "[linearize]")
{
    const RigParams rig;
    REQUIRE(rig.body.has_value());
    CHECK(*rig.body == BodyParams{1.342, 0.012, 0.04, 40000.0, 5.0, 0.01, 800.0, 2.5});
    CHECK(rig.resonance.frequency == 67.0);
    CHECK(rig.resonance.q == 3.97);
    CHECK(rig.point == BodyPoint::device);
    CHECK(rig.contact == 0.0);
    CHECK(rig.polynomial == std::vector<double>{0.0, 1.0});
    CHECK(rig.range == Approx(5.0 * 9.80665));
    CHECK(rig.noiseDensity == Approx(250e-6 * 9.80665));
    CHECK(test::asNumbers(rig.bits, rig.axes, rig.latency, rig.driftPpm, rig.tail, rig.seed, rig.sampleRate) ==
          test::Numbers{12, 3, 0.0123456, 50.0, 0.5, 1, 48000.0});
}

TEST_CASE("Between its samples an oversampled signal is what it was", "[linearize]")
{
    std::vector<double> x;
    for (int n = 0; n < 100; ++n)
        x.push_back(std::sin(0.3 * n + 0.2));
    for (const double at : {20.0, 20.1, 33.5, 47.999, 60.25, 79.75})
        CHECK(detail::between(x, at) == Approx(std::sin(0.3 * at + 0.2)).margin(1e-4));
    CHECK(detail::between(x, 0.0) == x[0]);
    CHECK(detail::between(x, 99.0) == x[99]);
    CHECK(detail::between(x, 100.0) == 0.0);
    CHECK(detail::between(x, -1.0) == 0.0);
    CHECK(detail::between(x, -17.5) == 0.0);
    CHECK(detail::between(x, 120.5) == 0.0);
    std::vector<double> one(64, 0.0);
    one[30] = 1.0;
    std::vector<double> values;
    for (double at = 13.0; at < 48.0; at += 0.37)
        values.push_back(detail::between(one, at));
    checkPinned("linearize/between the samples of an impulse", values);
    const auto direction = detail::randomDirection(3);
    CHECK(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2] == Approx(1.0));
    CHECK(detail::randomDirection(4) != direction);
}

TEST_CASE("What a rig records is what it recorded", "[linearize]")
{
    std::vector<float> drive;
    for (int n = 0; n < 1500; ++n)
        drive.push_back(static_cast<float>(0.3 * std::sin(0.0001 * n * n)));
    const auto pin = [&](const char* name, const RigParams& rig)
    {
        const auto recorded = recordOnRig(drive, rig);
        for (std::size_t c = 0; c < recorded.size(); ++c)
        {
            const std::vector<double> values(recorded[c].begin(), recorded[c].end());
            checkPinned(std::string("linearize/rig, ") + name + ", axis " + std::to_string(c), values, 1e-5);
        }
    };
    auto rig = riggedAt(4000.0);
    pin("three axes", rig);
    rig.axes = 1;
    rig.contact = -6.0;
    rig.seed = 5;
    rig.driftPpm = -800.0;
    rig.tail = 0.1;
    pin("one loose axis", rig);
    rig.axes = 2;
    rig.point = BodyPoint::skin;
    rig.polynomial = {0.01, 1.0, 0.2, -0.3};
    rig.noiseDensity = 0.1;
    rig.range = 3.0; // cut off
    pin("beyond the range", rig);
    rig.body.reset();
    rig.range = 1.0;
    rig.latency = -0.05;
    pin("no body", rig);
    RigParams loose = riggedAt(4000.0);
    loose.contact = -6.0;
    CHECK(rigLevel(loose, 100.0) == Approx(rigLevel(riggedAt(4000.0), 100.0) - 6.0));
    std::vector<double> levels;
    for (const double f : {10.0, 50.0, 67.0, 120.0, 900.0})
        levels.push_back(rigLevel(loose, f));
    checkPinned("linearize/rig, levels", levels);
}

TEST_CASE("Measurements of rigs are those that they were", "[linearize]")
{
    const auto sweep = quickSweep(2.0, 0.5, {-16.0, -6.0});
    MeasurementParams params;
    params.points = 40;
    const auto measured = [&](const RigParams& rig, const SweepParams& played)
    {
        params.fullScale = {rig.range};
        const auto result =
            analyseSweeps(recordOnRig(makeSweepSignal(played).value(), rig), rig.sampleRate, played, params);
        REQUIRE(result.ok());
        return *result;
    };
    auto rig = riggedAt(4000.0);
    pinMeasurement("wristband", measured(rig, sweep));
    rig.body.reset();
    rig.axes = 1;
    rig.range = 2.0;
    rig.noiseDensity = 1e-4;
    rig.polynomial = {0.0, 1.0, 0.1, 0.2};
    params.smoothing = 1.0 / 3.0;
    params.harmonics = 3;
    params.lowFrequency = 40.0;
    params.highFrequency = 500.0;
    auto played = sweep;
    played.repeats = 2;
    played.levels = {-3.0};
    played.duration = 1.0;
    played.markerDuration = 0.0;
    pinMeasurement("curve", measured(rig, played));
    auto recording = recordOnRig(makeSweepSignal(sweep).value(), rig);
    drop(recording, 9000, 40);
    params.harmonics = 1;
    params.fullScale = {2.0};
    const auto lost = analyseSweeps(recording, 4000.0, sweep, params).value();
    pinMeasurement("gap", lost);
    std::size_t named = 0;
    for (const MeasurementWarning& warning : lost.warnings)
        if (warning.code == MeasurementDefect::droppedFrames)
        {
            ++named;
            CHECK(std::stod(warning.message) == Approx(40.0).margin(1.0));
            CHECK(warning.message.find(" frames are missing about here; use larger buffers and measure again") !=
                  std::string::npos);
        }
    CHECK(named == 1);
}

TEST_CASE("The strongest direction of tilted axes is that of the movement", "[linearize]")
{
    const double direction[] = {0.48, -0.64, 0.6};
    std::vector<ResponseCut> cuts(3);
    for (std::size_t c = 0; c < 3; ++c)
    {
        cuts[c].firstLag = -7;
        for (int i = 0; i < 50; ++i)
            cuts[c].samples.push_back(direction[c] * std::sin(0.7 * i) * std::exp(-0.05 * i));
    }
    const auto found = strongestDirection(cuts, 800.0);
    CHECK(found.sampleRate == 800.0);
    CHECK(found.origin == 7);
    REQUIRE(found.samples.size() == 50);
    for (int i = 0; i < 50; ++i) // the largest component is negative, and the direction has its sign
        CHECK(found.samples[static_cast<std::size_t>(i)] ==
              Approx(-std::sin(0.7 * i) * std::exp(-0.05 * i)).margin(1e-9));
    // the envelope of a symmetrical pulse is strongest in its middle, between samples too
    for (const double middle : {60.0, 60.25, 60.5, 60.9})
    {
        ImpulseResponse pulse{1000.0, 20, {}};
        for (int i = 0; i < 120; ++i)
            pulse.samples.push_back(std::cos(1.1 * (i - middle) + 0.7) *
                                    std::exp(-0.005 * (i - middle) * (i - middle)));
        CHECK(strongestLag(pulse) == Approx((middle - 20.0) / 1000.0).margin(2e-6));
    }
    ImpulseResponse edge{1000.0, 0, std::vector<double>(50, 0.0)};
    edge.samples[0] = 1.0;
    CHECK(strongestLag(edge) == Approx(0.0).margin(1e-3));
}

TEST_CASE("An analysis that cannot be says which number is wrong", "[linearize]")
{
    const auto sweep = quickSweep(2.0, 0.5, {-16.0, -6.0});
    std::vector<std::vector<float>> recording{std::vector<float>(40000, 0.1f)};
    const auto failure = [&](double rate, const SweepParams& played, const MeasurementParams& params)
    {
        const auto result = analyseSweeps(recording, rate, played, params);
        REQUIRE_FALSE(result.ok());
        return result.error().where + ": " + result.error().message;
    };
    for (const double bad : {1999.0, 384001.0, 4000.5, std::nan("")})
        CHECK(failure(bad, sweep, {}) == "sampleRate: must be a whole number of 2000 to 384000 Hz");
    CHECK(failure(2666.0, sweep, {}) == "sampleRate: is too low for the sweep's highest frequency");
    MeasurementParams params;
    params.lowFrequency = 1150.0;
    params.highFrequency = 5000.0;
    CHECK(failure(4000.0, sweep, params) == "measurement.lowFrequency: leaves no frequency of the sweep's range");
    params.lowFrequency = 1.0;
    params.highFrequency = 20.5;
    CHECK(failure(4000.0, sweep, params) == "measurement.lowFrequency: leaves no frequency of the sweep's range");
    params = {};
    params.points = 3;
    CHECK(failure(4000.0, sweep, params) == "measurement.points: must be 8 to 10000");
    SweepParams wrong = sweep;
    wrong.repeats = 0;
    CHECK(failure(4000.0, wrong, {}) == "sweep.repeats: must be 1 to 100");
    CHECK(failure(4000.0, sweep, {}) ==
          "channels: contain no sweep above the noise; check cables, levels and the settings of the sweep");
    // From the first to the end of the last sweep 4.5 s are needed, 1 % less for the clocks.
    recording[0].resize(17820);
    CHECK(failure(4000.0, sweep, {}).substr(0, 21) == "channels: contain no ");
    recording[0].resize(17819);
    CHECK(failure(4000.0, sweep, {}) == "channels: last 4.45 s, the sweeps last 4.50 s; record until the end");
}
