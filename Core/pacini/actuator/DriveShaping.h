#pragma once

// Pre-emphasis and active braking for actuators that follow slowly.

#include <pacini/actuator/FirstOrderInverse.h>
#include <pacini/actuator/Profile.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>

#include <cstddef>
#include <numbers>
#include <span>

namespace pacini
{

struct DriveShapingParams
{
    FirstOrderTimes times;
    double overdrive = 1.0; ///< the largest drive, 1 to 10, in units of the drive that holds a strength of 1
    bool braking = true;    ///< whether the drive may turn negative to end a strength sooner
    bool operator==(const DriveShapingParams&) const = default;
};

/// The time constants of a strength that follows its drive as a first-order lag: 90 % of a step are passed, or 10 % of
/// it are left, after tau ln 10.
[[nodiscard]] inline FirstOrderTimes strengthTimes(const ActuatorResponse& response) noexcept
{
    return {response.riseTime / std::numbers::ln10, response.fallTime / std::numbers::ln10};
}

/// Of a valid profile.
[[nodiscard]] inline DriveShapingParams driveShapingParams(const Profile& profile) noexcept
{
    return {strengthTimes(profile.response), profile.drive.overdrive, true};
}

/// Whether shaping changes anything: without response times it is the identity.
[[nodiscard]] inline bool driveShapingNeeded(const Profile& profile) noexcept
{
    return profile.response.riseTime > 0.0 || profile.response.fallTime > 0.0;
}

/// Wanted strength (0 to 1, an envelope; below 0 counts as 0) to the amplitude of the drive, so that the strength of
/// the actuator follows (see FirstOrderInverse). Out of [-overdrive, overdrive]; a negative amplitude means the
/// sinusoid of an LRA with its phase reversed, the reversed voltage of a motor. An LRA's amplitude at resonance is
/// first order with tau = q / (pi f0); the drive's frequency must be the resonance, or the reversed phase does not
/// brake.
///
/// What plays a rated amplitude of 1 at 1 / overdrive divides the result by the overdrive.
///
/// Without latency: the strength reaches the wanted value at the end of the sample, as far as the limits let it. The
/// modelled actuator never goes past the wanted strength; a real one whose time constant is off by some part does so by
/// about that part of what the overdrive added. Overdrives that change an LRA by much within half a period (more than
/// about q / 4) find no whole period to act in and leave a rest of ringing.
class DriveShaping
{
public:
    using Params = DriveShapingParams;

    void prepare(const ProcessSpec& spec) noexcept
    {
        fs = spec.sampleRate;
        setParams(current);
        reset();
    }
    void setParams(const Params& params) noexcept
    {
        current = params;
        strength.design(params.times, fs);
        highest = clampTo(params.overdrive, 1.0, 10.0);
        lowest = params.braking ? -highest : 0.0;
    }
    void reset() noexcept { strength.reset(); }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        const auto tick = [this](double wanted)
        {
            return strength.tick(wanted > 0.0 ? wanted : 0.0, lowest, highest);
        };
        forEachSample(in, out, tick, [this] { strength.flush(); });
    }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return 0; }

private:
    double fs = ProcessSpec{}.sampleRate;
    Params current;
    FirstOrderInverse strength;
    double lowest = -1.0;
    double highest = 1.0;
};

static_assert(DspBlock<DriveShaping>);

} // namespace pacini
