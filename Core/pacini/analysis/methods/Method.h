#pragma once

// The translation methods that Pacini can compare, by name.

#include <pacini/analysis/methods/CentroidFlatness.h>
#include <pacini/analysis/methods/Decomposition.h>
#include <pacini/analysis/methods/EnvelopeCentroid.h>
#include <pacini/analysis/methods/EnvelopeSine.h>
#include <pacini/analysis/methods/FrequencyShift.h>
#include <pacini/analysis/methods/HapticGen.h>
#include <pacini/analysis/methods/PerceptTranslation.h>
#include <pacini/analysis/methods/PitchMatch.h>
#include <pacini/analysis/methods/PitchShift.h>
#include <pacini/analysis/methods/ThesisMethod.h>
#include <pacini/analysis/methods/ThirdOctaveVocoder.h>
#include <pacini/analysis/methods/ZeroPhaseLowpass.h>
#include <pacini/clip/Clip.h>

#include <array>
#include <cassert>
#include <cstddef>
#include <optional>
#include <span>
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
    lowpass,
    pitchShift,
    hapticGen,
    frequencyShift,
    percept,
    pitchMatch,
};

/// What a translation method makes: clips or samples.
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
inline constexpr std::array<MethodInfo, 13> methodTable{{
    {Method::a2vt, "a2vt", MethodOutput::clip, "Pacini's own: band envelopes and pitches at the best price per point"},
    {Method::thesis, "thesis", MethodOutput::clip, "Weber 2020, literally: six bands on fixed sines, and transients"},
    {Method::decomposition, "decomposition", MethodOutput::clip,
     "Weber 2020, its full proposal: tracked partials, events, and bands of noise"},
    {Method::envelopeSine, "envelope-sine", MethodOutput::clip, "the envelope of the sound on a sine of 80 Hz"},
    {Method::envelopeCentroid, "envelope-centroid", MethodOutput::clip,
     "the envelope of the sound on a sine that follows the spectral centroid"},
    {Method::vocoder16, "vocoder16", MethodOutput::clip,
     "the envelopes of sixteen third octaves from 200 Hz up, all on 100 Hz"},
    {Method::centroidFlatness, "centroid-flatness", MethodOutput::clip,
     "the centroid as a pitch of 40 to 400 Hz, tonality as a fade from sine to square wave"},
    {Method::lowpass, "lowpass", MethodOutput::signal, "the sound below 1 kHz, as it is"},
    {Method::pitchShift, "pitch-shift", MethodOutput::signal, "the sound two octaves lower, as long as it was"},
    {Method::hapticGen, "hapticgen", MethodOutput::signal,
     "Sung 2025: the level on a sine of 200 Hz that rises with it"},
    {Method::frequencyShift, "freqshift", MethodOutput::signal,
     "Okazaki 2015: the sound and copies one and two octaves lower, 125 to 375 Hz"},
    {Method::percept, "percept", MethodOutput::signal,
     "Lee and Choi 2013: loudness and roughness as those of two sines that beat"},
    {Method::pitchMatch, "pitchmatch", MethodOutput::signal,
     "Kim 2024: loudness on a sine whose pitch follows the ear's"},
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

/// Options that only some methods have, by their names on the command line without the dashes before them.
inline constexpr std::array<std::string_view, 9> tunedOptions{
    "bands", "breakpoints", "quantise", "low", "high", "spacing", "audible", "sensitivity", "keep-level"};

/// Whether a method has one of `tunedOptions`; names in Python have `_` for `-`.
[[nodiscard]] constexpr bool hasOption(const MethodInfo& method, std::string_view option) noexcept
{
    if (method.method == Method::a2vt)
        return true;
    if (method.method == Method::thesis)
        return option == "bands" || option == "breakpoints" || option == "quantise" || option == "low" ||
               option == "high";
    return method.output == MethodOutput::clip && option == "breakpoints";
}

/// Choices that methods share; what is left out is the method's own. Values are clamped as the methods say.
struct MethodChoices
{
    std::optional<double> breakpoints;   ///< per second of active time and curve: all methods that make a clip;
                                         ///< for decomposition as for a2vt no more than that
    std::optional<std::size_t> bands;    ///< thesis
    std::optional<double> lowFrequency;  ///< Hz, of the first band: thesis
    std::optional<double> highFrequency; ///< Hz, of the last band: thesis
    std::optional<int> quantise;         ///< bits: thesis
    bool operator==(const MethodChoices&) const = default;
};

/// The clip that a method makes of a mono sound of any length at 8000 to 768000 Hz: valid, of the sound's duration,
/// with `name` and `source` left to the caller. Only for methods whose output is a clip, and not for a2vt, which takes
/// several channels as a stream (see Encoder): others are the caller's error (asserted) and give an empty clip.
[[nodiscard]] inline Clip translateToClip(Method method, std::span<const float> mono, double fs,
                                          const MethodChoices& choices = {})
{
    const auto withBreakpoints = [&choices](auto params)
    {
        params.curves.breakpoints = choices.breakpoints.value_or(params.curves.breakpoints);
        return params;
    };
    switch (method)
    {
    case Method::thesis:
    {
        auto params = withBreakpoints(ThesisMethodParams{});
        params.layout.bands = choices.bands.value_or(params.layout.bands);
        params.layout.low = Hertz(choices.lowFrequency.value_or(params.layout.low.value));
        params.layout.high = Hertz(choices.highFrequency.value_or(params.layout.high.value));
        params.quantise = choices.quantise.value_or(params.quantise);
        return thesisClip(mono, fs, params);
    }
    case Method::decomposition:
    {
        DecompositionParams params;
        params.breakpoints = choices.breakpoints.value_or(params.breakpoints);
        return decompositionClip(mono, fs, params);
    }
    case Method::envelopeSine:
        return envelopeSineClip(mono, fs, withBreakpoints(EnvelopeSineParams{}));
    case Method::envelopeCentroid:
        return envelopeCentroidClip(mono, fs, withBreakpoints(EnvelopeCentroidParams{}));
    case Method::vocoder16:
        return thirdOctaveVocoderClip(mono, fs, withBreakpoints(ThirdOctaveVocoderParams{}));
    case Method::centroidFlatness:
        return centroidFlatnessClip(mono, fs, withBreakpoints(CentroidFlatnessParams{}));
    case Method::a2vt:
    case Method::lowpass:
    case Method::pitchShift:
    case Method::hapticGen:
    case Method::frequencyShift:
    case Method::percept:
    case Method::pitchMatch:
        break;
    }
    assert(false && "no clip is made here by this method");
    return {};
}

/// The drive signal that a method makes of a mono sound, as long as the sound and at its rate. Only for methods whose
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
        break;
    }
    assert(false && "no signal is made by this method");
    return std::vector<float>(mono.size());
}

} // namespace pacini
