#pragma once

// The translation "envelope-centroid": the level of the sound on a sine that follows its brightness.

#include <pacini/analysis/SpectralCentroid.h>
#include <pacini/analysis/methods/MethodClip.h>
#include <pacini/analysis/methods/MethodCurves.h>
#include <pacini/analysis/methods/MethodSound.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Units.h>

#include <cmath>
#include <span>

namespace pacini
{

/// Parameters of "envelope-centroid". `lowest` is clamped to 1 Hz and above, `highest` to 0.45 of the sample rate and
/// below, and to no less than `lowest`.
struct EnvelopeCentroidParams
{
    BandLimitParams range;
    MethodCurveParams curves;
    Hertz lowest{20.0};    ///< the sine stays between here ...
    Hertz highest{1000.0}; ///< ... and here, where skin feels vibration
    bool operator==(const EnvelopeCentroidParams&) const = default;
};

/// The thesis's model with a single band: the envelope of the sound, and its spectral centroid as the pitch of the
/// carrier (Weber 2020, section 4.3.3). `mono` may have any length, fs is 8000 to 768000 Hz.
[[nodiscard]] inline Clip envelopeCentroidClip(std::span<const float> mono, double fs,
                                               const EnvelopeCentroidParams& params = {})
{
    const MethodSound sound = prepareSound(mono, fs, params.range);
    const double low = clampTo(params.lowest.value, 1.0, 0.45 * fs);
    const double high = clampTo(params.highest.value, low, 0.45 * fs);
    Clip clip = startMethodClip("envelope-centroid", sound, params.curves);
    clip.encoder.push_back({"lowFrequency", low});
    clip.encoder.push_back({"highFrequency", high});

    Band band{low, clampTo(std::sqrt(low * high), low, high), high, 0, {}, {}};
    band.amplitude = methodCurve(envelopeTrack(sound, params.curves), sound, params.curves);
    if (!band.amplitude.empty())
    {
        SpectralCentroidParams centroid;
        centroid.frames = powerOfTwoFrames(fs);
        Curve pitch = spectralCentroid(sound.samples, fs, centroid);
        for (Breakpoint& point : pitch)
            point.value = clampTo(point.value, low, high);
        band.pitch = methodCurve(pitch, sound, params.curves);
    }
    clip.bands.push_back(band);
    return clip;
}

} // namespace pacini
