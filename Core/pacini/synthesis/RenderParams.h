#pragma once

// Parameters of a rendering with their description, and its report, without its algorithms.

#include <pacini/actuator/Wearer.h>
#include <pacini/foundation/Description.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Result.h>
#include <pacini/synthesis/CompileParams.h>
#include <pacini/synthesis/RenderPlan.h>
#include <pacini/synthesis/SceneAdjustment.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// Parameters of rendering the acceleration of the skin: wearer and unit.
struct FeltParams
{
    unsigned wearer = 0;      ///< see bodyOn
    double fullScale = 100.0; ///< m/s^2 at a sample of 1
};

/// Parameters of a rendering.
struct RenderParams
{
    CompileParams compile; ///< with the sample rate of the output
    SceneAdjustment adjustment;
    double from = 0.0;              ///< start of the output, s of the scene
    std::optional<double> to;       ///< s, where it ends; none: at the end
    bool protect = true;            ///< keep within full drive and the limits of the profile
    std::optional<FeltParams> felt; ///< render the felt acceleration instead of the drive signal
    bool measure = false;           ///< also play everything, to measure the error of leaving out
    bool describe = false;          ///< report the content of each decoder
    std::size_t blockFrames = 4096; ///< the most that a sink gets at a time
};

inline constexpr std::array<std::string_view, 2> variationScopeNames{"breakpoint", "band"};
inline constexpr std::array<std::string_view, 3> carrierModeNames{"fixed", "pitch", "centroid"}; // none is for motors
inline constexpr std::array<std::string_view, 3> transientShapeNames{"adaptive", "square", "sine"};
inline constexpr std::array<std::string_view, 3> frequencyMappingNames{"clamp", "rescale", "fold"};

/// What a parameter of a rendering needs to have an effect.
enum class RenderNeed
{
    nothing,
    adaptation, ///< an actuator that the clips are adapted to
    shapedPulse ///< square or sine pulses
};

/// Description of a field of RenderParams, and what it needs.
struct RenderParameter : Parameter<RenderParams>
{
    RenderNeed need = RenderNeed::nothing;
};

/// Descriptions of the user settings of RenderParams that are numbers and choices.
inline constexpr std::array renderParameters{
    RenderParameter{described<&RenderParams::compile, &CompileParams::sampleRate>(
        {.name = "sampleRate",
         .option = "rate",
         .text = "Sample rate of the output",
         .unit = "Hz",
         .range = {limits::lowestRate, limits::highestRate}})},
    RenderParameter{described<&RenderParams::adjustment, &SceneAdjustment::gain>(
        {.name = "gain",
         .text = "Gain; the limiter keeps the result within full drive (1) and the limits of the profile",
         .unit = "dB",
         .range = {-120, 60}})}, // a scene is silent below
    RenderParameter{described<&RenderParams::adjustment, &SceneAdjustment::transposition>(
        {.name = "transpose",
         .member = "transposition",
         .text = "Transposition, without a change of length",
         .unit = "semitones",
         .range = {-96, 96}})},
    RenderParameter{described<&RenderParams::adjustment, &SceneAdjustment::stretch>(
        {.name = "stretch", .text = "Length factor, without a change of pitch", .range = {0.01, 100}})},
    RenderParameter{described<&RenderParams::adjustment, &SceneAdjustment::delay>(
        {.name = "delay", .text = "Silence before the start", .unit = "s", .range = {0, 3600}})}, // of a decoder
    RenderParameter{
        described<&RenderParams::from>({.name = "start",
                                        .option = "from",
                                        .text = "Start of the part to render; earlier parts still shape its beginning",
                                        .unit = "s",
                                        .range = {0, limits::duration}})},
    RenderParameter{described<&RenderParams::to>({.name = "end",
                                                  .option = "to",
                                                  .text = "End of the part to render",
                                                  .unit = "s",
                                                  .range = {0, limits::duration},
                                                  .usualText = "the end"})},
    RenderParameter{described<&RenderParams::adjustment, &SceneAdjustment::variation, &VariationParams::amount>(
        {.name = "variation",
         .text = "Random variation of the bands; in a scene, for plays without a variation of their own",
         .range = {0, 1}})},
    RenderParameter{described<&RenderParams::adjustment, &SceneAdjustment::variation, &VariationParams::scope>(
        {.name = "variationPer",
         .text = "Scope of the variation: one random factor per breakpoint or per band",
         .choices = variationScopeNames})},
    RenderParameter{described<&RenderParams::compile, &CompileParams::decoder, &DecoderChoice::carriers>(
        {.name = "carriers",
         .text = "Frequencies of the sinusoids: fixed centres, pitch curves, or moving with the centroid",
         .choices = carrierModeNames,
         .usualText = "as the clip was made",
         .unsetWord = "auto"})},
    RenderParameter{described<&RenderParams::compile, &CompileParams::decoder, &DecoderChoice::followEnvelope>(
        {.name = "followEnvelope",
         .option = "envelope",
         .text = "Match the sum of the bands to the total envelope",
         .usualText = "as the clip was made",
         .unsetWord = "auto"})},
    RenderParameter{described<&RenderParams::compile, &CompileParams::decoder, &DecoderChoice::pulseShape>(
        {.name = "pulse",
         .text = "Waveform of events",
         .choices = transientShapeNames,
         .usualText = "as the clip was made",
         .unsetWord = "auto"})},
    RenderParameter{described<&RenderParams::compile, &CompileParams::decoder, &DecoderChoice::pulseFrequency>(
                        {.name = "pulseFrequency",
                         .text = "Frequency of square and sine pulses",
                         .unit = "Hz",
                         .range = {1, 2000},
                         .usualText = "the actuator's resonance"}),
                    RenderNeed::shapedPulse},
    RenderParameter{described<&RenderParams::compile, &CompileParams::decoder, &DecoderChoice::pulseCycles>(
                        {.name = "pulseCycles", .text = "Periods of square and sine pulses", .range = {0.1, 100}}),
                    RenderNeed::shapedPulse},
    RenderParameter{described<&RenderParams::compile, &CompileParams::tolerance>(
        {.name = "tolerance",
         .text = "Largest total error from skipping inaudible and imperceptible parts, relative to the whole",
         .unit = "dB",
         .range = {-300, 0}})},
    RenderParameter{
        described<&RenderParams::compile, &CompileParams::adaptation, &AdaptationParams::mapping>(
            {.name = "mapping",
             .text =
                 "Mapping of frequencies outside the actuator's range: clamped to its ends, rescaled to fit, or folded "
                 "by octaves",
             .choices = frequencyMappingNames,
             .usualText = "as the profile says",
             .unsetWord = "profile"}),
        RenderNeed::adaptation},
    RenderParameter{
        described<&RenderParams::compile, &CompileParams::adaptation, &AdaptationParams::maxBoost>(
            {.name = "maxBoost",
             .text = "Largest boost for flattening the actuator's resonance; 0 leaves the resonance as it is",
             .unit = "dB",
             .range = {0, 40}}),
        RenderNeed::adaptation},
    RenderParameter{
        described<&RenderParams::compile, &CompileParams::adaptation, &AdaptationParams::strength>(
            {.name = "strength",
             .text = "Balance of fidelity and felt level on resonant actuators: 0 plays as flat as possible, 1 plays "
                     "everything on the resonance",
             .range = {0, 1}}),
        RenderNeed::adaptation},
};

/// Descriptions of all of FeltParams.
inline constexpr std::array feltParameters{
    described<&FeltParams::fullScale>({.name = "fullScale",
                                       .option = "feltFullScale",
                                       .text = "Acceleration that a sample of 1 stands for",
                                       .unit = "m/s^2",
                                       .range = {1e-3, 1e6}}),
    described<&FeltParams::wearer>(
        {.name = "wearer",
         .text = "Wearer: 0 has the skin of the profile, 1 to 14 are simulated people with half to "
                 "twice its mass, stiffness and damping (assumed)",
         .range = {0, simulatedWearers}}),
};

/// Checks that a parameter has an effect with `params` and with or without a profile. Errors: invalidArgument at its
/// name.
[[nodiscard]] inline Result<void> checkEffect(const RenderParameter& parameter, const RenderParams& params,
                                              bool hasProfile)
{
    const auto useless = [&](const char* why)
    {
        return Error{ErrorCode::invalidArgument, std::string(parameter.name), why};
    };
    if (parameter.need == RenderNeed::adaptation && !hasProfile)
        return useless("needs a profile, the actuator that the clips are adapted to; leave it out, or name one");
    if (parameter.need == RenderNeed::adaptation && !params.compile.adapt)
        return useless("has no effect where clips are not adapted; leave it out");
    if (parameter.need == RenderNeed::shapedPulse &&
        params.compile.decoder.pulseShape.value_or(TransientShape::adaptive) == TransientShape::adaptive)
        return useless("is for square and sine pulses; leave it out, or choose the pulse square or sine");
    return {};
}

/// Checks that the part from `from` to `to` is not empty. Errors: invalidArgument at `end`.
[[nodiscard]] inline Result<void> checkPart(const RenderParams& params)
{
    if (params.to && !(*params.to > params.from))
        return Error{ErrorCode::invalidArgument, "end", "must be after the start"};
    return {};
}

/// Report of a rendering.
struct RenderReport
{
    std::size_t actuators = 1;
    std::uint64_t frames = 0;    ///< of the output
    std::size_t givenPlays = 0;  ///< of the scene
    std::size_t keptPlays = 0;   ///< of the plan
    std::size_t maxSounding = 0; ///< decoders at a time
    double reduction = 0.0;      ///< dB, the most that was taken to keep within full drive and the profile's limits
    double culledError = 0.0;    ///< dB below all that the actuator can play, of what nobody feels; -infinity: none
    double predictedError = 0.0; ///< dB below the whole, of that and of what the actuator cannot play
    std::optional<double> measuredError; ///< what culledError predicts as measured, dB, if requested
    std::vector<Adaptation> adaptations;
    std::vector<LeftOut> leftOut;       ///< in order of error
    std::vector<DecodedPlay> decoded;   ///< in order of start; where they were to be described
    std::vector<std::string> playNames; ///< of all plays of the scene then, or of their clips
};

} // namespace pacini
