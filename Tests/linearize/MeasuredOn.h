#pragma once

// Measurements on simulated rigs.

#include "support/Catch.h"

#include <pacini/linearize/SimulatedRig.h>
#include <pacini/linearize/SweepAnalysis.h>

namespace pacini::test
{

/// What the analysis finds in the recording of a sweep, without harmonics.
inline SweepMeasurement measuredOn(const RigParams& rig, const SweepParams& sweep)
{
    MeasurementParams measurement;
    measurement.fullScale = {rig.range};
    measurement.harmonics = 1;
    const auto recording = recordOnRig(makeSweepSignal(sweep).value(), rig);
    const auto result = analyseSweeps(recording, rig.sampleRate, sweep, measurement);
    REQUIRE(result.ok());
    return result.value();
}

} // namespace pacini::test
