#pragma once

// Parameters of the protection: which limits of an actuator have to be guarded.

#include <pacini/actuator/BodyChain.h>
#include <pacini/actuator/CoilHeat.h>
#include <pacini/actuator/ExcursionGuard.h>
#include <pacini/actuator/Profile.h>
#include <pacini/actuator/TravelModes.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <optional>
#include <string>

namespace pacini
{

/// Limits of an actuator that are guarded, and how.
struct ProtectionParams
{
    std::optional<ExcursionParams> excursion; ///< none: no limit
    std::optional<CoilHeatParams> heat;       ///< none: no limit
    Hertz lowFrequency{20.0};                 ///< the lowest tone to be played, 1 to 20000 Hz
    Seconds lookAhead{0.001};                 ///< 0 (live) to 1 ms
    bool boundsAlone = false;                 ///< without high-passes and gain: for direct voltages, whose mean counts
    bool operator==(const ProtectionParams&) const = default;
};

/// The most that any drive can do to an actuator, and which limits can be reached at all. A limit that the profile does
/// not name, or that no drive reaches, needs no protection and is left out without any error.
///
/// This is the only place where it is judged, and here alone overdrive comes in: the drive is a signal within +-1 whose
/// 1 is the largest that can occur, `overdrive` times the rated drive. All parameters below are those of that signal.
struct ProtectionNeeds
{
    enum class Limit
    {
        unknown,  ///< the profile does not say enough to know the limit
        unharmed, ///< no drive within +-1 reaches it, overdriven or not
        guarded   ///< some drive would exceed it
    };
    Limit excursion = Limit::unknown;
    Limit heat = Limit::unknown;
    double worstExcursion = 0.0; ///< m with overdrive, when known; the larger of a base held still and worn
    double worstWorn = 0.0;      ///< m of these as it is worn, when the profile has a body: a bound
    double worstPower = 0.0;     ///< W with overdrive, when known
};

/// The time constant of coils whose profile has none: short for them, so that protection acts too early, not too late.
inline constexpr double defaultThermalTime = 1.0; // s

/// The chain in which the moving mass of a valid profile travels as it is worn, its force that of a drive of 1; none
/// without a body, nor of a motor, whose mass turns. The force gives the stated travel on a base held still. A body
/// states it once more: of two numbers that disagree the larger counts.
[[nodiscard]] inline std::optional<BodyChain> wornChain(const Profile& profile) noexcept
{
    if (!profile.body || !profile.drive.excursion || profile.technology == Technology::erm)
        return std::nullopt;
    BodyChain chain = makeBodyChain(*profile.body, profile.resonance);
    chain.force = profile.drive.overdrive * std::max(*profile.drive.excursion * chain.suspensionStiffness, chain.force);
    return chain;
}

/// The excursion limit of a valid profile, if it has one.
[[nodiscard]] inline std::optional<ExcursionParams> excursionParams(const Profile& profile) noexcept
{
    const ActuatorDrive& drive = profile.drive;
    if (!drive.maxExcursion || !drive.excursion)
        return std::nullopt;
    return ExcursionParams{Hertz(profile.resonance.frequency), profile.resonance.q, drive.overdrive * *drive.excursion,
                           *drive.maxExcursion, wornChain(profile)};
}

/// The heat limit of a valid profile, if it has one. The rated drive is the peak of a sinusoid of maxVoltageRms, or of
/// a motor the direct voltage maxVoltageRms, so that the power of a drive u is 2 (1 of a motor) times (overdrive
/// maxVoltageRms u)^2 / impedance.
[[nodiscard]] inline std::optional<CoilHeatParams> coilHeatParams(const Profile& profile) noexcept
{
    const ActuatorDrive& drive = profile.drive;
    if (!drive.maxPower || !drive.impedance || !drive.maxVoltageRms)
        return std::nullopt;
    const double most = drive.overdrive * *drive.maxVoltageRms;
    const double squares = profile.technology == Technology::erm ? 1.0 : 2.0;
    return CoilHeatParams{squares * most * most / *drive.impedance, *drive.maxPower,
                          Seconds(drive.thermalTime.value_or(defaultThermalTime))};
}

[[nodiscard]] inline ProtectionNeeds protectionNeeds(const Profile& profile) noexcept
{
    using Limit = ProtectionNeeds::Limit;
    ProtectionNeeds needs;
    if (const auto params = excursionParams(profile))
    {
        needs.worstWorn = params->worn ? worstTravel(*params->worn) : 0.0;
        needs.worstExcursion = std::max(worstExcursion(*params), needs.worstWorn);
        needs.excursion = needs.worstExcursion <= params->maxExcursion ? Limit::unharmed : Limit::guarded;
    }
    if (const auto params = coilHeatParams(profile))
    {
        needs.worstPower = params->fullDrivePower;
        needs.heat = needs.worstPower <= params->maxPower ? Limit::unharmed : Limit::guarded;
    }
    return needs;
}

/// The protection parameters of a valid profile; limits that cannot be reached are left out.
[[nodiscard]] inline ProtectionParams protectionParams(const Profile& profile, Seconds lookAhead) noexcept
{
    const ProtectionNeeds needs = protectionNeeds(profile);
    ProtectionParams params;
    if (needs.excursion == ProtectionNeeds::Limit::guarded)
    {
        params.excursion = excursionParams(profile);
        if (needs.worstWorn <= params.excursion->maxExcursion)
            params.excursion->worn.reset();
    }
    if (needs.heat == ProtectionNeeds::Limit::guarded)
        params.heat = coilHeatParams(profile);
    params.lowFrequency = Hertz(profile.range.lowFrequency);
    params.lookAhead = lookAhead;
    return params;
}

/// Describes the protection by the limits of a valid profile, such as "travel is kept within its limit; no drive
/// reaches the limit of heat". Motors that turn (`turns`) have no travel.
[[nodiscard]] inline std::string protectionText(const Profile& profile, bool turns = false)
{
    using Limit = ProtectionNeeds::Limit;
    const ProtectionNeeds needs = protectionNeeds(profile);
    const auto text = [](Limit limit, const std::string& what)
    {
        return limit == Limit::guarded    ? what + " is kept within its limit"
               : limit == Limit::unharmed ? "no drive reaches the limit of " + what
                                          : "the profile names no limit of " + what;
    };
    const std::string heat = text(needs.heat, "heat");
    return turns ? heat : text(needs.excursion, "travel") + "; " + heat;
}

} // namespace pacini
