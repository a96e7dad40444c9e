#pragma once

// Fit to an actuator: flattening of its resonance and choice of the frequencies to play, by the strength
// parameter.

#include <pacini/actuator/Equalizer.h>
#include <pacini/actuator/OutputFilter.h>
#include <pacini/actuator/Profile.h>
#include <pacini/actuator/Strength.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace pacini
{

/// Parameters of the fit.
struct ActuatorFitParams
{
    Decibels maxBoost{6.0};             ///< maximum boost of the drive to flatten a resonance, 0 to 40 dB
    double strength = standardStrength; ///< 0: as flat as can be; 1: as strong as can be; clamped, NaN counts as 0
    bool operator==(const ActuatorFitParams&) const = default;
};

/// Result of the fit: flattening, equalizer and range of an actuator.
struct ActuatorFit
{
    std::optional<Flattening> flattening;
    EqualizerSections equalizer;
    ActuatorRange range;           ///< the frequencies that are played, into which others are moved
    double towardsResonance = 0.0; ///< part of the way from as flat as can be to all on the resonance, 0 to 1
    bool operator==(const ActuatorFit&) const = default;
};

namespace detail
{
/// Between which frequencies, Hz, a mass on a spring is accelerated at least half as much, in power, as at its best.
/// With y = (w0 / w)^2 the acceleration's square is 1 / (y^2 + (1 / q^2 - 2) y + 1): largest at y = 1 - 1 / (2 q^2), or
/// at y = 0 where that is negative, and half of that at the roots of a quadratic. The upper end is infinite where the
/// plateau above the resonance is within 3 dB of it.
inline std::pair<double, double> halfPowerBand(const Resonance& resonance) noexcept
{
    const double halfSlope = 0.5 / (resonance.q * resonance.q) - 1.0;
    const double best = std::max(0.0, -halfSlope);
    const double least = (best + 2.0 * halfSlope) * best + 1.0;
    const double root = std::sqrt(std::max(0.0, halfSlope * halfSlope - 1.0 + 2.0 * least));
    const double below = root - halfSlope, above = -root - halfSlope;
    const double infinite = std::numeric_limits<double>::infinity();
    return {resonance.frequency / std::sqrt(below), above > 0.0 ? resonance.frequency / std::sqrt(above) : infinite};
}

/// The gain of a flattening at the resonance of the actuator, linear.
inline double gainAtResonance(const Flattening& flattening) noexcept
{
    const auto size = [&](const Resonance& pair)
    {
        const double frequency = flattening.actuator.frequency;
        const double away = (pair.frequency - frequency) * (pair.frequency + frequency);
        return std::hypot(away, pair.frequency * frequency / pair.q);
    };
    return flattening.gain * size(flattening.actuator) / size(flattening.target);
}

/// Returns the part of the way to the resonance, 0 to 1, for a strength. `loss` is the level, dB, that full flattening
/// loses at the resonance; losses below 3 dB count as 3 dB. At most (1 - strength)^3 max(24, loss) dB of it remain.
/// Narrow resonances lose most, so they move first; resonances that lose little stay flat.
inline double wayToResonance(double loss, double strength) noexcept
{
    constexpr double mostLost = 24.0, leastLost = 3.0; // dB
    const double flat = std::max(loss, leastLost);
    const double rest = 1.0 - strength;
    return std::max(0.0, 1.0 - std::max(mostLost, flat) * rest * rest * rest / flat);
}

/// Returns the flattening at the part `way`, 0 to 1, between `flat` and its strongest form.
///
/// The strongest form keeps the frequency of the actuator. Its q is reduced as far as a driver with `maxBoost` can
/// start and stop the mass sooner without a loss at the resonance; a q of 2 or less is fast enough and stays. The loss
/// at the resonance, in dB, falls in proportion to `way`. The target stays low and broad for most of the way: makeup
/// gain costs least, and all of it becomes overdrive at the start of a vibration and braking at its end.
inline Flattening strengthened(const Flattening& flat, double way, Decibels maxBoost) noexcept
{
    constexpr double fastEnough = 2.0;
    Flattening result = flat;
    const double strongestQ =
        std::min(flat.actuator.q, std::max(fastEnough, flat.actuator.q / Decibels(maxBoost).gain()));
    const double cubed = way * way * way;
    result.octaves = (1.0 - cubed) * flat.octaves;
    result.target = {flat.actuator.frequency * std::exp2(-result.octaves),
                     flat.target.q * std::pow(strongestQ / flat.target.q, cubed)};
    const double kept = std::pow(gainAtResonance(flat), 1.0 - way);
    result.gain = 1.0;
    result.gain = kept / gainAtResonance(result);
    result.most = std::max(flat.most, result.gain * highestGain(result.actuator, result.target));
    return result;
}

/// An equaliser whose cuts are reduced by a part, 0 to 1, of their decibels.
inline EqualizerSections withoutCuts(EqualizerSections sections, double part) noexcept
{
    for (EqualizerSection& section : sections)
        if (section.type != EqualizerType::highpass && section.gain < 0.0)
            section.gain *= 1.0 - part;
    return sections;
}

/// Narrows the range `extended` by flattening towards the half-power band of the resonance, within the range `own` of
/// the actuator. Distant ends move first: the way is in Hz, not in octaves.
inline ActuatorRange drawnIn(ActuatorRange extended, const ActuatorRange& own, const Resonance& resonance,
                             double way) noexcept
{
    const auto [low, high] = halfPowerBand(resonance);
    const double rest = 1.0 - way;
    const double part = 1.0 - rest * std::sqrt(rest);
    extended.lowFrequency += part * (clampTo(low, own.lowFrequency, own.highFrequency) - extended.lowFrequency);
    extended.highFrequency += part * (clampTo(high, own.lowFrequency, own.highFrequency) - extended.highFrequency);
    return extended;
}
} // namespace detail

/// Returns the flattening, equalizer and range with which a valid profile's actuator plays at a strength. At a strength
/// of 0, the response is as flat as possible (see flatteningOf), and the range grows at both ends by the shift of the
/// resonance. The inverse of a sharp resonance costs 10 to 24 dB at the resonance. With more strength
///
/// - the played frequencies move towards the half-power band of the resonance, where the actuator needs least drive,
///   the more the narrower it is;
/// - the inverse gives up its cut at the resonance, and a makeup gain restores the rest, up to no loss at a strength of
///   1;
/// - the boost of the inverse around the resonance becomes overdrive at each start and braking at each end, so that
///   timing stays crisp although the resonance is used. The protection behind it limits any excess.
///
/// A measured equalizer costs little and stays up to standardStrength. Above that, its cuts and the range outside of
/// the resonance are reduced in proportion. The strength has no effect on motors and plain signals. The result is
/// continuous in the strength.
[[nodiscard]] inline ActuatorFit fitActuator(const Profile& profile, const ActuatorFitParams& params) noexcept
{
    ActuatorFit fit{std::nullopt, profile.equalizer, profile.range, 0.0};
    if (profile.technology == Technology::erm || profile.technology == Technology::pcm)
        return fit;
    const double strength = clampTo(params.strength, 0.0, 1.0);
    if (const auto flat = flatteningOf(profile, params.maxBoost))
    {
        const double ratio = std::exp2(flat->octaves);
        fit.range.lowFrequency = std::max(fit.range.lowFrequency / ratio, 1.0);
        fit.range.highFrequency = std::min(fit.range.highFrequency * ratio, 20000.0);
        fit.towardsResonance =
            detail::wayToResonance(-Decibels::fromGain(detail::gainAtResonance(*flat)).value, strength);
        fit.flattening = flat;
        if (fit.towardsResonance > 0.0)
            fit.flattening = detail::strengthened(*flat, fit.towardsResonance, params.maxBoost);
    }
    else
    {
        fit.towardsResonance = profile.equalizer.empty()
                                   ? detail::wayToResonance(0.0, strength)
                                   : std::max(0.0, (strength - standardStrength) / (1.0 - standardStrength));
        fit.equalizer = detail::withoutCuts(fit.equalizer, fit.towardsResonance);
    }
    if (fit.towardsResonance > 0.0)
    {
        const Resonance worn = profile.body ? loadedResonance(*profile.body, profile.resonance) : profile.resonance;
        fit.range = detail::drawnIn(fit.range, profile.range, worn, fit.towardsResonance);
    }
    return fit;
}

/// Returns the ring time of a valid profile's actuator with this fit: s in which its ringing, as worn, falls to 1/e.
/// That is q / (pi f) of the target resonance, or of the actuator's own resonance with its q reduced by the cut of the
/// equalizer. 0 for motors and plain signals.
[[nodiscard]] inline double ringTime(const Profile& profile, const ActuatorFit& fit) noexcept
{
    if (profile.technology == Technology::erm || profile.technology == Technology::pcm)
        return 0.0;
    const auto fall = [](const Resonance& resonance)
    {
        return resonance.q / (std::numbers::pi * resonance.frequency);
    };
    if (fit.flattening)
        return fall(fit.flattening->target);
    constexpr double fs = 48000.0; // far above any resonance
    const Resonance own = profile.body ? loadedResonance(*profile.body, profile.resonance) : profile.resonance;
    return std::min(1.0, std::abs(designEqualizer(fit.equalizer, fs).response(Hertz(own.frequency), fs))) * fall(own);
}

/// Whether strength changes how a valid profile's actuator is played with the usual boost: that of plain signals and
/// motors it does not.
[[nodiscard]] inline bool tradesStrength(const Profile& profile) noexcept
{
    return !(fitActuator(profile, {.strength = 0.0}) == fitActuator(profile, {.strength = 1.0}));
}

} // namespace pacini
