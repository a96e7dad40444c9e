#pragma once

// Choice of decoder parameters for a clip.

#include <pacini/clip/Clip.h>
#include <pacini/synthesis/DecoderParams.h>

#include <optional>

namespace pacini
{

/// Overrides of decoder parameters by the user; unset ones follow from the method that made the clip.
struct DecoderChoice
{
    std::optional<CarrierMode> carriers;
    std::optional<bool> followEnvelope;
    std::optional<TransientShape> pulseShape;
    std::optional<double> pulseFrequency; ///< Hz, of square and sine pulses
    double pulseCycles = 1.0;
    bool operator==(const DecoderChoice&) const = default;
};

/// Returns the decoder's parameters for a clip: those of the thesis for its clips, else Pacini's own, with the given
/// changes. `resonance` (Hz) is the actuator's.
[[nodiscard]] inline DecoderParams decoderParamsFor(const Clip& clip, DecoderParams params, const DecoderChoice& choice,
                                                    double resonance)
{
    if (encoderText(clip, "method", "a2vt") == "thesis")
    {
        const DecoderParams thesis = thesisDecoderParams(params.sampleRate, resonance);
        params.carriers = thesis.carriers;
        params.followEnvelope = thesis.followEnvelope;
        params.fullRate = thesis.fullRate;
        params.pulses = thesis.pulses;
    }
    params.carriers = choice.carriers.value_or(params.carriers);
    params.followEnvelope = choice.followEnvelope.value_or(params.followEnvelope);
    params.pulses.shape = choice.pulseShape.value_or(params.pulses.shape);
    if (choice.pulseShape)
    {
        params.pulses.cycles = choice.pulseCycles;
        params.pulses.frequency = choice.pulseFrequency.value_or(resonance);
    }
    return params;
}

} // namespace pacini
