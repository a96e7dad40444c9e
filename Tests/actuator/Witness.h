#pragma once

// What a drive signal does to an actuator, by an integration of its own.

#include "actuator/SimulatedActuator.h"

#include <pacini/actuator/Profile.h>
#include <pacini/actuator/ProtectionParams.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace pacini::test
{

/// The mass of SimulatedResonator by the textbook solution of the damped oscillation between the frames (sine and
/// cosine, or two decays), in long double: some ten times as fast. It looks at points 0.05 rad apart, between which a
/// swing passes them by 0.03 %.
class SwingingMass
{
public:
    SwingingMass(double frequency, double q, double staticExcursion, double fs)
        : w0(2.0L * std::numbers::pi_v<long double> * frequency), excursion(staticExcursion)
    {
        const long double step = w0 / fs;
        points = std::max(1, static_cast<int>(std::ceil(step / 0.05L)));
        const long double angle = step / points;
        const long double zeta = 0.5L / q;
        const long double root = std::sqrt(std::abs(1.0L - zeta * zeta));
        const long double decay = std::exp(-zeta * angle);
        // Critical damping itself is met by none of the random actuators.
        const bool swings = zeta < 1.0L;
        const long double c = decay * (swings ? std::cos(root * angle) : std::cosh(root * angle));
        const long double s = decay * (swings ? std::sin(root * angle) : std::sinh(root * angle)) / root;
        xx = c + zeta * s;
        xv = s;
        vx = -s;
        vv = c - zeta * s;
    }

    void hold(double drive)
    {
        const long double rest = excursion * drive;
        for (int i = 0; i < points; ++i)
        {
            const long double away = x - rest;
            x = rest + xx * away + xv * v;
            v = vx * away + vv * v;
            largest = std::max(largest, std::abs(x));
        }
    }

    [[nodiscard]] double displacement() const { return static_cast<double>(x); }
    [[nodiscard]] double velocity() const { return static_cast<double>(w0 * v); }
    [[nodiscard]] double peak() const { return static_cast<double>(largest); }

private:
    long double w0;
    long double excursion;
    int points = 1;
    long double xx = 1, xv = 0, vx = 0, vv = 1;
    long double x = 0;
    long double v = 0; // over w0
    long double largest = 0;
};

/// What a drive did to an actuator, over its limits; 0 where it has none.
struct Strain
{
    double travel = 0.0;
    double heat = 0.0;
    double level = 0.0; ///< the largest sample

    void add(const Strain& other)
    {
        travel = std::max(travel, other.travel);
        heat = std::max(heat, other.heat);
        level = std::max(level, other.level);
    }
};

/// The physics of a profile under the samples of its drive signal, of which 1 is `overdrive` times the rated drive.
/// What the guard keeps holds for the drive as it is rounded to float; 0.1 % covers the rounding of either side.
template <typename Mass>
class Witness
{
public:
    static constexpr double tolerance = 1.001;

    Witness(const Profile& profile, double fs)
        : limits(profile.drive),
          mass(profile.resonance.frequency, profile.resonance.q, limits.overdrive * limits.excursion.value_or(0.0), fs),
          // A motor has a direct voltage, all others the peaks of a sinusoid.
          fullPower(limits.overdrive * limits.overdrive * (profile.technology == Technology::erm ? 1.0 : 2.0) *
                    limits.maxVoltageRms.value_or(0.0) * limits.maxVoltageRms.value_or(0.0) /
                    limits.impedance.value_or(1.0)),
          cooling(std::exp(-1.0 / (limits.thermalTime.value_or(defaultThermalTime) * fs)))
    {
    }

    void hold(float sample)
    {
        const auto drive = static_cast<double>(sample);
        level = std::max(level, std::abs(drive));
        mass.hold(drive);
        const double power = fullPower * drive * drive;
        temperature = power + (temperature - power) * cooling;
        hottest = std::max(hottest, temperature);
    }
    void hold(std::span<const float> drive)
    {
        for (const float sample : drive)
            hold(sample);
    }

    [[nodiscard]] const Mass& moving() const { return mass; }
    [[nodiscard]] Strain strain() const
    {
        return {limits.maxExcursion ? mass.peak() / *limits.maxExcursion : 0.0,
                limits.maxPower ? hottest / *limits.maxPower : 0.0, level};
    }

private:
    ActuatorDrive limits;
    Mass mass;
    double fullPower, cooling;
    double temperature = 0.0, hottest = 0.0, level = 0.0;
};

} // namespace pacini::test
