#pragma once

// Curve of a motor: the level that is felt -> the number that it is sent.

#include <cmath>

namespace pacini::devices
{

/// The felt level of a motor that is sent `command` (0..1) is ((command - start) / (full - start))^exponent from
/// `start` on, and 0 below it.
///
/// No maker publishes such a curve, nor was a measurement of a controller found: all numbers in motorCurves() are
/// assumed, each for the reason that stands there. The force of an eccentric mass grows with the square of its speed,
/// and its speed about with the voltage (Precision Microdrives, AB-004, AB-029); weighted for the hand as ISO 5349-1
/// does, which halves with each octave that the speed rises, it grows as the speed. An exponent of 1.5, in the middle,
/// is off by no more than a third of the level in dB whichever of the two is felt.
struct MotorCurve
{
    /// A weaker level is silence (-48 dB), which no export tells from none either.
    static constexpr double least = 1.0 / 255.0;

    double start = 0.0; ///< the least number that moves it, 0 to below `full`
    double full = 1.0;  ///< the number of the level 1
    double exponent = 1.0;
    bool operator==(const MotorCurve&) const = default;

    /// Of a level, which is brought into 0..1; NaN and what is not above `least` become 0. [any]
    [[nodiscard]] double command(double level) const noexcept
    {
        if (!(level > least))
            return 0.0;
        return start + (full - start) * std::pow(std::fmin(level, 1.0), 1.0 / exponent);
    }

    /// The inverse. [any]
    [[nodiscard]] double level(double command) const noexcept
    {
        return command > start ? std::pow(std::fmin((command - start) / (full - start), 1.0), exponent) : 0.0;
    }
};

/// The curves of two motors.
struct MotorCurves
{
    MotorCurve strong;
    MotorCurve weak;
    bool operator==(const MotorCurves&) const = default;
};

} // namespace pacini::devices
