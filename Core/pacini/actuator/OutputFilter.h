#pragma once

// What flattens an actuator: its measured equaliser, or the inverse of its resonance.

#include <pacini/actuator/Equalizer.h>
#include <pacini/actuator/PolePairInverse.h>
#include <pacini/actuator/Profile.h>
#include <pacini/filters/BiquadCascade.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pacini
{

/// Trades strength at the resonance for the frequencies around it.
struct Flattening
{
    Resonance actuator;   ///< as it is worn
    Resonance target;     ///< what it answers like instead
    double gain = 1.0;    ///< headroom for what the inverse raises
    double octaves = 0.0; ///< by which the range grows at either end
    bool operator==(const Flattening&) const = default;
};

/// The flattening of a valid profile whose drive is raised by at most `maxBoost` dB (0 to 40), or none: with an
/// equaliser of its own it is flat already, a motor has no resonance that a filter could undo, and nothing is known of
/// a plain signal.
/// Below its resonance a mass on a spring falls by 12 dB an octave, so that the boost moves the resonance down by
/// maxBoost / 12 octaves, with a q of 1 (of an eighth for very sharp ones, which would become too weak). The inverse
/// also starts and stops the mass sooner: it is the pre-emphasis and the active braking of slow actuators, exact for
/// the model. Half of the boost (in dB) is taken as headroom; the protection takes the rest where a sound needs all of
/// it.
[[nodiscard]] inline std::optional<Flattening> flatteningOf(const Profile& profile, Decibels maxBoost) noexcept
{
    if (!profile.equalizer.empty() || profile.technology == Technology::erm || profile.technology == Technology::pcm ||
        !(maxBoost.value > 0.0))
        return std::nullopt;
    const double boost = std::min(maxBoost.value, 40.0);
    Flattening result;
    result.actuator = profile.body ? loadedResonance(*profile.body, profile.resonance) : profile.resonance;
    result.octaves = boost / 12.0;
    result.target = {result.actuator.frequency * std::exp2(-result.octaves), std::max(1.0, result.actuator.q / 8.0)};
    result.gain = Decibels(-0.5 * boost).gain();
    return result;
}

struct OutputFilterParams
{
    EqualizerSections equalizer;
    std::optional<Flattening> flattening;
    bool operator==(const OutputFilterParams&) const = default;
};

/// Equaliser and flattening in series at `fs` Hz.
[[nodiscard]] inline BiquadCascadeCoefficients designOutputFilter(const OutputFilterParams& params, double fs) noexcept
{
    BiquadCascadeCoefficients cascade = designEqualizer(params.equalizer, fs);
    if (params.flattening)
    {
        BiquadCoefficients inverse = designPolePairInverse(params.flattening->actuator, params.flattening->target, fs);
        inverse.b0 *= params.flattening->gain;
        inverse.b1 *= params.flattening->gain;
        inverse.b2 *= params.flattening->gain;
        cascade.sections.pushBack(asStateVariable(inverse));
    }
    return cascade;
}

using OutputFilter = DesignedCascade<OutputFilterParams, designOutputFilter>;

static_assert(DspBlock<OutputFilter>);

} // namespace pacini
