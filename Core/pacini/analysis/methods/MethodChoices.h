#pragma once

// The translation methods by name, and the parameters of each, without their algorithms.

#include <pacini/analysis/EncoderParams.h>
#include <pacini/foundation/Description.h>
#include <pacini/foundation/Result.h>

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// Translation method.
enum class Method
{
    a2vt,
    thesis,
    decomposition,
    envelopeSine,
    envelopeCentroid,
    vocoder16,
    centroidFlatness,
    modulation,
    lowpass,
    pitchShift,
    hapticGen,
    frequencyShift,
    percept,
    pitchMatch,
};

/// Output of a translation method: clips or samples.
enum class MethodOutput
{
    clip,   ///< few breakpoints, to be decoded
    signal, ///< a drive signal as it is
};

/// Name and description of a translation method.
struct MethodInfo
{
    Method method;
    std::string_view name; ///< on the command line and in a clip's record of its encoder
    MethodOutput output;
    std::string_view description; ///< one line
};

/// All methods, in the order of Method.
inline constexpr std::array<MethodInfo, 14> methodTable{{
    {Method::a2vt, "a2vt", MethodOutput::clip,
     "Pacini's own: band envelopes and pitches with the fewest points for their error"},
    {Method::thesis, "thesis", MethodOutput::clip,
     "Weber 2020 as implemented: six bands on fixed sines, and transients"},
    {Method::decomposition, "decomposition", MethodOutput::clip,
     "Weber 2020 as proposed: tracked partials, events, and bands of noise"},
    {Method::envelopeSine, "envelope-sine", MethodOutput::clip, "the envelope of the sound on a sine of 80 Hz"},
    {Method::envelopeCentroid, "envelope-centroid", MethodOutput::clip,
     "the envelope of the sound on a sine that follows the spectral centroid"},
    {Method::vocoder16, "vocoder16", MethodOutput::clip,
     "the envelopes of sixteen third octaves from 200 Hz up, all on a sine of 100 Hz"},
    {Method::centroidFlatness, "centroid-flatness", MethodOutput::clip,
     "the centroid as a pitch of 40 to 400 Hz, tonality as a fade from sine to square wave"},
    {Method::modulation, "modulation", MethodOutput::clip,
     "the envelopes of four ranges of hearing, 100 Hz to 8 kHz, on sines of 60 to 400 Hz"},
    {Method::lowpass, "lowpass", MethodOutput::signal, "the sound below 1 kHz, unchanged"},
    {Method::pitchShift, "pitch-shift", MethodOutput::signal, "the sound two octaves lower, with its length unchanged"},
    {Method::hapticGen, "hapticgen", MethodOutput::signal,
     "Sung 2025: the level on a sine of 200 Hz whose frequency rises with the level"},
    {Method::frequencyShift, "freqshift", MethodOutput::signal,
     "Okazaki 2015: the sound and copies one and two octaves lower, 125 to 375 Hz"},
    {Method::percept, "percept", MethodOutput::signal,
     "Lee and Choi 2013: loudness and roughness, reproduced by two beating sines"},
    {Method::pitchMatch, "pitchmatch", MethodOutput::signal,
     "Kim 2024: loudness on a sine that follows the pitch heard"},
}};

/// The entry of a method.
[[nodiscard]] constexpr const MethodInfo& methodInfo(Method method) noexcept
{
    return methodTable[static_cast<std::size_t>(method)];
}

/// The method of this exact name, if there is one.
[[nodiscard]] constexpr std::optional<Method> methodNamed(std::string_view name) noexcept
{
    for (const MethodInfo& info : methodTable)
        if (info.name == name)
            return info.method;
    return std::nullopt;
}

/// Parameters of the methods other than a2vt; unset values are the method's own. methodParameters describes them.
struct MethodChoices
{
    std::optional<double> breakpoints; ///< per second of active time and curve; for decomposition as for a2vt
    std::optional<std::size_t> bands;
    std::optional<double> lowFrequency;  ///< Hz, of the first band
    std::optional<double> highFrequency; ///< Hz, of the last band
    std::optional<int> quantise;         ///< bits

    // Envelope follower, see EnvelopeFollowerParams.
    std::optional<double> attack;  ///< s
    std::optional<double> hold;    ///< s
    std::optional<double> release; ///< s
    std::optional<bool> crestAdaptive;
    std::optional<double> crestMemory; ///< s

    // Limits of the sound before it is analysed, see BandLimitParams.
    std::optional<double> lowLimit;  ///< Hz
    std::optional<double> highLimit; ///< Hz

    // Transients of the thesis, see TransientDetectorParams.
    std::optional<double> minimumGap; ///< s
    std::optional<double> transientThreshold;
    std::optional<double> transientAmplitude; ///< linear
    bool operator==(const MethodChoices&) const = default;
};

/// Description of a choice, and the methods that have it.
struct MethodParameter : Parameter<MethodChoices>
{
    unsigned methods = 0; ///< bit n: Method n
};

namespace detail
{

[[nodiscard]] constexpr unsigned methodSet(std::initializer_list<Method> methods) noexcept
{
    unsigned set = 0;
    for (const Method method : methods)
        set |= 1u << static_cast<unsigned>(method);
    return set;
}

inline constexpr unsigned thesisOnly = methodSet({Method::thesis});
inline constexpr unsigned withFollower = methodSet({Method::thesis, Method::envelopeSine, Method::envelopeCentroid,
                                                    Method::vocoder16, Method::centroidFlatness, Method::modulation});
inline constexpr unsigned withCurves = withFollower | methodSet({Method::decomposition});

} // namespace detail

/// Descriptions of all user settings of MethodChoices. Settings shared with a2vt use its descriptions, with other
/// defaults.
inline constexpr std::array methodParameters{
    MethodParameter{describedAs<&MethodChoices::bands>(parameterNamed(encoderParameters, "bands")), detail::thesisOnly},
    MethodParameter{describedAs<&MethodChoices::breakpoints>(parameterNamed(encoderParameters, "breakpoints")),
                    detail::withCurves},
    MethodParameter{describedAs<&MethodChoices::quantise>(parameterNamed(encoderParameters, "quantise")),
                    detail::thesisOnly},
    MethodParameter{describedAs<&MethodChoices::lowFrequency>(parameterNamed(encoderParameters, "low")),
                    detail::thesisOnly},
    MethodParameter{describedAs<&MethodChoices::highFrequency>(parameterNamed(encoderParameters, "high")),
                    detail::thesisOnly},
    MethodParameter{describedAs<&MethodChoices::minimumGap>(parameterNamed(encoderParameters, "minimumGap")),
                    detail::thesisOnly},
    MethodParameter{described<&MethodChoices::attack>({.name = "attack",
                                                       .text = "Attack of the envelope follower",
                                                       .unit = "s",
                                                       .range = {0, 10},
                                                       .usualText = "the method's own",
                                                       .group = "Other methods"}),
                    detail::withFollower},
    MethodParameter{described<&MethodChoices::hold>({.name = "hold",
                                                     .text = "Hold time of the envelope follower",
                                                     .unit = "s",
                                                     .range = {0, 10},
                                                     .usualText = "the method's own",
                                                     .group = "Other methods"}),
                    detail::withFollower},
    MethodParameter{described<&MethodChoices::release>({.name = "release",
                                                        .text = "Release of the envelope follower",
                                                        .unit = "s",
                                                        .range = {0, 10},
                                                        .usualText = "the method's own",
                                                        .group = "Other methods"}),
                    detail::withFollower},
    MethodParameter{
        described<&MethodChoices::crestAdaptive>(
            {.name = "crestAdaptive",
             .text = "Shorten attack and release by the crest factor of the sound; the given times are the longest",
             .usualText = "the method's own",
             .group = "Other methods"}),
        detail::withFollower},
    MethodParameter{described<&MethodChoices::crestMemory>(
                        {.name = "crestMemory",
                         .text = "Time constant of the averages of which the crest factor is computed",
                         .unit = "s",
                         .range = {0.001, 10},
                         .usualText = "the method's own",
                         .group = "Other methods"}),
                    detail::withFollower},
    MethodParameter{described<&MethodChoices::lowLimit>({.name = "lowLimit",
                                                         .text = "High-pass before the analysis; 0 switches it off",
                                                         .unit = "Hz",
                                                         .range = {0, 1000},
                                                         .usualText = "the method's own",
                                                         .group = "Other methods"}),
                    detail::withFollower},
    MethodParameter{described<&MethodChoices::highLimit>(
                        {.name = "highLimit",
                         .text = "Low-pass before the analysis; near half the sample rate and above it is off",
                         .unit = "Hz",
                         .range = {10, 384000},
                         .usualText = "the method's own",
                         .group = "Other methods"}),
                    detail::withFollower},
    MethodParameter{described<&MethodChoices::transientThreshold>(
                        {.name = "transientThreshold",
                         .text = "Threshold for transients: difference of a fast and a slow envelope",
                         .range = {0, 10},
                         .usualText = "the method's own",
                         .group = "Other methods"}),
                    detail::thesisOnly},
    MethodParameter{described<&MethodChoices::transientAmplitude>({.name = "transientAmplitude",
                                                                   .text = "Peak below which transients are dropped",
                                                                   .range = {0, 1},
                                                                   .usualText = "the method's own",
                                                                   .group = "Other methods"}),
                    detail::thesisOnly},
};

/// Whether users can set the parameter of this name for a method.
[[nodiscard]] constexpr bool hasParameter(Method method, std::string_view name) noexcept
{
    if (method == Method::a2vt)
    {
        for (const auto& parameter : encoderParameters)
            if (parameter.name == name)
                return true;
        return false;
    }
    for (const MethodParameter& parameter : methodParameters)
        if (parameter.name == name)
            return (parameter.methods >> static_cast<unsigned>(method) & 1u) != 0;
    return false;
}

/// All parameters of translations, those of a2vt first.
[[nodiscard]] inline std::vector<const ParameterInfo*> translationParameters()
{
    std::vector<const ParameterInfo*> all;
    for (const auto& parameter : encoderParameters)
        all.push_back(&parameter);
    for (const MethodParameter& parameter : methodParameters)
        if (!hasParameter(Method::a2vt, parameter.name))
            all.push_back(&parameter);
    return all;
}

/// Parameters of the translation of a sound.
struct TranslationParams
{
    Method method = Method::a2vt;
    EncoderParams params;  ///< of a2vt
    MethodChoices choices; ///< of the other methods
    bool operator==(const TranslationParams&) const = default;
};

/// Sets the parameter of this name. Errors: invalidArgument for one that the method does not have, or a value that is
/// not allowed.
[[nodiscard]] inline Result<void> setParameter(TranslationParams& translation, const ParameterInfo& wanted,
                                               double value)
{
    if (!hasParameter(translation.method, wanted.name))
        return Error{ErrorCode::invalidArgument, std::string(wanted.name),
                     "is no option of the method " + std::string(methodInfo(translation.method).name) +
                         "; leave it out"};
    if (auto allowed = checkValue(wanted, value); !allowed)
        return allowed;
    if (translation.method == Method::a2vt)
        parameterNamed(encoderParameters, wanted.name).set(translation.params, value);
    else
        parameterNamed(methodParameters, wanted.name).set(translation.choices, value);
    return {};
}

/// Value of a parameter that the method has; NaN where the method has its own.
[[nodiscard]] inline double valueOf(const TranslationParams& translation, const ParameterInfo& wanted)
{
    return translation.method == Method::a2vt ? parameterNamed(encoderParameters, wanted.name).get(translation.params)
                                              : parameterNamed(methodParameters, wanted.name).get(translation.choices);
}

/// Checks the ranges of all that is set.
[[nodiscard]] inline Result<void> validate(const TranslationParams& translation)
{
    if (auto valid = validate(translation.params); !valid)
        return valid;
    if (auto valid = checkParameters(methodParameters, translation.choices); !valid)
        return valid;
    const EncoderParams usual; // the ends are those of the thesis too
    const double low = translation.choices.lowFrequency.value_or(usual.lowFrequency);
    const double high = translation.choices.highFrequency.value_or(usual.highFrequency);
    if (!(low < high))
        return Error{ErrorCode::invalidArgument, "low", "must be lower than high"};
    // The methods' own are 5 Hz and 1800 Hz or more, which no other end that is allowed contradicts.
    if (translation.choices.lowLimit && translation.choices.highLimit &&
        !(*translation.choices.lowLimit < *translation.choices.highLimit))
        return Error{ErrorCode::invalidArgument, "lowLimit", "must be below the high limit, or nothing is left"};
    return {};
}

} // namespace pacini
