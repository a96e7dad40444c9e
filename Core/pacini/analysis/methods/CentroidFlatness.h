#pragma once

// The translation "centroid-flatness": brightness becomes pitch, tonality becomes harmonics, loudness stays loudness.

#include <pacini/analysis/PowerSpectra.h>
#include <pacini/analysis/SpectralCentroid.h>
#include <pacini/analysis/methods/MethodClip.h>
#include <pacini/analysis/methods/MethodCurves.h>
#include <pacini/analysis/methods/MethodSound.h>
#include <pacini/clip/Curve.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// The geometric mean of a power spectrum over its arithmetic mean (J. D. Johnston, "Transform coding of audio signals
/// using perceptual noise criteria", IEEE JSAC 6 (1988)): 1 for a flat spectrum, 0 when a bin is empty or for no bins.
[[nodiscard]] inline double flatnessOf(std::span<const double> power) noexcept
{
    double sum = 0.0;
    double logarithms = 0.0;
    for (const double p : power)
    {
        sum += p;
        logarithms += std::log(p); // minus infinity for an empty bin: the result is then 0, as it should be
    }
    if (!(sum > 0.0))
        return 0.0;
    const auto count = static_cast<double>(power.size());
    return std::exp(logarithms / count) / (sum / count);
}

/// Parameters of the spectral flatness.
struct SpectralFlatnessParams
{
    FrameParams frames;
    Hertz low{0.0};                                      ///< bins from here ...
    Hertz high{std::numeric_limits<double>::infinity()}; ///< ... to here count
    bool operator==(const SpectralFlatnessParams&) const = default;
};

/// The flatness (0 to 1) at the middle of every frame over the bins within low..high, without those at 0 Hz and at half
/// the sample rate; fs in Hz. White noise has exp(-0.5772) = 0.561, a sinusoid nearly 0, a click 1 where the window
/// holds nothing else; silence and a range without bins have 0. Empty for an empty signal.
[[nodiscard]] inline Curve spectralFlatness(std::span<const float> signal, double fs,
                                            const SpectralFlatnessParams& params = {})
{
    const FrameGrid grid(params.frames, fs);
    Curve curve(grid.count(signal.size()));
    forEachPowerSpectrum(signal, grid,
                         [&](std::size_t m, std::span<const double> power)
                         {
                             std::size_t first = 1;
                             std::size_t last = power.size() - 1; // exclusive
                             while (first < last && grid.frequency(static_cast<double>(first)) < params.low.value)
                                 ++first;
                             while (last > first && grid.frequency(static_cast<double>(last - 1)) > params.high.value)
                                 --last;
                             const auto part = first < last ? power.subspan(first, last - first) : power.first(0);
                             curve[m] = {grid.time(m), flatnessOf(part)};
                         });
    return curve;
}

/// Parameters of "centroid-flatness". A low frequency is clamped to 1 Hz to 0.2 of the sample rate, a high one from
/// there to 0.45 of it, both at least an octave apart; centroids may lie above that.
struct CentroidFlatnessParams
{
    BandLimitParams range{Hertz(5.0), Hertz(std::numeric_limits<double>::infinity())};
    MethodCurveParams curves;
    Hertz lowCentroid{100.0};  ///< is felt as lowPitch; flatness is that of the spectrum from here ...
    Hertz highCentroid{10e3};  ///< ... to here or 0.45 of the sample rate; this is felt as highPitch
    Hertz lowPitch{40.0};      ///< of the thesis
    Hertz highPitch{400.0};    ///< of the thesis
    Hertz highestPartial{1e3}; ///< harmonics fade out over the tenth below, since skin feels nothing above
    bool operator==(const CentroidFlatnessParams&) const = default;
};

/// Returns the tonality of a frame of this spectral flatness, 0 (noise) to 1 (flatness -60 dB or less): the coefficient
/// of tonality of J. D. Johnston, "Transform coding of audio signals using perceptual noise criteria", IEEE JSAC 6
/// (1988).
[[nodiscard]] inline double tonalityOf(double flatness) noexcept
{
    return clampTo(Decibels::fromPower(flatness).value / -60.0, 0.0, 1.0);
}

namespace detail
{

inline constexpr std::array<double, 4> squarePartials{1.0, 3.0, 5.0, 7.0};

/// Amplitudes of the partials of an equal-power cross-fade from a sine (tonality 0) to a square wave (1). The two share
/// their fundamental, so the plain gains cos and sin would be 2.8 dB too loud half way; the sum is therefore brought to
/// the power of a sine of amplitude 1, also without the partials that `weights` (0-1) takes away.
[[nodiscard]] inline std::array<double, 4> sineToSquare(double tonality, const std::array<double, 4>& weights) noexcept
{
    const double squareGain = std::sin(0.5 * std::numbers::pi * tonality);
    const double sineGain = std::cos(0.5 * std::numbers::pi * tonality);
    std::array<double, 4> amplitudes{};
    double power = 0.0;
    for (std::size_t i = 0; i < amplitudes.size(); ++i)
    {
        // Of a square wave with the power of a sine of amplitude 1.
        const double partial = 4.0 / std::numbers::pi / std::numbers::sqrt2 / squarePartials[i];
        amplitudes[i] = weights[i] * (squareGain * partial + (i == 0 ? sineGain : 0.0));
        power += amplitudes[i] * amplitudes[i];
    }
    for (double& a : amplitudes)
        a /= std::sqrt(power);
    return amplitudes;
}

} // namespace detail

/// The mapping of timbre to touch that the thesis reviews (Weber 2020, section 1.3; made for an electroacoustic
/// instrument): the spectral centroid on a logarithmic scale sets the pitch, 40 to 400 Hz; the flatness cross-fades at
/// equal power between a sine (noise) and a square wave (tones); the envelope, whose decay is the follower's release,
/// is the amplitude. The square wave is made of its partials 1, 3, 5 and 7, one band each. They have one pitch curve,
/// so a player whose carriers start together keeps them in phase. `mono` may have any length, fs is 8000 to 768000 Hz.
[[nodiscard]] inline Clip centroidFlatnessClip(std::span<const float> mono, double fs,
                                               const CentroidFlatnessParams& params = {})
{
    const double lowCentroid = clampTo(params.lowCentroid.value, 1.0, 1e5);
    const double highCentroid = clampTo(params.highCentroid.value, 2.0 * lowCentroid, 1e6);
    const double lowPitch = clampTo(params.lowPitch.value, 1.0, 0.2 * fs);
    const double highPitch = clampTo(params.highPitch.value, 2.0 * lowPitch, 0.45 * fs);
    const double limit = clampTo(params.highestPartial.value, highPitch, 0.45 * fs);

    const MethodSound sound = prepareSound(mono, fs, params.range);
    Clip clip = startMethodClip("centroid-flatness", sound, params.curves);
    clip.encoder.push_back({"lowPitch", lowPitch});
    clip.encoder.push_back({"highPitch", highPitch});

    SpectralCentroidParams centroid;
    centroid.frames = powerOfTwoFrames(fs);
    Curve pitch = spectralCentroid(sound.samples, fs, centroid);
    for (Breakpoint& point : pitch)
    {
        const double position = std::log(std::max(point.value, lowCentroid) / lowCentroid);
        point.value =
            lowPitch * std::pow(highPitch / lowPitch, std::min(1.0, position / std::log(highCentroid / lowCentroid)));
    }
    pitch = methodCurve(pitch, sound, params.curves);
    const Curve flatness = spectralFlatness(
        sound.samples, fs, {centroid.frames, Hertz(lowCentroid), Hertz(std::min(highCentroid, 0.45 * fs))});

    std::array<Curve, 4> tracks;
    CurveReader pitches(pitch);
    CurveReader flatnesses(flatness);
    for (const Breakpoint& point : envelopeTrack(sound, params.curves))
    {
        const double f = pitches.at(point.time);
        std::array<double, 4> weights{1.0};
        for (std::size_t i = 1; i < weights.size(); ++i)
            weights[i] = clampTo((limit - f * detail::squarePartials[i]) / (0.1 * limit), 0.0, 1.0);
        const auto amplitudes = detail::sineToSquare(tonalityOf(flatnesses.at(point.time)), weights);
        for (std::size_t i = 0; i < tracks.size(); ++i)
            tracks[i].push_back({point.time, point.value * amplitudes[i]});
    }

    for (std::size_t i = 0; i < tracks.size(); ++i)
    {
        const double partial = detail::squarePartials[i];
        const double low = lowPitch * partial;
        const double high = std::max(low, std::min(highPitch * partial, limit));
        Band band{low, clampTo(std::sqrt(low * high), low, high),    high,
                  0,   methodCurve(tracks[i], sound, params.curves), {}};
        if (!band.amplitude.empty())
            for (const Breakpoint& point : pitch)
                band.pitch.push_back({point.time, point.value * partial});
        clip.bands.push_back(std::move(band));
    }
    rankByEnergy(clip);
    return clip;
}

} // namespace pacini
