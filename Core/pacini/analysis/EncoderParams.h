#pragma once

// Parameters of the encoder and their description, without its algorithms.

#include <pacini/analysis/OnsetParams.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/BandSpacing.h>
#include <pacini/foundation/Description.h>
#include <pacini/foundation/Result.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// Translation of sound above the range of touch.
enum class HeardRole
{
    beside,  ///< as a tone beside the low part of the sound, see HeardBeside
    instead, ///< instead of the low part, if most of the heard sound lies above it, see HeardInstead
};

/// Parameters of the encoder; encoderParameters describes them.
struct EncoderParams
{
    int bands = 12;
    double lowFrequency = 30.0;
    double highFrequency = 1000.0;
    BandSpacing spacing = BandSpacing::logarithmic;
    double breakpoints = 20.0; ///< of all curves together
    int quantise = 6;          ///< see PackParams
    bool normalise = true;     ///< scale to full drive; otherwise full scale is full drive, and sounds more than 54 dB
                               ///< above it are scaled down to that
    double audible = 1.0;      ///< amount of sound above the range of touch that is felt
    HeardRole heard = HeardRole::beside;
    double speech = 1.0; ///< amount of speech that is felt
    OnsetParams onsets;  ///< criteria of events; see Onset
    bool operator==(const EncoderParams&) const = default;
};

inline constexpr std::array<std::string_view, 2> spacingNames{"log", "linear"};
inline constexpr std::array<std::string_view, 2> spacingMembers{"logarithmic", "linear"};

inline constexpr std::array<std::string_view, 2> heardRoleNames{"beside", "instead"};

/// Descriptions of all user settings of EncoderParams, in the order of help texts and records.
inline constexpr std::array encoderParameters{
    described<&EncoderParams::bands>({.name = "bands",
                                      .text = "Number of frequency bands",
                                      .range = {1, 32},
                                      .group = "Analysis",
                                      .alwaysRecorded = true}),
    described<&EncoderParams::breakpoints>({.name = "breakpoints",
                                            .text = "Maximum number of breakpoints; simple sounds need fewer",
                                            .unit = "per second and band",
                                            .range = {0.5, 1000},
                                            .group = "Analysis",
                                            .alwaysRecorded = true}),
    described<&EncoderParams::quantise>({.name = "quantise",
                                         .text = "Resolution of each value",
                                         .unit = "bits",
                                         .range = {4, 16},
                                         .group = "Analysis",
                                         .alwaysRecorded = true}),
    described<&EncoderParams::lowFrequency>({.name = "low",
                                             .member = "lowFrequency",
                                             .text = "Lower end of the bands",
                                             .unit = "Hz",
                                             .range = {1, 1700},
                                             .group = "Analysis"}),
    described<&EncoderParams::highFrequency>({.name = "high",
                                              .member = "highFrequency",
                                              .text = "Upper end of the bands",
                                              .unit = "Hz",
                                              .range = {2, 1800},
                                              .group = "Analysis"}),
    described<&EncoderParams::spacing>({.name = "spacing",
                                        .text = "Spacing of the bands: log or linear",
                                        .choices = spacingNames,
                                        .memberChoices = spacingMembers,
                                        .group = "Analysis"}),
    described<&EncoderParams::onsets, &OnsetParams::sensitivity>(
        {.name = "sensitivity",
         .text = "Sensitivity to events; above 1 weaker events also become transients, below 1 only stronger ones",
         .range = {0.25, 4},
         .group = "Analysis"}),
    described<&EncoderParams::audible>(
        {.name = "audible",
         .text = "Amount of sound above the range of touch that is felt (hi-hats, rain, ticks); 0: none",
         .range = {0, 1},
         .group = "Analysis",
         .alwaysRecorded = true}), // clips without it are from before there was such a thing
    described<&EncoderParams::heard>({.name = "heard",
                                      .text = "How that sound is added: beside the low part, which stays as it is, or "
                                              "instead of it where most of the sound lies above touch",
                                      .choices = heardRoleNames,
                                      .group = "Analysis",
                                      .alwaysRecorded = true}), // clips without it are from when it was always instead
    described<&EncoderParams::speech>({.name = "speech",
                                       .text = "Amount of speech that is felt; below 1, what sounds like speech is "
                                               "turned down above 75 Hz",
                                       .range = {0, 1},
                                       .group = "Analysis"}),
    described<&EncoderParams::normalise>({.name = "keepLevel",
                                          .member = "normalise",
                                          .text = "Keep the level of the sound instead of raising it to full drive",
                                          .group = "Analysis",
                                          .negated = true}),
    described<&EncoderParams::onsets, &OnsetParams::minimumGap>(
        {.name = "minimumGap",
         .text = "Minimum time between two events; an event that follows sooner is dropped",
         .unit = "s",
         .range = {0, 1},
         .group = "Events"}),
    described<&EncoderParams::onsets, &OnsetParams::maskMargin>(
        {.name = "maskMargin",
         .text = "Level difference to louder neighbours up to which an event is not masked",
         .unit = "dB",
         .range = {0, 120},
         .group = "Events"}),
    described<&EncoderParams::onsets, &OnsetParams::maskSlope>(
        {.name = "maskSlope",
         .text = "Rise of the detection threshold for each dB beyond the mask margin, as a fraction of the threshold",
         .unit = "per dB",
         .range = {0, 1},
         .group = "Events"}),
    described<&EncoderParams::onsets, &OnsetParams::maskRecovery>(
        {.name = "maskRecovery",
         .text = "Decay of masking with the time between two events",
         .unit = "dB/s",
         .range = {20, 1000}, // below 20, masking would reach beyond SoundSection::secondsAhead
         .group = "Events"}),
    described<&EncoderParams::onsets, &OnsetParams::maskLimit>(
        {.name = "maskLimit",
         .text = "Level difference to louder neighbours above which an event is always dropped",
         .unit = "dB",
         .range = {0, 120},
         .group = "Events"}),
    described<&EncoderParams::onsets, &OnsetParams::silence>({.name = "silence",
                                                              .text = "Level below which events are dropped",
                                                              .unit = "dB",
                                                              .range = {-120, 0},
                                                              .group = "Events"}),
};

/// Checks the ranges of EncoderParams.
[[nodiscard]] inline Result<void> validate(const EncoderParams& params)
{
    if (auto allowed = checkParameters(encoderParameters, params); !allowed)
        return allowed;
    if (params.lowFrequency >= params.highFrequency)
        return Error{ErrorCode::invalidArgument, "low", "must be lower than high"};
    return {};
}

/// The parameters as a clip keeps them; the gain, which depends on the sound, comes on top.
[[nodiscard]] inline std::vector<EncoderParameter> encoderRecord(const EncoderParams& params)
{
    std::vector<EncoderParameter> record = {{"method", std::string("a2vt")}};
    for (const auto& parameter : encoderParameters)
    {
        const double value = parameter.get(params);
        if (!parameter.alwaysRecorded && value == parameter.usual())
            continue;
        if (parameter.kind == ParameterKind::truth) // under the name of the member: `normalise` since the first clips
            record.push_back({std::string(parameter.member), (value != 0.0) != parameter.negated});
        else if (parameter.kind == ParameterKind::choice)
            record.push_back({std::string(parameter.name), valueText(parameter, value)});
        else
            record.push_back({std::string(parameter.name), value});
    }
    return record;
}

} // namespace pacini
