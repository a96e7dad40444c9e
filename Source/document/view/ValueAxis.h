#pragma once

// Value axis of a lane: values <-> y, linear, logarithmic or in decibels.

#include <pacini/clip/edits/Lane.h>

#include <algorithm>
#include <cmath>

namespace pacini
{

enum class ValueScale
{
    linear,
    decibels,   ///< amplitudes; the lowest value is shown for everything below it, 0 too
    logarithmic ///< frequencies
};

/// The values that a lane shows: `high` at y = 0, `low` at y = height. For decibels and logarithmic scales both are
/// above 0. Values beyond lie beyond the edges on the linear scale and at them on the others' lower end.
struct ValueAxis
{
    ValueScale scale = ValueScale::linear;
    double low = 0.0;
    double high = 1.0;
    double height = 100.0; ///< pixels, above 0
    bool operator==(const ValueAxis&) const = default;

    [[nodiscard]] double yOf(double value) const noexcept { return height * (1.0 - place(value)); }

    /// The value at y; on a decibel scale the lowest place is silence: 0.
    [[nodiscard]] double valueAtY(double y) const noexcept
    {
        const double x = 1.0 - y / height;
        if (scale == ValueScale::linear)
            return low + x * (high - low);
        if (scale == ValueScale::decibels && x <= 0.0)
            return 0.0;
        return low * std::pow(high / low, x);
    }

    /// Zooms by `factor` (above 1: closer) so that the value at `y` stays there.
    [[nodiscard]] ValueAxis zoomed(double factor, double y) const noexcept
    {
        if (!(factor > 0.0) || !std::isfinite(factor))
            return *this;
        ValueAxis axis = *this;
        const double x = 1.0 - y / height;
        const double below = x / factor;
        const double above = (1.0 - x) / factor;
        if (scale == ValueScale::linear)
        {
            const double centre = low + x * (high - low);
            axis.low = centre - below * (high - low);
            axis.high = centre + above * (high - low);
            return axis;
        }
        const double centre = low * std::pow(high / low, x);
        axis.low = centre * std::pow(high / low, -below);
        axis.high = centre * std::pow(high / low, above);
        return axis;
    }

private:
    [[nodiscard]] double place(double value) const noexcept
    {
        if (scale == ValueScale::linear)
            return (value - low) / (high - low);
        return std::log(std::max(value, low) / low) / std::log(high / low);
    }
};

} // namespace pacini
