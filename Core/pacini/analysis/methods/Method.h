#pragma once

// The translation methods that Pacini can compare, by name.

#include <pacini/analysis/methods/CentroidFlatness.h>
#include <pacini/analysis/methods/Decomposition.h>
#include <pacini/analysis/methods/EnvelopeCentroid.h>
#include <pacini/analysis/methods/EnvelopeSine.h>
#include <pacini/analysis/methods/FrequencyShift.h>
#include <pacini/analysis/methods/HapticGen.h>
#include <pacini/analysis/methods/MethodChoices.h>
#include <pacini/analysis/methods/Modulation.h>
#include <pacini/analysis/methods/PerceptTranslation.h>
#include <pacini/analysis/methods/PitchMatch.h>
#include <pacini/analysis/methods/PitchShift.h>
#include <pacini/analysis/methods/ThesisMethod.h>
#include <pacini/analysis/methods/ThirdOctaveVocoder.h>
#include <pacini/analysis/methods/ZeroPhaseLowpass.h>
#include <pacini/clip/Clip.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace pacini
{

namespace detail
{

/// Visits each field of a method's parameters with the choice that it can be set by.
template <typename Params, typename Choices, typename Visit>
void pairWithChoices(Params& params, Choices& choices, Visit visit)
{
    if constexpr (std::is_same_v<std::remove_const_t<Params>, DecompositionParams>)
        visit(params.breakpoints, choices.breakpoints);
    else
    {
        visit(params.curves.breakpoints, choices.breakpoints);
        visit(params.curves.follower.attack, choices.attack);
        visit(params.curves.follower.hold, choices.hold);
        visit(params.curves.follower.release, choices.release);
        visit(params.curves.follower.crestAdaptive, choices.crestAdaptive);
        visit(params.curves.follower.crestMemory, choices.crestMemory);
        visit(params.range.low, choices.lowLimit);
        visit(params.range.high, choices.highLimit);
    }
    if constexpr (std::is_same_v<std::remove_const_t<Params>, ThesisMethodParams>)
    {
        visit(params.layout.bands, choices.bands);
        visit(params.layout.low, choices.lowFrequency);
        visit(params.layout.high, choices.highFrequency);
        visit(params.quantise, choices.quantise);
        visit(params.transients.minimumDistance, choices.minimumGap);
        visit(params.transients.threshold, choices.transientThreshold);
        visit(params.transients.minimumAmplitude, choices.transientAmplitude);
    }
}

/// `params` with the choices applied.
template <typename Params>
[[nodiscard]] Params withChoices(Params params, const MethodChoices& choices)
{
    pairWithChoices(params, choices,
                    [](auto& value, const auto& choice)
                    {
                        if (choice)
                            value = std::remove_reference_t<decltype(value)>(*choice);
                    });
    return params;
}

/// The values of `params`.
template <typename Params>
[[nodiscard]] MethodChoices choicesIn(const Params& params)
{
    MethodChoices choices;
    pairWithChoices(params, choices, [](const auto& value, auto& choice) { assignNumber(choice, numberOf(value)); });
    return choices;
}

/// Adds the choices to the record of a clip that its method does not name itself.
inline void recordChoices(Clip& clip, Method method, const MethodChoices& choices)
{
    for (const MethodParameter& parameter : methodParameters)
    {
        const double value = parameter.get(choices);
        const bool known = std::any_of(clip.encoder.begin(), clip.encoder.end(),
                                       [&](const EncoderParameter& one) { return one.name == parameter.name; });
        if (std::isnan(value) || known || !hasParameter(method, parameter.name))
            continue;
        if (parameter.kind == ParameterKind::truth)
            clip.encoder.push_back({std::string(parameter.name), value != 0.0});
        else
            clip.encoder.push_back({std::string(parameter.name), value});
    }
}

} // namespace detail

/// The clip that a method makes of a mono sound of any length at 8000 to 768000 Hz: valid, of the sound's duration,
/// with `name` and `source` left to the caller. Only for methods whose output is a clip, and not for a2vt, which takes
/// several channels as a stream (see Encoder): others are the caller's error (asserted) and give an empty clip.
[[nodiscard]] inline Clip translateToClip(Method method, std::span<const float> mono, double fs,
                                          const MethodChoices& choices = {})
{
    const auto recorded = [&](Clip clip)
    {
        detail::recordChoices(clip, method, choices);
        return clip;
    };
    switch (method)
    {
    case Method::thesis:
        return recorded(thesisClip(mono, fs, detail::withChoices(ThesisMethodParams{}, choices)));
    case Method::decomposition:
        return decompositionClip(mono, fs, detail::withChoices(DecompositionParams{}, choices));
    case Method::envelopeSine:
        return recorded(envelopeSineClip(mono, fs, detail::withChoices(EnvelopeSineParams{}, choices)));
    case Method::envelopeCentroid:
        return recorded(envelopeCentroidClip(mono, fs, detail::withChoices(EnvelopeCentroidParams{}, choices)));
    case Method::vocoder16:
        return recorded(thirdOctaveVocoderClip(mono, fs, detail::withChoices(ThirdOctaveVocoderParams{}, choices)));
    case Method::centroidFlatness:
        return recorded(centroidFlatnessClip(mono, fs, detail::withChoices(CentroidFlatnessParams{}, choices)));
    case Method::modulation:
        return recorded(modulationClip(mono, fs, detail::withChoices(ModulationParams{}, choices)));
    case Method::a2vt:
    case Method::lowpass:
    case Method::pitchShift:
    case Method::hapticGen:
    case Method::frequencyShift:
    case Method::percept:
    case Method::pitchMatch:
        break;
    }
    assert(false && "this method does not make a clip");
    return {};
}

/// The choices that a method makes where nothing else is chosen; none for methods that have none, and for a2vt.
[[nodiscard]] inline MethodChoices usualChoices(Method method)
{
    switch (method)
    {
    case Method::thesis:
        return detail::choicesIn(ThesisMethodParams{});
    case Method::decomposition:
        return detail::choicesIn(DecompositionParams{});
    case Method::envelopeSine:
        return detail::choicesIn(EnvelopeSineParams{});
    case Method::envelopeCentroid:
        return detail::choicesIn(EnvelopeCentroidParams{});
    case Method::vocoder16:
        return detail::choicesIn(ThirdOctaveVocoderParams{});
    case Method::centroidFlatness:
        return detail::choicesIn(CentroidFlatnessParams{});
    case Method::modulation:
        return detail::choicesIn(ModulationParams{});
    default:
        return {};
    }
}

/// Returns the drive signal of a method for a mono sound, with the length and rate of the sound. Only for methods whose
/// output is a signal: others are the caller's error (asserted) and give silence.
[[nodiscard]] inline std::vector<float> translateToSignal(Method method, std::span<const float> mono, double fs)
{
    switch (method)
    {
    case Method::lowpass:
        return zeroPhaseLowpass(mono, fs);
    case Method::pitchShift:
        return pitchShift(mono, fs);
    case Method::hapticGen:
        return hapticGen(mono, fs);
    case Method::frequencyShift:
        return frequencyShift(mono, fs);
    case Method::percept:
        return perceptTranslation(mono, fs);
    case Method::pitchMatch:
        return pitchMatch(mono, fs);
    case Method::a2vt:
    case Method::thesis:
    case Method::decomposition:
    case Method::envelopeSine:
    case Method::envelopeCentroid:
    case Method::vocoder16:
    case Method::centroidFlatness:
    case Method::modulation:
        break;
    }
    assert(false && "this method does not make a signal");
    return std::vector<float>(mono.size());
}

} // namespace pacini
