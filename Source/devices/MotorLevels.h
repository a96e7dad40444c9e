#pragma once

// Levels of the two motors of a classic game controller.

#include <cmath>
#include <cstddef>

namespace pacini::devices
{

/// Levels 0..1: of the drive in a RumbleState, of the numbers that are sent in a report (see MotorCurve). Values
/// outside are clamped, NaN becomes 0.
struct MotorLevels
{
    double strong = 0.0; ///< the heavy, slow motor, in the left grip
    double weak = 0.0;   ///< the light, fast motor, in the right grip
    bool operator==(const MotorLevels&) const = default;
};

/// A level as a number of 0..full, rounded; full <= 255.
[[nodiscard]] inline std::byte motorByte(double level, int full) noexcept
{
    const double within = level > 0.0 ? std::fmin(level, 1.0) : 0.0;
    return static_cast<std::byte>(std::lround(within * full));
}

} // namespace pacini::devices
