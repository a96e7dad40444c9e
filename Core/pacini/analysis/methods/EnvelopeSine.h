#pragma once

// The translation "envelope-sine": the level of the sound on one sine.

#include <pacini/analysis/methods/MethodClip.h>
#include <pacini/analysis/methods/MethodCurves.h>
#include <pacini/analysis/methods/MethodSound.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Units.h>

#include <span>

namespace pacini
{

/// Parameters of "envelope-sine".
struct EnvelopeSineParams
{
    BandLimitParams range;
    MethodCurveParams curves;
    Hertz frequency{80.0}; ///< of the sine, clamped to 1 Hz to 0.45 of the sample rate
    bool operator==(const EnvelopeSineParams&) const = default;
};

/// An envelope follower that modulates a signal generator, as it has been used for whole-body vibration in a concert
/// seat (Weber 2020, section 1.3): one band whose pitch never moves. Nothing of the spectrum survives. `mono` may have
/// any length, fs is 8000 to 768000 Hz.
[[nodiscard]] inline Clip envelopeSineClip(std::span<const float> mono, double fs,
                                           const EnvelopeSineParams& params = {})
{
    const MethodSound sound = prepareSound(mono, fs, params.range);
    Clip clip = startMethodClip("envelope-sine", sound, params.curves);
    const double f = clampTo(params.frequency.value, 1.0, 0.45 * fs);
    clip.encoder.push_back({"frequency", f});
    clip.bands.push_back({f, f, f, 0, methodCurve(envelopeTrack(sound, params.curves), sound, params.curves), {}});
    return clip;
}

} // namespace pacini
