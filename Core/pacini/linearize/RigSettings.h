#pragma once

// Settings of the simulated measuring rig, in the units in which users give them.

#include <pacini/actuator/Profile.h>
#include <pacini/actuator/Wearer.h>
#include <pacini/linearize/SimulatedRig.h>

#include <cstddef>
#include <cstdint>

namespace pacini
{

/// A worn actuator and the accelerometer on it (an ADXL325 unless told otherwise).
struct RigSettings
{
    double mass = 0.0;       ///< g, attached to the device
    double contact = 0.0;    ///< dB, a loose or a tight fit
    double latency = 0.012;  ///< s, of player and recorder together
    double drift = 50.0;     ///< ppm by which the recorder's clock is faster
    double noise = 250.0;    ///< ug per root of Hz
    double distortion = 0.0; ///< factor of the cube of the drive
    double range = 5.0;      ///< g, at which the sensor clips
    int axes = 3;            ///< 1 or 3
    int bits = 12;
    std::uint64_t seed = 1;
};

/// The rig for `actuator`, which has a body, on wearer 0 to 14, whose noise is of a seed of its own.
[[nodiscard]] inline RigParams rigOn(unsigned wearer, const Profile& actuator, const RigSettings& settings,
                                     double sampleRate)
{
    RigParams rig;
    rig.body = bodyOn(wearer, *actuator.body);
    rig.body->deviceMass += 1e-3 * settings.mass;
    rig.resonance = actuator.resonance;
    rig.contact = settings.contact;
    rig.polynomial = {0.0, 1.0, 0.0, settings.distortion};
    rig.range = settings.range * standardGravity;
    rig.axes = static_cast<std::size_t>(settings.axes);
    rig.noiseDensity = settings.noise * 1e-6 * standardGravity;
    rig.bits = settings.bits;
    rig.latency = settings.latency;
    rig.driftPpm = settings.drift;
    rig.seed = settings.seed + wearer;
    rig.sampleRate = sampleRate;
    return rig;
}

} // namespace pacini
