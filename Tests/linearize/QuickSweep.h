#pragma once

// Sweeps and rigs that are quick to simulate: at 4 kHz, without body and rounding.

#include <pacini/linearize/SimulatedRig.h>
#include <pacini/linearize/Sweep.h>

#include <utility>
#include <vector>

namespace pacini::test
{

/// From 20 to 1200 Hz.
inline SweepParams quickSweep(double duration, double pause, std::vector<double> levels)
{
    SweepParams params;
    params.sampleRate = 4000.0;
    params.lowFrequency = 20.0;
    params.highFrequency = 1200.0;
    params.duration = duration;
    params.fadeIn = 0.05;
    params.pause = pause;
    params.levels = std::move(levels);
    return params;
}

/// Full scale at `range` m/s2.
inline RigParams quickRig(double range, double noiseDensity)
{
    RigParams rig;
    rig.sampleRate = 4000.0;
    rig.axes = 1;
    rig.bits = 0;
    rig.body.reset();
    rig.range = range;
    rig.noiseDensity = noiseDensity;
    return rig;
}

} // namespace pacini::test
