#pragma once

// Fractional-octave smoothing.

#include <pacini/foundation/Result.h>
#include <pacini/linearize/FrequencyResponse.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// A power spectrum that can be averaged over any part of an octave. Power, since that is what adds up when a response
/// is noisy or varies from place to place; the mean is over log frequency, between points power is linear in it.
/// By a running integral each mean takes two look-ups whatever the width is.
class SmoothedPower
{
public:
    /// Two points or more; frequencies in Hz above 0, rising; as many powers.
    SmoothedPower(std::span<const double> frequency, std::span<const double> power)
        : octave(frequency.size()), value(power.begin(), power.end()), integral(frequency.size(), 0.0)
    {
        assert(frequency.size() >= 2 && power.size() == frequency.size());
        for (std::size_t i = 0; i < octave.size(); ++i)
            octave[i] = std::log2(frequency[i]);
        for (std::size_t i = 1; i < octave.size(); ++i)
            integral[i] = integral[i - 1] + 0.5 * (value[i] + value[i - 1]) * (octave[i] - octave[i - 1]);
    }

    /// The mean power over `octaves` around f Hz, over less where the points end; the power at f for 0 octaves. Outside
    /// of all points the value of the nearest one.
    [[nodiscard]] double at(double f, double octaves) const noexcept
    {
        const double centre = std::log2(f);
        const double low = std::clamp(centre - octaves / 2.0, octave.front(), octave.back());
        const double high = std::clamp(centre + octaves / 2.0, octave.front(), octave.back());
        // Below this width the difference of two integrals is rounding.
        if (high - low < 1e-9)
            return interpolated(std::clamp(centre, low, high)).power;
        return (interpolated(high).area - interpolated(low).area) / (high - low);
    }

private:
    struct Point
    {
        double power;
        double area;
    };

    [[nodiscard]] Point interpolated(double at) const noexcept
    {
        const auto above = std::upper_bound(octave.begin() + 1, octave.end() - 1, at);
        const auto i = static_cast<std::size_t>(above - octave.begin());
        const double step = at - octave[i - 1];
        const double power = value[i - 1] + (value[i] - value[i - 1]) * step / (octave[i] - octave[i - 1]);
        return {power, integral[i - 1] + 0.5 * (value[i - 1] + power) * step};
    }

    std::vector<double> octave;
    std::vector<double> value;
    std::vector<double> integral;
};

/// `points` frequencies evenly in octaves from `low` to `high` Hz, both ends included.
[[nodiscard]] inline std::vector<double> logSpaced(double low, double high, std::size_t points)
{
    assert(points >= 2);
    std::vector<double> f(points);
    for (std::size_t i = 0; i < points; ++i)
        f[i] = low * std::pow(high / low, static_cast<double>(i) / static_cast<double>(points - 1));
    f.back() = high;
    return f;
}

} // namespace pacini
