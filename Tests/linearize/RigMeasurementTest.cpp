#include "linearize/MeasuredOn.h"
#include "support/Catch.h"

#include <pacini/actuator/Wearer.h>
#include <pacini/linearize/ResponseFeatures.h>

#include <cmath>

using namespace pacini;
using test::measuredOn;

TEST_CASE("The average over fourteen measured wearers is right though two wear the band loosely", "[linearize]")
{
    SweepParams sweep;
    sweep.duration = 4.0;
    sweep.levels = {-12.0};
    std::vector<FrequencyResponse> measured;
    std::vector<RigParams> rigs;
    for (unsigned wearer = 1; wearer <= simulatedWearers; ++wearer)
    {
        RigParams rig;
        rig.body = bodyOn(wearer, *rig.body);
        rig.seed = wearer;
        rig.contact = wearer <= 2 ? -6.0 : 0.0;
        rigs.push_back(rig);
        measured.push_back(measuredOn(rig, sweep).response());
    }
    const auto average = averagePlacements(measured).value();
    REQUIRE(average.outliers.size() == 2);
    CHECK(average.outliers[0].index == 0);
    CHECK(average.outliers[1].index == 1);
    double largest = 0.0;
    for (std::size_t k = 0; k < average.response.size(); ++k)
    {
        const double f = average.response.frequency[k];
        if (f < 30.0 || f > 1000.0)
            continue;
        double expected = 0.0;
        for (std::size_t i = 2; i < rigs.size(); ++i)
            expected += rigLevel(rigs[i], f) / static_cast<double>(rigs.size() - 2);
        largest = std::max(largest, std::abs(average.response.level[k] - expected));
    }
    CHECK(largest < 0.35);
}

TEST_CASE("Resonance, Q and burst times of measured actuators are those of their equations of motion", "[linearize]")
{
    SweepParams sweep;
    sweep.duration = 8.0;
    Random random(3);
    for (int i = 0; i < 8; ++i)
    {
        RigParams rig;
        rig.seed = static_cast<std::uint64_t>(i + 1);
        rig.resonance = {50.0 * std::exp2(random.uniform(0.0, 2.0)), 1.0 * std::pow(35.0, random.uniform())};
        // Next to no skin: the mass hangs in a device that moves freely.
        rig.body = BodyParams{1.0, 0.012, 0.04, 1e9, 10.0, 1e-6, 0.0, 0.0};
        rig.range = 2.0 * standardGravity * std::max(1.0, rig.resonance.q);
        rig.noiseDensity = rig.range * 50e-6;
        CAPTURE(rig.resonance.frequency, rig.resonance.q);
        const double share = 0.012 / 0.040001;
        const double f0 = rig.resonance.frequency * std::sqrt(1.0 + share);
        const double q = rig.resonance.q / std::sqrt(1.0 + share);
        const auto result = measuredOn(rig, sweep);
        const auto features = responseFeatures(result.response()).value();
        CHECK(features.resonance.frequency == Approx(f0).epsilon(0.01));
        CHECK(features.resonance.q == Approx(q).epsilon(0.05));
        CHECK(features.resonance.slope == 2);
        CHECK(features.plateau == Approx(20.0 * std::log10(1.0 / 0.040001)).margin(1.0));
        if (q > 4.0) // below, the mass's own swing is no longer most of the movement
        {
            const auto times = burstTimes(result.impulseResponse, f0).value();
            const double expected = std::log(10.0) * q / (std::numbers::pi * f0);
            CHECK(times.riseTime == Approx(expected).epsilon(0.1));
            CHECK(times.fallTime == Approx(expected).epsilon(0.1));
        }
    }
}

TEST_CASE("The noise of a simulated rig is that of its density up to half of the sample rate", "[linearize]")
{
    RigParams rig = {.body = std::nullopt, .range = 20.0, .bits = 0, .axes = 1};
    for (const double sampleRate : {8000.0, 48000.0})
    {
        rig.sampleRate = sampleRate;
        const std::vector<float> silence(20000);
        const auto recorded = recordOnRig(silence, rig);
        REQUIRE(recorded.size() == 1);
        double power = 0.0;
        for (const float v : recorded[0])
            power += static_cast<double>(v) * static_cast<double>(v) / static_cast<double>(recorded[0].size());
        CHECK(std::sqrt(power) == Approx(rig.noiseDensity * std::sqrt(sampleRate / 2.0) / 20.0).epsilon(0.02));
    }
}

TEST_CASE("A simulated rig without a body is a delay by another clock, an amplifier and a converter", "[linearize]")
{
    RigParams rig;
    rig.body.reset();
    rig.contact = 6.0205999;
    rig.polynomial = {0.1, 1.0, 0.5};
    rig.range = 4.0;
    rig.noiseDensity = 0.0;
    rig.axes = 1;
    rig.latency = 0.01;
    rig.driftPpm = 0.0;
    rig.tail = 0.25;
    rig.sampleRate = 8000.0;
    std::vector<float> drive(800);
    for (std::size_t n = 0; n < drive.size(); ++n)
        drive[n] = static_cast<float>(0.5 * std::sin(0.05 * static_cast<double>(n)));
    for (const int bits : {0, 6})
    {
        rig.bits = bits;
        const auto recorded = recordOnRig(drive, rig);
        REQUIRE(recorded.size() == 1);
        REQUIRE(recorded[0].size() == 800 + 80 + 2000);
        for (std::size_t n = 0; n < drive.size(); ++n)
        {
            const auto x = static_cast<double>(drive[n]);
            const double sample = 2.0 * (0.1 + x + 0.5 * x * x) / 4.0;
            const double wanted = bits == 0 ? sample : std::round(sample * 32.0) / 32.0;
            REQUIRE(static_cast<double>(recorded[0][n + 80]) == Approx(wanted).margin(1e-6));
        }
        CHECK(recorded[0][79] == 0.0f);
        CHECK(recorded[0][880] == 0.0f);
    }
    // A recorder that is a thousandth quicker has as many more frames, and hears a lower tone.
    rig.bits = 0;
    rig.polynomial = {0.0, 1.0};
    rig.driftPpm = 1000.0;
    const auto recorded = recordOnRig(drive, rig)[0];
    CHECK(recorded.size() == 2882);
    for (std::size_t n = 200; n < 800; ++n)
    {
        const double played = static_cast<double>(n) / 1.001 - 80.0;
        REQUIRE(static_cast<double>(recorded[n]) == Approx(0.25 * std::sin(0.05 * played)).margin(1e-4));
    }
}
