#pragma once

// Live parameters of the translator and their description.

#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Description.h>

#include <array>
#include <cmath>

namespace pacini
{

/// Live parameters of one role: rumble, texture or transients.
struct RoleParams
{
    double level = 0.0; ///< dB
    bool muted = false;
    bool operator==(const RoleParams&) const = default;
};

inline constexpr double lowestBrightness = -60.0; ///< dB, which is off

/// Live parameters of the translator; translatorParameters describes them. Values outside their ranges are clamped,
/// those that are not finite ignored (see clamped()). Every change is smoothed: gains move within about 20 ms, pitches
/// glide.
struct TranslatorParams
{
    double inputGain = 0.0;            ///< dB
    double intensity = 0.0;            ///< dB
    RoleParams rumble{};               ///< bands with centres below 100 Hz
    RoleParams texture{};              ///< the other bands
    RoleParams transients{};           ///< events: pulses that top what the bands give them
    double brightness = -6.0;          ///< dB
    double audible = 1.0;              ///< share
    double speech = 1.0;               ///< share
    double transposition = 0.0;        ///< semitones; other than 0 everything is played by carriers
    double direct = 1.0;               ///< share
    double attack = 1.0;               ///< ms
    double release = 8.0;              ///< ms
    double transientSensitivity = 0.5; ///< share; each tenth is 3 dB of how far an event must stand out
    double transientSharpness = 0.0;   ///< added to the event's own
    double gateThreshold = -75.0;      ///< dBFS of the full-band peak
    double gateRelease = 60.0;         ///< ms
    bool bypass = false;
    bool operator==(const TranslatorParams&) const = default;
};

/// Descriptions of all of TranslatorParams, by their names in Python (with `_`) and JavaScript.
inline constexpr std::array translatorParameters{
    described<&TranslatorParams::inputGain>(
        {.name = "inputGain", .text = "Gain of the sound before analysis", .unit = "dB", .range = {-60, 48}}),
    described<&TranslatorParams::intensity>(
        {.name = "intensity", .text = "Gain of the drive", .unit = "dB", .range = {-60, 24}}),
    described<&TranslatorParams::brightness>(
        {.name = "brightness",
         .text =
             "Level of sound above 320 Hz, played as a tone of 200 Hz as far as `audible` is below 1; the lowest value "
             "switches it off",
         .unit = "dB",
         .range = {lowestBrightness, 12}}),
    described<&TranslatorParams::audible>({.name = "audible",
                                           .text = "Amount of sound above the range of touch that is felt in addition "
                                                   "to the low part (hi-hats, rain, ticks); 0: none",
                                           .range = {0, 1}}),
    described<&TranslatorParams::speech>({.name = "speech",
                                          .text = "Amount of speech that is felt; below 1, what sounds like speech is "
                                                  "turned down above 75 Hz",
                                          .range = {0, 1}}),
    described<&TranslatorParams::transposition>(
        {.name = "transposition", .text = "Shift in pitch", .unit = "semitones", .range = {-48, 48}}),
    described<&TranslatorParams::direct>(
        {.name = "direct",
         .text = "Share of the band's own signal against its carrier, where the actuator can reproduce it",
         .range = {0, 1}}),
    described<&TranslatorParams::attack>(
        {.name = "attack", .text = "Attack of the carriers' envelopes", .unit = "ms", .range = {0, 200}}),
    described<&TranslatorParams::release>(
        {.name = "release", .text = "Release of the carriers' envelopes", .unit = "ms", .range = {0, 1000}}),
    described<&TranslatorParams::transientSensitivity>(
        {.name = "transientSensitivity",
         .text = "Sensitivity to events; higher values also turn weaker events into pulses",
         .range = {0, 1}}),
    described<&TranslatorParams::transientSharpness>(
        {.name = "transientSharpness",
         .text = "Shift in the sharpness of pulses, from duller (-1, 100 Hz) to crisper (1, 280 Hz)",
         .range = {-1, 1}}),
    described<&TranslatorParams::gateThreshold>(
        {.name = "gateThreshold", .text = "Level below which the gate closes", .unit = "dB", .range = {-120, 0}}),
    described<&TranslatorParams::gateRelease>({.name = "gateRelease",
                                               .text = "Time that the gate stays open below the threshold",
                                               .unit = "ms",
                                               .range = {1, 2000}}),
    described<&TranslatorParams::rumble, &RoleParams::level>(
        {.name = "rumble", .text = "Level of bands below 100 Hz", .unit = "dB", .range = {-60, 24}}),
    described<&TranslatorParams::rumble, &RoleParams::muted>(
        {.name = "rumbleMuted", .text = "Mute the bands below 100 Hz"}),
    described<&TranslatorParams::texture, &RoleParams::level>(
        {.name = "texture", .text = "Level of the other bands", .unit = "dB", .range = {-60, 24}}),
    described<&TranslatorParams::texture, &RoleParams::muted>({.name = "textureMuted", .text = "Mute the other bands"}),
    described<&TranslatorParams::transients, &RoleParams::level>(
        {.name = "transients", .text = "Level of the pulses of events", .unit = "dB", .range = {-60, 24}}),
    described<&TranslatorParams::transients, &RoleParams::muted>(
        {.name = "transientsMuted", .text = "Mute the pulses of events"}),
    described<&TranslatorParams::bypass>(
        {.name = "bypass", .text = "Pass the input through, delayed by the latency of the translator"}),
};

/// `p` within its ranges. Where a value is not finite, that of `before`, which has valid ones, stays.
[[nodiscard]] inline TranslatorParams clamped(TranslatorParams p, const TranslatorParams& before = {}) noexcept
{
    for (const auto& parameter : translatorParameters)
    {
        const double value = parameter.get(p);
        parameter.set(p, std::isfinite(value) ? clampTo(value, parameter.range.lowest, parameter.range.highest)
                                              : parameter.get(before));
    }
    return p;
}

} // namespace pacini
