#pragma once

// Output stage of the translator: computes the drive of the actuator from the wanted vibration, at the inner rate.

#include <pacini/actuator/LimiterGain.h>
#include <pacini/actuator/MotorDrive.h>
#include <pacini/realtime/TranslatorDesign.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace pacini
{

/// Output stage: levels pressed into the actuator's range, intensity, equaliser and flattening, limiter; or, for a
/// motor, its strength and the voltage that reaches it. Where the actuator has limits the protection behind replaces
/// the limiter.
class DriveStage
{
public:
    DriveStage() { limiter.prepare(0, static_cast<std::size_t>(limiterHoldSeconds * highestInnerRate)); }

    /// Takes a design, which must outlive this. Silence follows.
    void adopt(const TranslatorDesign& wanted) noexcept
    {
        design = &wanted;
        const double fs = wanted.innerRate;
        if (wanted.motor)
        {
            motor.prepare({fs, controlHop});
            motor.setParams(*wanted.motor);
        }
        limiter.design(0, static_cast<std::size_t>(limiterHoldSeconds * fs), fs);
        strengthShare = hopShare(0.010, fs); // a motor follows no faster
        burstHops = static_cast<std::size_t>(wanted.motorBurst * fs / static_cast<double>(controlHop)) + 1;
        reset();
    }

    void reset() noexcept
    {
        rest();
        motor.reset();
        limiter.reset();
        strength.jump(0.0);
        burstLeft = 0;
    }

    /// Clears states that have decayed.
    void rest() noexcept
    {
        states = {};
        firstStrength = secondStrength = 0.0;
    }

    /// All gains at once.
    void jump(double intensity) noexcept
    {
        drive.jump(intensity);
        levels.jump(1.0);
    }

    /// Starts a hop. `intensity` is linear, `share` the fraction of the distance by which gains move; `peak` and
    /// `energy` are those of the drive in the last hop.
    void aim(double intensity, double share, double peak, double energy) noexcept
    {
        drive.aim(intensity, share);
        if (design->motor)
            aimStrength(energy / static_cast<double>(controlHop));
        else if (!design->levels.isIdentity())
            levels.aim(peak > 1e-9 ? design->levels(peak) / peak : 1.0, share);
        for (StateVariableState& state : states)
            state.flush();
    }

    /// Starts a burst of a motor: the strength lasts for its spin-up time.
    void beginBurst(double level) noexcept
    {
        burst = level;
        burstLeft = burstHops;
    }
    [[nodiscard]] bool bursting() const noexcept { return burstLeft > 0; }

    /// Frames `at` and on of the hop, in place; `gates` are further gains. Returns the peak before the scale.
    double process(std::span<float> out, std::span<const double> gates, std::size_t at) noexcept
    {
        for (std::size_t i = 0; i < out.size(); ++i)
        {
            const double wanted = design->motor ? strength.at(at + i) : levels.at(at + i) * static_cast<double>(out[i]);
            out[i] = toSample(drive.at(at + i) * gates[i] * wanted);
        }
        if (design->motor)
            motor.process(out, out);
        const bool limited = !design->protection && !design->motor;
        const std::size_t sections = design->filter.sections.size();
        double peak = 0.0;
        for (std::size_t i = 0; i < out.size(); ++i)
        {
            auto y = static_cast<double>(out[i]);
            for (std::size_t s = 0; s < sections; ++s)
                y = states[s].tick(design->filter.sections[s], y);
            peak = std::max(peak, std::abs(y));
            y *= design->scale;
            if (limited)
            {
                const double g = limiter.tick(y * y);
                smallestGain = std::min(smallestGain, g);
                y *= g;
            }
            out[i] = toSample(y);
        }
        return peak;
    }

    /// The smallest gain of the limiter since the last call.
    [[nodiscard]] double takeLimiterGain() noexcept { return std::exchange(smallestGain, 1.0); }

private:
    static constexpr double limiterHoldSeconds = 0.010;

    /// Twice smoothed: the drive of a motor sharpens every ripple.
    void aimStrength(double energy) noexcept
    {
        firstStrength += strengthShare * (energy - firstStrength);
        secondStrength += strengthShare * (firstStrength - secondStrength);
        flushTiny(firstStrength);
        flushTiny(secondStrength);
        double level = std::sqrt(2.0 * std::max(secondStrength, 0.0));
        if (burstLeft > 0)
        {
            --burstLeft;
            level = std::max(level, burst);
        }
        strength.aim(design->levels(level), 1.0);
    }

    const TranslatorDesign* design = nullptr;
    MotorDrive motor;
    LimiterGain limiter;
    std::array<StateVariableState, maxBiquadSections> states{};
    HopGlide drive;
    HopRamp levels, strength;
    double strengthShare = 1.0;
    double firstStrength = 0.0, secondStrength = 0.0; // mean squares
    double burst = 0.0;
    std::size_t burstHops = 1, burstLeft = 0;
    double smallestGain = 1.0;
};

} // namespace pacini
