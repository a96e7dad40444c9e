#pragma once

// What can be turned while the translator runs.

#include <pacini/foundation/Clamp.h>

#include <algorithm>

namespace pacini
{

/// One part of what is felt.
struct RoleParams
{
    double level = 0.0; ///< dB, -60 to 24
    bool muted = false;
    bool operator==(const RoleParams&) const = default;
};

/// Values outside their ranges are clamped, NaN to the lower end (see clamped()). Every change is smoothed: gains move
/// within about 20 ms, pitches glide.
struct TranslatorParams
{
    double inputGain = 0.0;     ///< dB, -60 to 48: what the analysis sees
    double intensity = 0.0;     ///< dB, -60 to 24: gain of the drive
    RoleParams rumble{};        ///< bands with centres below 100 Hz
    RoleParams texture{};       ///< the other bands
    RoleParams transients{};    ///< events: pulses that top what the bands give them
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

[[nodiscard]] inline TranslatorParams clamped(TranslatorParams p) noexcept
{
    for (RoleParams* role : {&p.rumble, &p.texture, &p.transients})
        role->level = clampTo(role->level, -60.0, 24.0);
    p.inputGain = clampTo(p.inputGain, -60.0, 48.0);
    p.intensity = clampTo(p.intensity, -60.0, 24.0);
    p.transposition = clampTo(p.transposition, -48.0, 48.0);
    p.direct = clampTo(p.direct, 0.0, 1.0);
    p.attack = clampTo(p.attack, 0.0, 200.0);
    p.release = clampTo(p.release, 0.0, 1000.0);
    p.transientSensitivity = clampTo(p.transientSensitivity, 0.0, 1.0);
    p.transientSharpness = clampTo(p.transientSharpness, -1.0, 1.0);
    p.gateThreshold = clampTo(p.gateThreshold, -120.0, 0.0);
    p.gateRelease = clampTo(p.gateRelease, 1.0, 2000.0);
    return p;
}

} // namespace pacini
