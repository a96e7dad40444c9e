#pragma once

// Drive of a motor with an eccentric mass (ERM): its voltage, from the strength that is wanted.

#include <pacini/actuator/CoilHeat.h>
#include <pacini/actuator/FrameGroup.h>
#include <pacini/actuator/Profile.h>
#include <pacini/actuator/ProtectionParams.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

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
        perRise = 1.0 / rise;
        perFall = 1.0 / fall;
    }
    void reset() noexcept { state = 0.0; }

    /// The drive for one sample, within [lowest, highest]; moves the modelled state on by one sample.
    double tick(double wanted, double lowest, double highest) noexcept
    {
        const double rate = wanted > state ? rise : fall;
        const double perRate = wanted > state ? perRise : perFall;
        const double exact = rate < 1.0 ? state + (wanted - state) * perRate : wanted;
        if (exact >= lowest && exact <= highest)
        {
            state = wanted; // for which nothing has to wait
            return exact;
        }
        const double drive = clampTo(exact, lowest, highest);
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
    double perRise = 1.0; ///< waiting for a division at every frame takes longer than all the rest
    double perFall = 1.0;
    double state = 0.0;
};

/// Parameters of a motor and its drive. Voltages are in units of the rated one, which turns the motor at its rated
/// speed.
struct MotorDriveParams
{
    FirstOrderTimes speedTimes;  ///< time constants of the speed
    double overdrive = 1.0;      ///< the largest voltage, 1 to 10
    double startVoltage = 0.25;  ///< the least that gets a standing motor to turn; small motors need 0.2 to 0.4
    double stallVoltage = 0.125; ///< below this a turning motor stops
    Seconds kickTime{0.020};     ///< of start voltage when the spin-up time is not known
    bool braking = true;         ///< whether the voltage may be reversed to stop sooner
    std::optional<CoilHeatParams> heat{}; ///< at the largest voltage; none: no limit
    bool operator==(const MotorDriveParams&) const = default;
};

/// Returns the time constants of a motor's speed. `response` has the times at which its strength, the square of the
/// speed, passes 90 % of a step and falls to 10 %.
[[nodiscard]] inline FirstOrderTimes speedTimes(const ActuatorResponse& response) noexcept
{
    return {response.riseTime / -std::log(1.0 - std::sqrt(0.9)), response.fallTime / -std::log(std::sqrt(0.1))};
}

/// The motor drive parameters of a valid profile.
[[nodiscard]] inline MotorDriveParams motorDriveParams(const Profile& profile) noexcept
{
    MotorDriveParams params;
    params.speedTimes = speedTimes(profile.response);
    params.overdrive = profile.drive.overdrive;
    params.heat = protectionParams(profile, Seconds(0.0)).heat;
    return params;
}

/// Motor drive. Wanted strength (0 to 1, an envelope; 1 is the strength at rated voltage) to voltage. The force of an
/// eccentric mass is m r w^2 and its speed w follows the voltage, so the wanted speed is the square root of the
/// strength:
///
/// - it is reached by overdrive and left by braking (see FirstOrderInverse, applied to the speed),
/// - a standing motor gets at least the start voltage until its modelled speed is the wanted one (friction at rest is
///   higher than in motion), or for the kick time,
/// - a strength that the motor cannot hold is raised to the weakest it can, stallVoltage^2; below a quarter of that it
///   is 0: there is nothing between,
/// - the voltage stays below what a coil that may not get hotter bears (see CoilHeat). A bound on a voltage distorts
///   nothing, so that no gain has to go before it, and the modelled speed knows of it: a motor that was held back is
///   not braked for a speed that it never had.
///
/// Out of [-overdrive, overdrive], not negative without braking. No latency.
class MotorDrive : public DesignedBlock<MotorDrive, MotorDriveParams>
{
public:
    void setParams(const Params& params) noexcept
    {
        if (!current.heat)
            heat.reset();
        current = params;
        if (params.heat)
            heat.design(*params.heat, fs);
        framesIntoGroup = 0;
        speed.design(params.speedTimes, fs);
        highest = clampTo(params.overdrive, 1.0, 10.0);
        perHighest = 1.0 / highest;
        start = clampTo(params.startVoltage, 0.0, 1.0);
        stall = clampTo(params.stallVoltage, 0.0, start);
        kickFrames =
            params.speedTimes.rise > 0.0 ? 0 : static_cast<std::size_t>(clampTo(params.kickTime.value, 0.0, 1.0) * fs);
    }
    void reset() noexcept
    {
        speed.reset();
        heat.reset();
        starting = false;
        kickLeft = 0;
        framesIntoGroup = 0;
    }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        for (std::size_t begin = 0; begin < in.size();)
        {
            const std::size_t left = in.size() - begin;
            const std::size_t n = framesIntoGroup > 0  ? std::min(left, groupFrames - framesIntoGroup)
                                  : left < groupFrames ? left
                                                       : std::min(left - left % groupFrames, flushInterval);
            const auto from = in.subspan(begin, n);
            const auto to = out.subspan(begin, n);
            const bool wholeGroups = framesIntoGroup == 0 && n % groupFrames == 0;
            if (!current.heat || (wholeGroups && heat.bears(n)))
                playFreely(from, to);
            else
                for (std::size_t i = 0; i < n; ++i)
                    to[i] = toSample(tick(finiteOrZero(from[i])));
            framesIntoGroup = (framesIntoGroup + n) % groupFrames;
            begin += n;
            speed.flush();
            heat.flush();
        }
    }

private:
    /// tick() for whole groups of frames, while the coil bears the largest voltage.
    void playFreely(std::span<const float> in, std::span<float> out) noexcept
    {
        std::array<double, flushInterval> driveRoom;
        const auto drives = std::span(driveRoom).first(in.size());
        double peak = 0.0;
        for (std::size_t i = 0; i < in.size(); ++i)
        {
            const double voltage = follow(finiteOrZero(in[i]), highest);
            drives[i] = voltage * perHighest;
            peak = std::max(peak, std::abs(drives[i]));
            out[i] = toSample(voltage);
        }
        if (current.heat)
            heat.advanceFreely(drives, std::min(peak, 1.0)); // which bears() has asked for; a peak may be rounded above
    }

    double tick(double strength) noexcept
    {
        const double most = current.heat ? highest * heat.admit(1.0) : highest;
        const double voltage = follow(strength, most);
        if (current.heat)
            heat.advance(voltage * perHighest);
        return voltage;
    }

    /// One frame of a voltage up to `most`.
    double follow(double strength, double most) noexcept
    {
        const double exact = strength > 0.0 ? std::sqrt(strength) : 0.0;
        const double wanted = exact < 0.5 * stall ? 0.0 : std::max(exact, stall);
        if (!(wanted > 0.0))
            starting = false;
        else if (speed.value() < 0.5 * stall && !starting)
        {
            starting = true;
            kickLeft = kickFrames;
        }
        const double lowest = starting ? std::min(start, most) : current.braking ? -most : 0.0;
        const double voltage = speed.tick(wanted, lowest, most);
        if (kickLeft > 0)
            --kickLeft;
        else if (speed.value() >= wanted)
            starting = false;
        return voltage;
    }

    FirstOrderInverse speed;
    CoilHeat heat;
    double highest = 1.0;
    double perHighest = 1.0;
    std::size_t framesIntoGroup = 0;
    double start = 0.0;
    double stall = 0.0;
    std::size_t kickFrames = 0;
    std::size_t kickLeft = 0;
    bool starting = false;
};

static_assert(DspBlock<MotorDrive>);

} // namespace pacini
