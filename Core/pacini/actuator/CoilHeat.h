#pragma once

// Thermal limiter: keeps the heat in an actuator's coil below what it bears.

#include <pacini/actuator/FrameGroup.h>
#include <pacini/actuator/RunningMean.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace pacini
{

/// Thermal parameters of a coil. Powers in W, clamped to 1e-12 to 1e12.
struct CoilHeatParams
{
    double fullDrivePower = 1.0; ///< W while the drive stands at 1
    double maxPower = 1.0;       ///< W that the coil bears for ever
    Seconds thermalTime{1.0};    ///< time constant of its heating, 0.01 to 10000 s
    bool operator==(const CoilHeatParams&) const = default;
};

/// Thermal limiter. The coil as one thermal mass: its temperature, given as the constant power that would hold it
/// there, follows the power as a one-pole filter and starts cold. It may never exceed maxPower.
///
/// Two parts act. The wanted power, averaged over about 0.1 s so that a gain does not follow the waveform, is compared
/// with an allowance that falls with the temperature, from five times the aimed-at power when cold (bursts pass) to
/// once when warm: the temperature then approaches the aim from below and never passes it. What averaging leaves (fast
/// coils, sudden peaks on a warm coil) a bound on the single sample takes away; the aim lies 5 % below the limit, so
/// that it hardly ever has to.
class CoilHeat
{
public:
    void design(const CoilHeatParams& params, double fs) noexcept
    {
        constexpr double averagingTime = 0.05; // s, twice one after the other
        full = clampTo(params.fullDrivePower, 1e-12, 1e12);
        limit = clampTo(params.maxPower, 1e-12, 1e12) * (1.0 - 1e-9); // and rounding
        heating = -std::expm1(-1.0 / (clampTo(params.thermalTime.value, 0.01, 1e4) * fs));
        temperature.design(heating);
        averaging = -std::expm1(-1.0 / (averagingTime * fs));
        average1.design(averaging);
        average2.design(averaging);
    }
    void reset() noexcept
    {
        temperature.reset();
        average1.reset();
        average2.reset();
    }

    /// Follows the power as it is wanted and returns it over what is allowed now: what the square of a gain must undo.
    double measure(double wanted) noexcept
    {
        average1.follow(full * wanted * wanted);
        average2.follow(average1.value());
        return average2.value() / allowed(temperature.value());
    }

    /// The drive nearest to `wanted` that keeps the temperature within the limit: a drive of sqrt(maxPower /
    /// fullDrivePower) always does.
    [[nodiscard]] double admit(double wanted) const noexcept
    {
        const double power = (limit - temperature.value()) / heating + temperature.value();
        if (full * wanted * wanted <= power)
            return wanted;
        const double most = std::sqrt(std::max(power, 0.0) / full);
        return clampTo(wanted, -most, most);
    }

    void advance(double drive) noexcept { temperature.follow(full * drive * drive); }

    /// Does measure() and advance() for whole groups of frames, from the start of a group, if it is certain that no
    /// measure exceeds `maxMeasure` and that all of `played` would be admitted. Otherwise nothing changes and it
    /// returns false. The peak is that of `played`.
    bool advanceFreely(std::span<const double> wanted, std::span<const double> played, double playedPeak,
                       double maxMeasure) noexcept
    {
        const double peakPower = full * playedPeak * playedPeak;
        const double warmed = temperature.value() + static_cast<double>(played.size()) * heating * peakPower;
        const double hottest = std::min(warmed, std::max(temperature.value(), peakPower));
        if (!(hottest <= safely * limit))
            return false;
        RunningMean once = average1;
        RunningMean twice = average2;
        RunningMean heated = temperature;
        double highest = 0.0;
        for (std::size_t i = 0; i < wanted.size(); i += groupFrames)
        {
            const FrameGroup averages = twice.followGroup(once.followGroup(powers(wanted, i)));
            heated.followGroup(powers(played, i));
            highest = std::max(highest, averages.back());
        }
        // Powers are not negative: within a group an average was at most so much higher than at its end.
        const double fall = 1.0 - static_cast<double>(groupFrames) * averaging;
        if (!(highest <= safely * fall * maxMeasure * allowed(hottest)))
            return false;
        average1 = once;
        average2 = twice;
        temperature = heated;
        return true;
    }

    void flush() noexcept
    {
        temperature.flush();
        average1.flush();
        average2.flush();
    }

private:
    static constexpr double safely = 1.0 - 1e-6; // far more than rounding

    [[nodiscard]] double allowed(double at) const noexcept
    {
        const double aim = 0.95 * limit;
        return aim + 4.0 * std::max(0.0, aim - at);
    }

    [[nodiscard]] FrameGroup powers(std::span<const double> drive, std::size_t begin) const noexcept
    {
        FrameGroup group = groupAt(drive, begin);
        for (double& x : group)
            x = full * x * x;
        return group;
    }

    double full = 1.0;
    double limit = 1.0;
    double heating = 1.0;
    double averaging = 0.0;
    RunningMean temperature;
    RunningMean average1;
    RunningMean average2;
};

} // namespace pacini
