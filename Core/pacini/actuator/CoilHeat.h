#pragma once

// Thermal limiter: keeps the temperature of an actuator's coil below its limit.

#include <pacini/actuator/FrameGroup.h>
#include <pacini/actuator/HeldStep.h>
#include <pacini/actuator/MovingMass.h>
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

/// Thermal limiter. The coil is one thermal mass. Its temperature, given as the constant power that would hold it,
/// follows the power as a one-pole filter, starts cold, and never exceeds maxPower.
///
/// It has two stages. The first averages the wanted power over about 0.1 s, so that the gain does not follow the
/// waveform, and compares it with an allowance. The allowance falls with the temperature, from five times the target
/// power when cold (bursts pass) to the target power when warm: the temperature approaches the target from below and
/// never passes it. The second stage bounds every single sample, for fast coils and sudden peaks on a warm coil. The
/// target lies 5 % below the limit, so the second stage rarely acts.
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
        // As a held step: the displacement is the second average, the velocity the first.
        step = {-averaging, averaging * (1.0 - averaging), 0.0, -averaging, averaging * averaging, averaging};
        group = designGroupStep(step);
        averages.beginGroup();
    }
    void reset() noexcept
    {
        temperature.reset();
        averages = {};
    }

    /// Follows the wanted power. Returns its ratio to the allowed power, which the square of a gain must undo.
    double measure(double wanted) noexcept
    {
        averages.follow(full * wanted * wanted, step, group);
        return averages.state().displacement / allowed(temperature.value());
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

    /// Lets the coil cool for so many frames without drive.
    void cool(double frames) noexcept { temperature.decay(frames); }

    /// Whether it is certain that the next `frames` drives, a multiple of a group from the start of one on, are
    /// admitted whatever they are within +-1, and that advanceFreely() takes them.
    [[nodiscard]] bool bears(std::size_t frames) const noexcept
    {
        const double hottest = hottestAfter(frames, 1.0);
        return hottest <= safely * limit && full <= safely * ((limit - hottest) / heating + hottest);
    }

    /// Does measure() and advance() for whole groups of frames, from the start of a group, if it is certain that no
    /// measure exceeds `maxMeasure` and that all of `played` would be admitted. Otherwise nothing changes and it
    /// returns false. The peak is that of `played`.
    bool advanceFreely(std::span<const double> wanted, std::span<const double> played, double playedPeak,
                       double maxMeasure) noexcept
    {
        const double hottest = hottestAfter(played.size(), playedPeak);
        return hottest <= safely * limit && followFreely(wanted, maxMeasure, hottest) &&
               advanceFreely(played, playedPeak);
    }

    /// Does measure() for whole groups of frames, from the start of a group, if it is certain that none exceeds
    /// `maxMeasure`, whatever drive within +-1 is played. Otherwise nothing changes and it returns false.
    bool measureFreely(std::span<const double> wanted, double maxMeasure) noexcept
    {
        return followFreely(wanted, maxMeasure, hottestAfter(wanted.size(), 1.0));
    }

    /// Does advance() for whole groups of frames, from the start of a group, if it is certain that all of `played`
    /// would be admitted. Otherwise nothing changes and it returns false. `peak` is that of `played`.
    bool advanceFreely(std::span<const double> played, double peak) noexcept
    {
        if (!(hottestAfter(played.size(), peak) <= safely * limit))
            return false;
        for (std::size_t i = 0; i < played.size(); i += groupFrames)
            temperature.followGroup(powers(played, i));
        return true;
    }

    void flush() noexcept
    {
        temperature.flush();
        averages.flush();
    }

private:
    static constexpr double safely = 1.0 - 1e-6; // far more than rounding

    [[nodiscard]] double allowed(double at) const noexcept
    {
        const double aim = 0.95 * limit;
        return aim + 4.0 * std::max(0.0, aim - at);
    }

    /// A bound on the temperature within the next `frames` under drives up to `peak`.
    [[nodiscard]] double hottestAfter(std::size_t frames, double peak) const noexcept
    {
        const double power = full * peak * peak;
        const double warmed = temperature.value() + static_cast<double>(frames) * heating * power;
        return std::min(warmed, std::max(temperature.value(), power));
    }

    /// Updates the averages for whole groups if they are certain to stay within the allowance at `hottest`.
    bool followFreely(std::span<const double> wanted, double maxMeasure, double hottest) noexcept
    {
        MovingMass after = averages;
        double highest = 0.0;
        for (std::size_t i = 0; i < wanted.size(); i += groupFrames)
        {
            after.followGroup(powers(wanted, i), group);
            highest = std::max(highest, after.state().displacement);
        }
        // Powers are not negative: within a group an average was at most so much higher than at its end.
        const double fall = 1.0 - static_cast<double>(groupFrames) * averaging;
        if (!(highest <= safely * fall * maxMeasure * allowed(hottest)))
            return false;
        averages = after;
        return true;
    }

    [[nodiscard]] FrameGroup powers(std::span<const double> drive, std::size_t begin) const noexcept
    {
        FrameGroup squares = groupAt(drive, begin);
        for (double& x : squares)
            x = full * x * x;
        return squares;
    }

    double full = 1.0;
    double limit = 1.0;
    double heating = 1.0;
    double averaging = 0.0;
    RunningMean temperature;
    HeldStep step;
    GroupStep group;
    MovingMass averages; ///< of the wanted power
};

} // namespace pacini
