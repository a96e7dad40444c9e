#pragma once

// Live parameters of the translator.

#include <pacini/foundation/Clamp.h>

#include <cmath>
#include <initializer_list>

namespace pacini
{

/// Live parameters of one role (rumble, texture, transients). One part of what is felt.
struct RoleParams
{
    double level = 0.0; ///< dB, -60 to 24
    bool muted = false;
    bool operator==(const RoleParams&) const = default;
};

inline constexpr double lowestBrightness = -60.0; ///< dB, which is off

/// Live parameters of the translator. Values outside their ranges are clamped, those that are not finite ignored (see
/// clamped()). Every change is smoothed: gains move within about 20 ms, pitches glide.
struct TranslatorParams
{
    double inputGain = 0.0;     ///< dB, -60 to 48: what the analysis sees
    double intensity = 0.0;     ///< dB, -60 to 24: gain of the drive
    RoleParams rumble{};        ///< bands with centres below 100 Hz
    RoleParams texture{};       ///< the other bands
    RoleParams transients{};    ///< events: pulses that top what the bands give them
    double brightness = -6.0;   ///< dB, -60 (off) to 12: of what is too high for the skin, felt as a tone of 200 Hz
    double audible = 0.0;       ///< 0 to 1: how far loudness drives what is heard above the range of touch; music
                                ///< keeps its beat at 0
    double transposition = 0.0; ///< semitones, -48 to 48; other than 0 everything is played by carriers
    double direct = 1.0;        ///< 0 to 1: share of a band's own signal where the actuator can show it, against its
                                ///< carrier
    double attack = 1.0;        ///< ms, 0 to 200: of the carriers' envelopes
    double release = 8.0;       ///< ms, 0 to 1000: of the carriers' envelopes
    double transientSensitivity = 0.5; ///< 0 to 1; each tenth is 3 dB of how far an event must stand out
    double transientSharpness = 0.0;   ///< -1 (dull, 100 Hz) to 1 (crisp, 280 Hz), added to the event's own
    double gateThreshold = -75.0;      ///< dBFS of the full-band peak, -120 to 0; below it nothing is played
    double gateRelease = 60.0;         ///< ms, 1 to 2000
    bool bypass = false;               ///< the input itself, as late as the drive
    bool operator==(const TranslatorParams&) const = default;
};

/// `p` within its ranges. Where a value is not finite, that of `before`, which has valid ones, stays.
[[nodiscard]] inline TranslatorParams clamped(TranslatorParams p, const TranslatorParams& before = {}) noexcept
{
    const auto limit = [](double& value, double low, double high, double otherwise)
    {
        value = std::isfinite(value) ? clampTo(value, low, high) : otherwise;
    };
    for (RoleParams TranslatorParams::*role :
         {&TranslatorParams::rumble, &TranslatorParams::texture, &TranslatorParams::transients})
        limit((p.*role).level, -60.0, 24.0, (before.*role).level);
    limit(p.inputGain, -60.0, 48.0, before.inputGain);
    limit(p.intensity, -60.0, 24.0, before.intensity);
    limit(p.brightness, lowestBrightness, 12.0, before.brightness);
    limit(p.audible, 0.0, 1.0, before.audible);
    limit(p.transposition, -48.0, 48.0, before.transposition);
    limit(p.direct, 0.0, 1.0, before.direct);
    limit(p.attack, 0.0, 200.0, before.attack);
    limit(p.release, 0.0, 1000.0, before.release);
    limit(p.transientSensitivity, 0.0, 1.0, before.transientSensitivity);
    limit(p.transientSharpness, -1.0, 1.0, before.transientSharpness);
    limit(p.gateThreshold, -120.0, 0.0, before.gateThreshold);
    limit(p.gateRelease, 1.0, 2000.0, before.gateRelease);
    return p;
}

} // namespace pacini
