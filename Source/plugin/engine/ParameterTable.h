// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Table of the plugin's parameters: ids, names, units, ranges, defaults of everything that can be automated.

#include <pacini/actuator/Profile.h>
#include <pacini/actuator/Strength.h>
#include <pacini/realtime/TranslatorParams.h>

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace pacini::plugin
{

/// Indices of the parameters in parameterTable. Hosts know parameters by their text ids, so the order may change.
enum class ParameterId : std::size_t
{
    source,
    sourceMix,
    outputMode,
    outputChannel,
    profile,
    inputGain,
    intensity,
    rumbleLevel,
    rumbleMute,
    textureLevel,
    textureMute,
    transientLevel,
    transientMute,
    brightness,
    transposition,
    direct,
    attack,
    release,
    transientSensitivity,
    transientSharpness,
    gateThreshold,
    gateRelease,
    bypass,
    audible,
    speech,
    strength,
    pan,
    position,
    panLaw,
    places,
    outputCount,
    firstChannel, ///< see channelParameter()
    count = firstChannel + 31
};

inline constexpr std::size_t parameterCount = static_cast<std::size_t>(ParameterId::count);

inline constexpr std::size_t maxHapticChannels = 8;

/// Parameters of each haptic channel.
enum class ChannelSetting : std::size_t
{
    actuator,
    gain,
    delay,
    place
};

/// The parameter of a haptic channel, counted from 0. The actuator of the first one is that of the plugin.
[[nodiscard]] constexpr ParameterId channelParameter(std::size_t channel, ChannelSetting setting) noexcept
{
    const std::size_t at = 4 * channel + static_cast<std::size_t>(setting);
    return at == 0 ? ParameterId::profile
                   : static_cast<ParameterId>(static_cast<std::size_t>(ParameterId::firstChannel) + at - 1);
}

enum class ParameterUnit
{
    decibels,
    semitones,
    milliseconds,
    percent, ///< the value itself is a share: 0.5 is 50 %
    number,  ///< a whole one
    choice,  ///< the index of one of `choices`
    toggle   ///< 0 or 1
};

enum class SourceChoice
{
    main,
    sidechain,
    mix
};

/// Content of the main output. The haptic output always carries the drive.
enum class OutputMode
{
    separate,      ///< the sound as it came
    replaceMain,   ///< the drive on every channel
    rightHaptic,   ///< channel 2 is the drive, the others as they came
    monoAndHaptic, ///< channel 1 is the mean of all channels, channel 2 the drive
    addToChannel   ///< the drives are added to a channel and, for further haptic channels, those behind it
};

/// Parameters of panning over the haptic channels.
enum class PanChoice
{
    off,      ///< every channel carries all of it
    position, ///< the parameter `position`
    panorama  ///< where the sound is between its first two channels
};

/// Places for profiles: automation names them by number, so numbers never change their meaning and new profiles take
/// free ones.
inline constexpr std::size_t profileSlots = 32;
inline constexpr std::size_t ownProfileSlot = profileSlots - 1;

inline constexpr std::array<std::string_view, 3> sourceChoices{"Main", "Sidechain", "Mix"};
inline constexpr std::array<std::string_view, 5> outputModeChoices{
    "Sound (haptic output separate)", "Haptic replaces sound", "Sound left, haptic right",
    "Mono sound left, haptic right", "Haptic added to one channel"};
/// The host's text for a slot without a profile, which plays as flat as slot 0. The plugin's own lists hide such slots.
inline constexpr std::string_view noActuator = "No actuator (flat)";
[[nodiscard]] constexpr bool hasNoActuator(std::string_view choice) noexcept
{
    return choice.starts_with(noActuator);
}

/// The short names of the shipped profiles, for hosts that ask before any profile is read (a test compares them).
// clang-format off
inline constexpr std::array<std::string_view, profileSlots> profileChoices{
    "Flat drive", "L5 wristband", "L5 test jig", "LRA 175 Hz",
    "LRA 235 Hz", "Coin ERM", "Piezo", "iPhone (Taptic)",
    "Quest controller", "DualSense", "Joy-Con", "Wideband exciter",
    "Electroactive polymer", "Phone (ERM)", "Phone (coin LRA)", "Phone (bar LRA)",
    "Phone (voice coil)", "Phone (piezo)", "Bass shaker", "Seat shaker",
    "No actuator (flat) 20", "No actuator (flat) 21", "No actuator (flat) 22", "No actuator (flat) 23",
    "No actuator (flat) 24", "No actuator (flat) 25", "No actuator (flat) 26", "No actuator (flat) 27",
    "No actuator (flat) 28", "No actuator (flat) 29", "No actuator (flat) 30", "From file"};
// clang-format on

inline constexpr std::array<std::string_view, 3> panChoices{"Off", "Position", "Sound panorama"};
inline constexpr std::array<std::string_view, 3> panLawChoices{"Level", "Delay", "Level and delay"};
inline constexpr std::array<std::string_view, 2> placesChoices{"Evenly spaced", "Custom"};
/// Choices of the channels after the first: its actuator, or that of a slot, one number higher.
inline constexpr auto furtherProfileChoices = []
{
    std::array<std::string_view, profileSlots + 1> choices{"Same as channel 1"};
    for (std::size_t i = 0; i < profileSlots; ++i)
        choices[i + 1] = profileChoices[i];
    return choices;
}();

struct ParameterRow
{
    ParameterId parameter;
    const char* id; ///< for ever: sessions keep it
    int since;      ///< version hint: the release that brought it, counted from 1
    const char* name;
    ParameterUnit unit;
    double low, high, standard;
    double centre; ///< the value in the middle of a control's way; 0: the mean of low and high
    std::span<const std::string_view> choices;
    const char* help;
};

// A table.
// clang-format off
inline constexpr std::array<ParameterRow, parameterCount> parameterTable{{
    {ParameterId::source, "source", 1, "Source", ParameterUnit::choice, 0, 2, 0, 0, sourceChoices,
     "Source of the haptic signal: main input, sidechain or both"},
    {ParameterId::sourceMix, "sourceMix", 1, "Source mix", ParameterUnit::percent, 0, 1, 0.5, 0, {},
     "Balance of the Mix source: 0 % main only, 50 % both in full, 100 % sidechain only"},
    {ParameterId::outputMode, "outputMode", 1, "Main output", ParameterUnit::choice, 0, 4, 0, 0, outputModeChoices,
     "Signal on the main output, for hosts with a single output per effect"},
    {ParameterId::outputChannel, "outputChannel", 1, "Haptic channel", ParameterUnit::number, 1, 16, 4, 0, {},
     "Main output channel the haptic signal is added to (the first of several)"},
    {ParameterId::profile, "profile", 1, "Actuator", ParameterUnit::choice, 0, profileSlots - 1, 0, 0, profileChoices,
     "Actuator the signal is made for"},
    {ParameterId::inputGain, "inputGain", 1, "Input gain", ParameterUnit::decibels, -60, 48, 0, 0, {},
     "Gain of the sound before analysis"},
    {ParameterId::intensity, "intensity", 1, "Intensity", ParameterUnit::decibels, -60, 24, 0, -6, {},
     "Gain of the haptic signal"},
    {ParameterId::rumbleLevel, "rumbleLevel", 1, "Rumble", ParameterUnit::decibels, -60, 24, 0, -6, {},
     "Level of the haptic signal below 100 Hz"},
    {ParameterId::rumbleMute, "rumbleMute", 1, "Rumble mute", ParameterUnit::toggle, 0, 1, 0, 0, {},
     "Mutes the haptic signal below 100 Hz"},
    {ParameterId::textureLevel, "textureLevel", 1, "Texture", ParameterUnit::decibels, -60, 24, 0, -6, {},
     "Level of the haptic signal above 100 Hz"},
    {ParameterId::textureMute, "textureMute", 1, "Texture mute", ParameterUnit::toggle, 0, 1, 0, 0, {},
     "Mutes the haptic signal above 100 Hz"},
    {ParameterId::transientLevel, "transientLevel", 1, "Transients", ParameterUnit::decibels, -60, 24, 0, -6, {},
     "Level of the pulses added at transients"},
    {ParameterId::transientMute, "transientMute", 1, "Transients mute", ParameterUnit::toggle, 0, 1, 0, 0, {},
     "Mutes the pulses"},
    {ParameterId::brightness, "brightness", 1, "Brightness", ParameterUnit::decibels, -60, 12, -6, -12, {},
     "Level of sound above the range of touch, played as a 200 Hz tone; -60 dB is off"},
    {ParameterId::transposition, "transposition", 1, "Transposition", ParameterUnit::semitones, -48, 48, 0, 0, {},
     "Shifts the haptic signal up or down in pitch"},
    {ParameterId::direct, "direct", 1, "Direct", ParameterUnit::percent, 0, 1, 1, 0, {},
     "Share of the original waveform, where the actuator can reproduce it, versus sinusoids"},
    {ParameterId::attack, "attack", 1, "Attack", ParameterUnit::milliseconds, 0, 200, 1, 20, {},
     "Rise time of the sinusoids"},
    {ParameterId::release, "release", 1, "Release", ParameterUnit::milliseconds, 0, 1000, 8, 100, {},
     "Fall time of the sinusoids"},
    {ParameterId::transientSensitivity, "transientSensitivity", 1, "Transient sensitivity",
     ParameterUnit::percent, 0, 1, 0.5, 0, {},
     "Transient sensitivity; higher values also give weaker hits a pulse"},
    {ParameterId::transientSharpness, "transientSharpness", 1, "Sharpness", ParameterUnit::percent, -1, 1, 0, 0, {},
     "Makes the pulses duller or crisper"},
    {ParameterId::gateThreshold, "gateThreshold", 1, "Gate", ParameterUnit::decibels, -120, 0, -75, 0, {},
     "Silences the signal below this level"},
    {ParameterId::gateRelease, "gateRelease", 1, "Gate release", ParameterUnit::milliseconds, 1, 2000, 60, 200, {},
     "Time that the gate stays open below the threshold"},
    {ParameterId::bypass, "bypass", 1, "Bypass", ParameterUnit::toggle, 0, 1, 0, 0, {},
     "Passes the sound through without a haptic signal"},
    {ParameterId::audible, "audible", 2, "Audible", ParameterUnit::percent, 0, 1, 1, 0, {},
     "Amount of sound above the range of touch that is felt: hi-hats, rain, ticks"},
    {ParameterId::speech, "speech", 4, "Speech", ParameterUnit::percent, 0, 1, 1, 0, {},
     "Amount of speech that is felt; below 100 %, what sounds like speech is turned down above 75 Hz"},
    {ParameterId::strength, "strength", 2, "Strength", ParameterUnit::percent, 0, 1, standardStrength, 0, {},
     "Fidelity versus strength: 0 % is as faithful as possible, 100 % plays everything at the actuator's resonance"},
    {ParameterId::pan, "pan", 3, "Pan", ParameterUnit::choice, 0, 2, 0, 0, panChoices,
     "Control that pans the signal across the haptic channels; off: each channel carries the whole signal"},
    {ParameterId::position, "position", 3, "Position", ParameterUnit::percent, 0, 1, 0.5, 0, {},
     "Position between the first and the last actuator, with pan set to Position"},
    {ParameterId::panLaw, "panLaw", 3, "Pan law", ParameterUnit::choice, 0, 2, 0, 0, panLawChoices,
     "Pans by level, by delay (10 ms from end to end) or both"},
    {ParameterId::places, "places", 3, "Places", ParameterUnit::choice, 0, 1, 0, 0, placesChoices,
     "Actuator positions: evenly spaced in order, or set per channel"},
    {ParameterId::outputCount, "outputCount", 3, "Added channels", ParameterUnit::number, 1, maxHapticChannels, 1, 0, {},
     "Number of haptic channels added to the main output, starting at the haptic channel"},
    {channelParameter(0, ChannelSetting::gain), "gain1", 3, "Gain 1", ParameterUnit::decibels, -60, 0, 0, -12, {},
     "Gain of haptic channel 1, after its actuator's protection"},
    {channelParameter(0, ChannelSetting::delay), "delay1", 3, "Delay 1", ParameterUnit::milliseconds, 0, 100, 0, 20, {},
     "Delay of haptic channel 1, to align actuators"},
    {channelParameter(0, ChannelSetting::place), "place1", 3, "Place 1", ParameterUnit::percent, 0, 1, 0.0, 0, {},
     "Position of haptic channel 1, with places set to Custom"},
    {channelParameter(1, ChannelSetting::actuator), "actuator2", 3, "Actuator 2", ParameterUnit::choice, 0, profileSlots, 0, 0,
     furtherProfileChoices, "Actuator of haptic channel 2"},
    {channelParameter(1, ChannelSetting::gain), "gain2", 3, "Gain 2", ParameterUnit::decibels, -60, 0, 0, -12, {},
     "Gain of haptic channel 2, after its actuator's protection"},
    {channelParameter(1, ChannelSetting::delay), "delay2", 3, "Delay 2", ParameterUnit::milliseconds, 0, 100, 0, 20, {},
     "Delay of haptic channel 2, to align actuators"},
    {channelParameter(1, ChannelSetting::place), "place2", 3, "Place 2", ParameterUnit::percent, 0, 1, 0.1429, 0, {},
     "Position of haptic channel 2, with places set to Custom"},
    {channelParameter(2, ChannelSetting::actuator), "actuator3", 3, "Actuator 3", ParameterUnit::choice, 0, profileSlots, 0, 0,
     furtherProfileChoices, "Actuator of haptic channel 3"},
    {channelParameter(2, ChannelSetting::gain), "gain3", 3, "Gain 3", ParameterUnit::decibels, -60, 0, 0, -12, {},
     "Gain of haptic channel 3, after its actuator's protection"},
    {channelParameter(2, ChannelSetting::delay), "delay3", 3, "Delay 3", ParameterUnit::milliseconds, 0, 100, 0, 20, {},
     "Delay of haptic channel 3, to align actuators"},
    {channelParameter(2, ChannelSetting::place), "place3", 3, "Place 3", ParameterUnit::percent, 0, 1, 0.2857, 0, {},
     "Position of haptic channel 3, with places set to Custom"},
    {channelParameter(3, ChannelSetting::actuator), "actuator4", 3, "Actuator 4", ParameterUnit::choice, 0, profileSlots, 0, 0,
     furtherProfileChoices, "Actuator of haptic channel 4"},
    {channelParameter(3, ChannelSetting::gain), "gain4", 3, "Gain 4", ParameterUnit::decibels, -60, 0, 0, -12, {},
     "Gain of haptic channel 4, after its actuator's protection"},
    {channelParameter(3, ChannelSetting::delay), "delay4", 3, "Delay 4", ParameterUnit::milliseconds, 0, 100, 0, 20, {},
     "Delay of haptic channel 4, to align actuators"},
    {channelParameter(3, ChannelSetting::place), "place4", 3, "Place 4", ParameterUnit::percent, 0, 1, 0.4286, 0, {},
     "Position of haptic channel 4, with places set to Custom"},
    {channelParameter(4, ChannelSetting::actuator), "actuator5", 3, "Actuator 5", ParameterUnit::choice, 0, profileSlots, 0, 0,
     furtherProfileChoices, "Actuator of haptic channel 5"},
    {channelParameter(4, ChannelSetting::gain), "gain5", 3, "Gain 5", ParameterUnit::decibels, -60, 0, 0, -12, {},
     "Gain of haptic channel 5, after its actuator's protection"},
    {channelParameter(4, ChannelSetting::delay), "delay5", 3, "Delay 5", ParameterUnit::milliseconds, 0, 100, 0, 20, {},
     "Delay of haptic channel 5, to align actuators"},
    {channelParameter(4, ChannelSetting::place), "place5", 3, "Place 5", ParameterUnit::percent, 0, 1, 0.5714, 0, {},
     "Position of haptic channel 5, with places set to Custom"},
    {channelParameter(5, ChannelSetting::actuator), "actuator6", 3, "Actuator 6", ParameterUnit::choice, 0, profileSlots, 0, 0,
     furtherProfileChoices, "Actuator of haptic channel 6"},
    {channelParameter(5, ChannelSetting::gain), "gain6", 3, "Gain 6", ParameterUnit::decibels, -60, 0, 0, -12, {},
     "Gain of haptic channel 6, after its actuator's protection"},
    {channelParameter(5, ChannelSetting::delay), "delay6", 3, "Delay 6", ParameterUnit::milliseconds, 0, 100, 0, 20, {},
     "Delay of haptic channel 6, to align actuators"},
    {channelParameter(5, ChannelSetting::place), "place6", 3, "Place 6", ParameterUnit::percent, 0, 1, 0.7143, 0, {},
     "Position of haptic channel 6, with places set to Custom"},
    {channelParameter(6, ChannelSetting::actuator), "actuator7", 3, "Actuator 7", ParameterUnit::choice, 0, profileSlots, 0, 0,
     furtherProfileChoices, "Actuator of haptic channel 7"},
    {channelParameter(6, ChannelSetting::gain), "gain7", 3, "Gain 7", ParameterUnit::decibels, -60, 0, 0, -12, {},
     "Gain of haptic channel 7, after its actuator's protection"},
    {channelParameter(6, ChannelSetting::delay), "delay7", 3, "Delay 7", ParameterUnit::milliseconds, 0, 100, 0, 20, {},
     "Delay of haptic channel 7, to align actuators"},
    {channelParameter(6, ChannelSetting::place), "place7", 3, "Place 7", ParameterUnit::percent, 0, 1, 0.8571, 0, {},
     "Position of haptic channel 7, with places set to Custom"},
    {channelParameter(7, ChannelSetting::actuator), "actuator8", 3, "Actuator 8", ParameterUnit::choice, 0, profileSlots, 0, 0,
     furtherProfileChoices, "Actuator of haptic channel 8"},
    {channelParameter(7, ChannelSetting::gain), "gain8", 3, "Gain 8", ParameterUnit::decibels, -60, 0, 0, -12, {},
     "Gain of haptic channel 8, after its actuator's protection"},
    {channelParameter(7, ChannelSetting::delay), "delay8", 3, "Delay 8", ParameterUnit::milliseconds, 0, 100, 0, 20, {},
     "Delay of haptic channel 8, to align actuators"},
    {channelParameter(7, ChannelSetting::place), "place8", 3, "Place 8", ParameterUnit::percent, 0, 1, 1.0, 0, {},
     "Position of haptic channel 8, with places set to Custom"},
}};
// clang-format on

[[nodiscard]] constexpr const ParameterRow& rowOf(ParameterId parameter) noexcept
{
    return parameterTable[static_cast<std::size_t>(parameter)];
}

/// Whether every row is at the index of its enumerator.
[[nodiscard]] constexpr bool isInOrder() noexcept
{
    for (std::size_t i = 0; i < parameterCount; ++i)
        if (static_cast<std::size_t>(parameterTable[i].parameter) != i)
            return false;
    return true;
}
static_assert(isInOrder());

/// The id of the row of a live parameter, by the name that translatorParameters gives it.
[[nodiscard]] constexpr std::string_view idOfTranslator(std::string_view name) noexcept
{
    constexpr std::array<std::array<std::string_view, 2>, 6> otherNames{{{"rumble", "rumbleLevel"},
                                                                         {"rumbleMuted", "rumbleMute"},
                                                                         {"texture", "textureLevel"},
                                                                         {"textureMuted", "textureMute"},
                                                                         {"transients", "transientLevel"},
                                                                         {"transientsMuted", "transientMute"}}};
    for (const auto& [own, other] : otherNames)
        if (own == name)
            return other;
    return name;
}

/// Whether a row is a live parameter of the translator, which presets set.
[[nodiscard]] constexpr bool isOfTranslator(const ParameterRow& row) noexcept
{
    for (const auto& parameter : translatorParameters)
        if (idOfTranslator(parameter.name) == row.id)
            return true;
    return false;
}

/// Whether the rows of live parameters have the ranges and defaults that translatorParameters describes.
[[nodiscard]] constexpr bool agreesWithTranslator() noexcept
{
    for (const auto& parameter : translatorParameters)
    {
        const std::string_view id = idOfTranslator(parameter.name);
        std::size_t i = 0;
        while (i < parameterCount && id != parameterTable[i].id)
            ++i;
        if (i == parameterCount || parameterTable[i].low != parameter.range.lowest ||
            parameterTable[i].high != parameter.range.highest || parameterTable[i].standard != parameter.usual())
            return false;
    }
    return true;
}
static_assert(agreesWithTranslator());

/// Whether only whole values count.
[[nodiscard]] constexpr bool isDiscrete(const ParameterRow& row) noexcept
{
    return row.unit == ParameterUnit::choice || row.unit == ParameterUnit::toggle || row.unit == ParameterUnit::number;
}

} // namespace pacini::plugin
