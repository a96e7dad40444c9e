#include "support/Catch.h"

#include <pacini/actuator/Wearer.h>
#include <pacini/linearize/ResponseFeatures.h>
#include <pacini/linearize/SimulatedRig.h>
#include <pacini/linearize/SweepAnalysis.h>

#include <cmath>

using namespace pacini;

namespace
{
SweepMeasurement measuredOn(const RigParams& rig, const SweepParams& sweep)
{
    MeasurementParams measurement;
    measurement.fullScale = {rig.range};
    measurement.harmonics = 1;
    const auto recording = recordOnRig(makeSweepSignal(sweep).value(), rig);
    const auto result = analyseSweeps(recording, rig.sampleRate, sweep, measurement);
    REQUIRE(result.ok());
    return result.value();
}
} // namespace

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
