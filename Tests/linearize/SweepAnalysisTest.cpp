#include "linearize/DroppedFrames.h"
#include "support/Catch.h"

#include <pacini/linearize/SimulatedRig.h>
#include <pacini/linearize/SweepAnalysis.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace pacini;
using namespace pacini::test;

namespace
{
SweepParams sweepOf(double seconds, double level = -12.0)
{
    SweepParams params;
    params.duration = seconds;
    params.levels = {level};
    return params;
}

MeasurementParams calibratedFor(const RigParams& rig)
{
    MeasurementParams params;
    params.fullScale = {rig.range};
    return params;
}

SweepMeasurement measured(const SweepParams& sweep, const RigParams& rig)
{
    const auto recording = recordOnRig(makeSweepSignal(sweep).value(), rig);
    const auto result = analyseSweeps(recording, rig.sampleRate, sweep, calibratedFor(rig));
    REQUIRE(result.ok());
    return result.value();
}

/// The largest distance to the body's own response from 20 to 1000 Hz, dB.
double largestError(const FrequencyResponse& response, const RigParams& rig)
{
    double largest = 0.0;
    for (std::size_t i = 0; i < response.size(); ++i)
        if (response.frequency[i] >= 20.0 && response.frequency[i] <= 1000.0)
            largest = std::max(largest, std::abs(response.level[i] - rigLevel(rig, response.frequency[i])));
    return largest;
}

std::size_t count(const SweepMeasurement& measurement, MeasurementDefect defect)
{
    return static_cast<std::size_t>(std::count_if(measurement.warnings.begin(), measurement.warnings.end(),
                                                  [&](const auto& warning) { return warning.code == defect; }));
}

const MeasurementWarning& warning(const SweepMeasurement& measurement, MeasurementDefect defect)
{
    REQUIRE(count(measurement, defect) > 0);
    return *std::find_if(measurement.warnings.begin(), measurement.warnings.end(),
                         [&](const auto& w) { return w.code == defect; });
}

/// A rig without mechanics: 1 m/s^2 at a drive of 1, one fine channel.
RigParams electrical()
{
    return {.body = std::nullopt, .range = 2.0, .noiseDensity = 1e-7, .bits = 0, .axes = 1};
}
} // namespace

TEST_CASE("A wristband's response is recovered from three tilted axes, noise, 12 bits and 50 ppm", "[linearize]")
{
    for (const std::uint64_t seed : {1u, 2u, 3u})
    {
        CAPTURE(seed);
        RigParams rig;
        rig.seed = seed;
        const auto result = measured(sweepOf(20.0), rig);
        CHECK(largestError(result.response(), rig) < 0.15);
        REQUIRE(result.driftPpm.has_value());
        CHECK(*result.driftPpm == Approx(50.0).margin(0.1));
        CHECK(result.latency == Approx(rig.latency).margin(1.5e-4)); // the device's own delay is in it
        CHECK(count(result, MeasurementDefect::clockDrift) == 1);
        for (const auto defect :
             {MeasurementDefect::clipping, MeasurementDefect::droppedFrames, MeasurementDefect::silentChannel,
              MeasurementDefect::noiseChannel, MeasurementDefect::loopback})
            CHECK(count(result, defect) == 0);
    }
}

TEST_CASE("Clock drift and latency are found to fractions of a frame", "[linearize]")
{
    for (const double ppm : {-300.0, -50.0, 0.0, 3.0, 50.0, 1000.0})
    {
        CAPTURE(ppm);
        RigParams rig = electrical();
        rig.driftPpm = ppm;
        rig.latency = 0.0345678;
        const auto result = measured(sweepOf(5.0), rig);
        CHECK(result.driftPpm.value() == Approx(ppm).margin(0.05));
        CHECK(result.latency == Approx(rig.latency * (1.0 + ppm * 1e-6)).margin(1e-7)); // of the recorder's seconds
        CHECK(count(result, MeasurementDefect::clockDrift) == (std::abs(ppm) > 20.0 ? 1 : 0));
        for (std::size_t i = 0; i < result.response().size(); ++i)
            if (result.response().frequency[i] >= 20.0 && result.response().frequency[i] <= 1300.0)
                REQUIRE(std::abs(result.response().level[i]) < 0.01);
    }
}

TEST_CASE("Harmonic distortion of a known curve is recovered order by order", "[linearize]")
{
    RigParams rig = electrical();
    // sin^2 = (1 - cos 2x) / 2, sin^3 = (3 sin x - sin 3x) / 4, sin^4 = (3 - 4 cos 2x + cos 4x) / 8,
    // sin^5 = (10 sin x - 5 sin 3x + sin 5x) / 16
    rig.polynomial = {0.0, 1.0, 0.03, 0.05, 0.02, 0.04};
    rig.noiseDensity = 1e-8;
    for (const double level : {-6.0, 0.0})
    {
        CAPTURE(level);
        const double a = std::pow(10.0, level / 20.0);
        const double fundamental = a + 0.75 * 0.05 * std::pow(a, 3) + 10.0 / 16.0 * 0.04 * std::pow(a, 5);
        const double expected[] = {0.5 * 0.03 * a * a + 0.5 * 0.02 * std::pow(a, 4),
                                   0.25 * 0.05 * std::pow(a, 3) + 5.0 / 16.0 * 0.04 * std::pow(a, 5),
                                   0.02 * std::pow(a, 4) / 8.0, 0.04 * std::pow(a, 5) / 16.0};
        const auto result = measured(sweepOf(10.0, level), rig);
        REQUIRE(result.levels[0].harmonics.size() == 4);
        double sum = 0.0;
        for (int order = 2; order <= 5; ++order)
        {
            CAPTURE(order);
            const auto& harmonic = result.levels[0].harmonics[static_cast<std::size_t>(order - 2)];
            REQUIRE(harmonic.order == order);
            const double wanted = 20.0 * std::log10(expected[order - 2] / fundamental);
            sum += std::pow(expected[order - 2] / fundamental, 2);
            CHECK(harmonic.response.frequency.back() > 1400.0);
            double largest = 0.0;
            for (std::size_t i = 0; i < harmonic.response.size(); ++i)
                if (harmonic.response.frequency[i] > 15.0 && harmonic.response.frequency[i] < 1200.0)
                    largest = std::max(largest, std::abs(harmonic.response.level[i] - wanted));
            CHECK(largest < 0.5);
        }
        for (std::size_t i = 0; i < result.response().size(); ++i)
            if (result.response().frequency[i] > 20.0 && result.response().frequency[i] < 1200.0)
                REQUIRE(result.levels[0].distortion[i] == Approx(100.0 * std::sqrt(sum)).epsilon(0.06));
        CHECK(result.response().level[100] == Approx(20.0 * std::log10(fundamental / a)).margin(0.02));
    }
}

TEST_CASE("Frames that got lost are named with the time and their number", "[linearize]")
{
    for (const std::size_t lost : {16u, 64u, 512u})
    {
        CAPTURE(lost);
        RigParams rig;
        auto recording = recordOnRig(makeSweepSignal(sweepOf(20.0)).value(), rig);
        drop(recording, 48000 * 12, lost);
        const auto result = analyseSweeps(recording, rig.sampleRate, sweepOf(20.0), calibratedFor(rig)).value();
        REQUIRE(count(result, MeasurementDefect::droppedFrames) == 1);
        const auto& found = warning(result, MeasurementDefect::droppedFrames);
        CHECK(std::stod(found.where) == Approx(12.0).margin(0.15));
        CHECK(std::stod(found.message) == Approx(static_cast<double>(lost)).margin(0.5));
        CHECK(found.message.find("missing") != std::string::npos);
        CHECK(result.driftPpm.value() == Approx(50.0).margin(0.5));
        CHECK(result.latency == Approx(rig.latency).margin(1.5e-4));
        CHECK(largestError(result.response(), rig) < 1.0);
    }
}

TEST_CASE("A recording that clips at the sensor's own limit is named with its channel and time", "[linearize]")
{
    RigParams rig = electrical();
    const auto sweep = sweepOf(5.0);
    auto recording = recordOnRig(makeSweepSignal(sweep).value(), rig);
    CHECK(count(analyseSweeps(recording, 48000.0, sweep, calibratedFor(rig)).value(), MeasurementDefect::clipping) ==
          0);
    for (float& v : recording[0]) // peaks of 0.126
        v = std::clamp(v, -0.12f, 0.2f);
    const auto result = analyseSweeps(recording, 48000.0, sweep, calibratedFor(rig)).value();
    REQUIRE(count(result, MeasurementDefect::clipping) == 1);
    CHECK(warning(result, MeasurementDefect::clipping).where == "channels[0]");
}

TEST_CASE("A channel that is silent, noise or the drive itself is named", "[linearize]")
{
    RigParams rig;
    rig.axes = 1;
    const auto sweep = sweepOf(5.0);
    const auto signal = makeSweepSignal(sweep).value();
    auto recording = recordOnRig(signal, rig);
    recording.resize(2);
    const auto analysed = [&](std::vector<float> second)
    {
        recording[1] = std::move(second);
        return analyseSweeps(recording, 48000.0, sweep, calibratedFor(rig)).value();
    };
    const std::size_t frames = recording[0].size();
    const auto silent = analysed(std::vector<float>(frames, 0.25f));
    CHECK(warning(silent, MeasurementDefect::silentChannel).where == "channels[1]");
    CHECK(count(silent, MeasurementDefect::noiseChannel) == 0);

    std::vector<float> noise(frames);
    Random random(5);
    for (float& v : noise)
        v = static_cast<float>(random.uniform(-0.05, 0.05));
    const auto noisy = analysed(noise);
    CHECK(count(noisy, MeasurementDefect::noiseChannel) == 1);
    CHECK(warning(noisy, MeasurementDefect::noiseChannel).where == "channels[1]");

    std::vector<float> drive(frames, 0.0f);
    for (std::size_t n = 0; n < signal.size() && n + 592 < frames; ++n)
        drive[n + 592] = signal[n] * 0.5f;
    const auto looped = analysed(drive);
    CHECK(count(looped, MeasurementDefect::loopback) == 1);
    CHECK(warning(looped, MeasurementDefect::loopback).where == "channels[1]");
}

TEST_CASE("A weak measurement says below which frequency noise takes over", "[linearize]")
{
    RigParams rig;
    const auto result = measured(sweepOf(5.0, -30.0), rig);
    const auto& low = warning(result, MeasurementDefect::lowSnr);
    REQUIRE(low.where.substr(0, 6) == "below ");
    const double limit = std::stod(low.where.substr(6));
    CHECK(limit > 11.0);
    CHECK(limit < 60.0);
    for (std::size_t i = 0; i < result.response().size(); ++i)
        if (result.response().frequency[i] < limit * 0.99)
            CHECK(result.levels[0].snr.level[i] < 10.0);
}

TEST_CASE("Recordings that cannot be analysed are refused with a place and a reason", "[linearize]")
{
    RigParams rig = electrical();
    const auto sweep = sweepOf(2.0);
    const auto good = recordOnRig(makeSweepSignal(sweep).value(), rig);
    const auto failure = [&](const std::vector<std::vector<float>>& recording, double rate = 48000.0)
    {
        const auto result = analyseSweeps(recording, rate, sweep, calibratedFor(rig));
        REQUIRE_FALSE(result.ok());
        return result.error();
    };
    REQUIRE(analyseSweeps(good, 48000.0, sweep, calibratedFor(rig)).ok());

    CHECK(failure({}).where == "channels");
    CHECK(failure({good[0], good[0], good[0], good[0]}).where == "channels");
    CHECK(failure({{}}).where == "channels[0]");
    auto shorter = good[0];
    shorter.pop_back();
    CHECK(failure({good[0], shorter}).where == "channels[1]");
    CHECK(failure({good[0], shorter}).code == ErrorCode::truncated);
    auto broken = good[0];
    broken[777] = std::numeric_limits<float>::quiet_NaN();
    CHECK(failure({good[0], broken}).where == "channels[1][777]");
    CHECK(failure({good[0], broken}).code == ErrorCode::notFinite);
    broken[777] = std::numeric_limits<float>::infinity();
    CHECK(failure({broken}).where == "channels[0][777]");

    CHECK(failure({std::vector<float>(100, 0.1f)}).code == ErrorCode::truncated);
    CHECK(failure({std::vector<float>(good[0].size(), 0.0f)}).where == "channels");
    std::vector<float> noise(good[0].size());
    Random random(9);
    for (float& v : noise)
        v = static_cast<float>(random.uniform(-0.5, 0.5));
    CHECK(failure({noise}).where == "channels");
    CHECK(failure({noise}).code == ErrorCode::invalidData);

    const auto half = static_cast<std::ptrdiff_t>(48000 * 3.0); // the sweep lasts from 2.5 to 4.5 s
    CHECK(failure({std::vector<float>(good[0].begin(), good[0].begin() + half)}).where == "sweeps[0]");
    CHECK(failure({std::vector<float>(good[0].begin(), good[0].begin() + half)}).code == ErrorCode::truncated);
    CHECK(failure({std::vector<float>(good[0].begin() + half, good[0].end())}).where == "sweeps[0]");

    SweepParams often = sweep;
    often.repeats = 6;
    const auto once = recordOnRig(makeSweepSignal(sweep).value(), rig);
    const auto cut = analyseSweeps(once, 48000.0, often, calibratedFor(rig));
    CHECK(cut.error().where == "channels");
    CHECK(cut.error().code == ErrorCode::truncated);

    const auto wrongRate = failure(good, 44100.0);
    CHECK(wrongRate.where == "sampleRate");
    CHECK(wrongRate.message.find("48000") != std::string::npos);
    CHECK(failure(good, 44100.5).where == "sampleRate");
    CHECK(failure(good, 2000.0).where == "sampleRate");

    rig.driftPpm = 2500.0;
    const auto apart = failure(recordOnRig(makeSweepSignal(sweep).value(), rig));
    CHECK(apart.where == "clock");
    CHECK(apart.message.find("2500 ppm") != std::string::npos);

    MeasurementParams two = calibratedFor(rig);
    two.fullScale = {1.0, 2.0};
    CHECK(analyseSweeps(good, 48000.0, sweep, two).error().where == "measurement.fullScale");
    SweepParams wrong = sweep;
    wrong.levels = {3.0};
    CHECK(analyseSweeps(good, 48000.0, wrong, calibratedFor(rig)).error().where == "sweep.levels[0]");
}

TEST_CASE("Several repeats give less noise, several levels the drive of a distortion", "[linearize]")
{
    RigParams rig = electrical();
    rig.polynomial = {0.0, 1.0, 0.0, 0.2};
    rig.noiseDensity = 1e-5;
    SweepParams sweep = sweepOf(2.0);
    sweep.levels = {-30.0, -20.0, -10.0, 0.0};
    sweep.repeats = 4;
    const auto four = measured(sweep, rig);
    REQUIRE(four.levels.size() == 4);
    CHECK(four.main == 3);
    CHECK(four.driftPpm.value() == Approx(50.0).margin(0.2));
    sweep.repeats = 1;
    const auto one = measured(sweep, rig);
    CHECK(one.levels[0].noise.level[120] - four.levels[0].noise.level[120] == Approx(6.0).margin(1.5));

    // Third harmonic 0.05 a^2 over 1 + 0.15 a^2 is 1 % at a = 0.454.
    const double a = std::sqrt(0.01 / (0.05 - 0.0015));
    const auto drive = driveAtDistortion(four, 1.0, 50.0, 500.0);
    REQUIRE(drive.has_value());
    CHECK(*drive == Approx(20.0 * std::log10(a)).margin(0.5));
    // The weakest step is all noise.
    auto noisy = four;
    noisy.levels.front().distortion.assign(noisy.levels.front().distortion.size(), 40.0);
    CHECK(driveAtDistortion(noisy, 1.0, 50.0, 500.0).value() == drive.value());
    CHECK_FALSE(driveAtDistortion(four, 50.0, 50.0, 500.0).has_value());
    CHECK(driveAtDistortion(four, 0.0, 50.0, 500.0).value() == -30.0);
}

TEST_CASE("A single sweep without markers is analysed, with the drift unknown", "[linearize]")
{
    RigParams rig;
    auto sweep = sweepOf(20.0);
    sweep.markerDuration = 0.0;
    const auto result = measured(sweep, rig);
    CHECK_FALSE(result.driftPpm.has_value());
    CHECK(largestError(result.response(), rig) < 0.2);
    sweep.duration = 5.0;
    sweep.repeats = 2;
    CHECK(measured(sweep, rig).driftPpm.value() == Approx(50.0).margin(1.0));
}

TEST_CASE("A recording at another rate than the playback gives the same response", "[linearize]")
{
    RigParams rig = electrical();
    const auto sweep = sweepOf(2.0);
    auto played = sweep;
    played.sampleRate = 96000.0;
    rig.sampleRate = 96000.0;
    const auto recording = recordOnRig(makeSweepSignal(played).value(), rig);
    const auto result = analyseSweeps(recording, 96000.0, sweep, calibratedFor(rig)).value();
    for (std::size_t i = 0; i < result.response().size(); ++i)
        if (result.response().frequency[i] > 20.0 && result.response().frequency[i] < 1300.0)
            REQUIRE(std::abs(result.response().level[i]) < 0.02);
}

TEST_CASE("A recording may begin before or after the playback", "[linearize]")
{
    RigParams rig;
    const auto sweep = sweepOf(5.0);
    for (const double latency : {-0.8, 7.25})
    {
        rig.latency = latency;
        const auto result = measured(sweep, rig);
        CHECK(result.latency == Approx(latency).margin(6e-4));
        CHECK(largestError(result.response(), rig) < 0.3);
    }
}

TEST_CASE("Times of playback and recording are converted there and back, lost frames included", "[linearize]")
{
    SweepTiming timing;
    timing.start = 0.7;
    timing.drift = 1e-3;
    CHECK(timing.arrival(0.0) == 0.7);
    CHECK(timing.arrival(100.0) == Approx(100.8));
    timing.steps = {{10.0, -0.02}, {50.0, 0.5}};
    CHECK(timing.arrival(9.0) == Approx(9.709));
    CHECK(timing.arrival(10.0) == Approx(10.69));
    CHECK(timing.arrival(100.0) == Approx(101.28));
    for (const double played : {0.0, 9.9, 10.1, 49.9, 50.0, 77.0})
        CHECK(timing.playTime(timing.arrival(played)) == Approx(played));
}
