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
    Decibels maxBoost{6.0};             ///< by which the drive may be raised to flatten a resonance, 0 to 40 dB
    double strength = standardStrength; ///< 0: as flat as can be; 1: as strong as can be; clamped, NaN counts as 0
    bool operator==(const ActuatorFitParams&) const = default;
};

/// How an actuator is played.
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

/// Which part of the way to the resonance a strength goes, where flattening as far as can be loses `loss` dB there: as
/// far as leaves at most 24 (1 - strength)^3 dB of it, so that narrow resonances go first, which lose most, and those
/// that lose little stay flat. What loses more than 24 dB goes the same way; a loss below 3 dB counts as that.
inline double wayToResonance(double loss, double strength) noexcept
{
    constexpr double mostLost = 24.0, leastLost = 3.0; // dB
    const double flat = std::max(loss, leastLost);
    const double rest = 1.0 - strength;
    return std::max(0.0, 1.0 - std::max(mostLost, flat) * rest * rest * rest / flat);
}

/// The flattening `way` of the way from `flat` to its strongest: the target of that has the actuator's own frequency
/// and so much less q that a driver which raises the drive by `maxBoost` starts and stops it sooner without a loss at
/// the resonance; resonances of a q of 2 and less are fast enough as they are. What is lost at the resonance, in dB,
/// falls in proportion; the target stays low and broad for longer, since it is the drive's makeup gain that costs
/// least, and all of it goes into overdrive at the start of what is felt and into braking at the end.
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

/// The range that flattening extends, drawn in to the half-power band of the resonance as far as that lies in the
/// actuator's own range. Far ends move first: in Hz, not in octaves.
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

/// How a valid profile's actuator is played with a strength. With 0 it is as flat as can be (see flatteningOf) and its
/// range grows at either end as far as its resonance moves. The inverse of a sharp resonance costs 10 to 24 dB there;
/// with more strength
///
/// - the frequencies that are played are drawn in to the half-power band of the resonance, the narrower that is the
///   more, where the actuator needs least drive;
/// - the inverse gives up its cut there, and a makeup gain what is left of it, up to no loss at a strength of 1;
/// - what the inverse raises around the resonance is overdrive at each start and braking at each end, so that time
///   stays crisp although the resonance is used. The protection behind takes what is too much of it.
///
/// A measured equaliser costs little and stays as it is up to standardStrength; from there its cuts, and what lies
/// outside of the resonance, are given up in proportion. Motors and plain signals have nothing to trade. Continuous in
/// the strength.
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

/// How long a valid profile's actuator rings when it is played so: s in which its ringing, as worn, falls to 1/e. That
/// is q / (pi f) of the resonance that it is flattened to, or of its own with as much less q as the equaliser cuts
/// there. 0 for motors and plain signals.
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
