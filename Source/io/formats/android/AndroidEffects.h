#pragma once

// Conversion of clips to the vibration effects of Android, and back.

#include "io/formats/LossList.h"

#include <pacini/foundation/Result.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace pacini
{

/// VibrationEffect.createWaveform (API 26): steps of constant amplitude.
struct AndroidStep
{
    std::int64_t duration = 0; ///< ms, above 0
    int amplitude = 0;         ///< 0 (motor off) to 255
    bool operator==(const AndroidStep&) const = default;
};

/// A control point of an envelope effect (API 36): the effect moves to it in a straight line within `duration`.
struct AndroidPoint
{
    std::int64_t duration = 0; ///< ms, above 0
    double amplitude = 0.0;    ///< 0 to 1; `intensity` in a basic envelope
    double frequency = 0.0;    ///< Hz; `sharpness` of 0 to 1 in a basic envelope
    bool operator==(const AndroidPoint&) const = default;
};

struct AndroidEnvelope
{
    double initialFrequency = 0.0; ///< Hz or sharpness; the amplitude starts at 0
    std::vector<AndroidPoint> points;
    bool operator==(const AndroidEnvelope&) const = default;
};

/// The three forms of a clip as a vibration effect, from the oldest.
struct AndroidEffects
{
    std::vector<AndroidStep> waveform;
    AndroidEnvelope basic;    ///< intensity and sharpness, of BasicEnvelopeBuilder
    AndroidEnvelope envelope; ///< amplitude and Hz, of WaveformEnvelopeBuilder
    bool operator==(const AndroidEffects&) const = default;
};

/// Frequency of the sinusoid for an amplitude without frequency, Hz: that of a phone's resonant actuator.
inline constexpr double androidMotorFrequency = 150.0;

/// `time` in s as whole ms, and back.
[[nodiscard]] inline std::int64_t androidTick(double time)
{
    return std::llround(time * 1000.0);
}

[[nodiscard]] inline double androidTime(std::int64_t tick)
{
    return static_cast<double>(tick) / 1000.0;
}

struct AndroidExport
{
    AndroidEffects effects;
    LossList losses;
};

/// The effects of a valid clip:
///
/// - the waveform has no 0 within a texture, where it would stop the motor: silence shorter than 50 ms is 1 of 255;
///   events are bursts of 20 ms; steps last at least 10 ms beside them;
/// - the sharpness of basic envelopes covers the profile's range or else sharpnessRange: Android leaves it to the
/// device;
/// - envelopes start and end at 0, every segment lasts 1 ms to 1 s, which all devices can play; segments of less than
///   20 ms, which some cannot, and more than 16 points, which Android may split, are named in the losses. Events are
///   peaks as long as the decoder's pulse, at its frequency.
///
/// `amplitudePoints` per second (100 steps, 60 control points where it is not given) are the most; with
/// `params.envelope` the envelopes keep those limits (see fittedNodes). Errors: those of fittedNodes().
[[nodiscard]] Result<AndroidExport> androidEffectsOf(const Clip& clip, const ExportParams& params);

struct AndroidEnvelopeExport
{
    AndroidEnvelope envelope;
    LossList losses;
};

/// One envelope alone, basic or not, with as few control points as say the same; otherwise as androidEffectsOf(). A
/// clip of one voice keeps its points unless limits or a density are asked for.
[[nodiscard]] Result<AndroidEnvelopeExport> androidEnvelopeOf(const Clip& clip, const ExportParams& params,
                                                              bool isBasic);

/// The clip of a waveform: steps at androidMotorFrequency.
[[nodiscard]] Clip clipOfWaveform(const std::vector<AndroidStep>& steps);

/// The clip of an envelope; a basic one has its sharpness as frequency by sharpnessRange.
[[nodiscard]] Clip clipOfEnvelope(const AndroidEnvelope& envelope, bool isBasic);

} // namespace pacini
