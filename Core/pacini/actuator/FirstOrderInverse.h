#pragma once

// Inverse of a first-order lag: the drive that makes something slow follow a curve.

#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>

#include <cmath>

namespace pacini
{

/// Time constants in s; 0 follows at once.
struct FirstOrderTimes
{
    double rise = 0.0;
    double fall = 0.0;
    bool operator==(const FirstOrderTimes&) const = default;
};

/// Inverse of the first-order lag tau m' = u - m under limits, m the state that is to follow, in the drive's unit. The
/// drive is held from sample to sample, for which u = m + (wanted - m) / (1 - exp(-1 / (tau fs))) takes the state from
/// m to the wanted value at the next sample exactly; this is u = s + tau ds/dt without the derivative. When the limits
/// cut the drive the modelled state moves as far as it can and the rest is asked for again with the next sample, so
/// that nothing is lost and the state never passes the wanted value.
class FirstOrderInverse
{
public:
    void design(const FirstOrderTimes& times, double fs) noexcept
    {
        rise = follow(times.rise, fs);
        fall = follow(times.fall, fs);
    }
    void reset() noexcept { state = 0.0; }

    /// The drive for one sample, within [lowest, highest]; moves the modelled state on by one sample.
    double tick(double wanted, double lowest, double highest) noexcept
    {
        const double rate = wanted > state ? rise : fall;
        const double drive = clampTo(rate < 1.0 ? state + (wanted - state) / rate : wanted, lowest, highest);
        state += rate * (drive - state);
        return drive;
    }

    /// The modelled state, before the next sample.
    [[nodiscard]] double value() const noexcept { return state; }

    void flush() noexcept { flushTiny(state); }

private:
    /// The part of the way to a held drive that is covered in one sample.
    [[nodiscard]] static double follow(double time, double fs) noexcept
    {
        const double frames = clampTo(time, 0.0, 1e3) * fs;
        return frames > 0.0 ? -std::expm1(-1.0 / frames) : 1.0;
    }

    double rise = 1.0;
    double fall = 1.0;
    double state = 0.0;
};

} // namespace pacini
