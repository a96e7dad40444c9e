#pragma once

// Curve building that the translation methods share: dense tracks, then few breakpoints.

#include <pacini/analysis/EnvelopeFollower.h>
#include <pacini/analysis/PowerSpectra.h>
#include <pacini/analysis/methods/MethodSound.h>
#include <pacini/clip/Curve.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>
#include <pacini/simplify/KeptPoints.h>
#include <pacini/simplify/Visvalingam.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace pacini
{

/// Parameters of the curves of translation methods.
struct MethodCurveParams
{
    EnvelopeFollowerParams follower{
        .attack = Seconds(0.002), .hold = Seconds(0.010), .release = Seconds(0.030)}; ///< of every envelope
    Hertz trackRate{1000.0};   ///< envelopes are sampled this often before they are simplified; 1 Hz and above
    double breakpoints = 20.0; ///< per second of active time and curve, at least 2 in all; clamped to 0-1000
    bool operator==(const MethodCurveParams&) const = default;
};

[[nodiscard]] inline double clampedBreakpoints(const MethodCurveParams& params) noexcept
{
    return clampTo(params.breakpoints, 0.0, 1000.0);
}

/// Follows the envelope of a signal and keeps it at the track rate.
class EnvelopeTrack
{
public:
    EnvelopeTrack(const MethodCurveParams& params, double sampleRate)
        : fs(sampleRate),
          stride(static_cast<std::size_t>(
              std::max(1.0, std::floor(sampleRate / std::max(1.0, params.trackRate.value) + 0.5))))
    {
        follower.setParams(params.follower);
        follower.prepare({sampleRate, MethodSound::longestPart});
    }

    /// Takes the next samples.
    void push(std::span<const float> in)
    {
        for (const float sample : in)
        {
            const double envelope = follower.tick(finiteOrZero(sample));
            if (untilNext == 0)
            {
                dense.push_back({static_cast<double>(frame) / fs, envelope});
                untilNext = stride;
            }
            --untilNext;
            ++frame;
        }
        follower.flush();
    }

    /// The track so far.
    [[nodiscard]] Curve& curve() noexcept { return dense; }

private:
    double fs;
    std::size_t stride;
    EnvelopeFollower follower;
    Curve dense;
    std::size_t frame = 0;
    std::size_t untilNext = 0;
};

/// The envelope of a whole sound as a dense track.
[[nodiscard]] inline Curve envelopeTrack(const MethodSound& sound, const MethodCurveParams& params)
{
    EnvelopeTrack track(params, sound.fs);
    track.push(sound.samples);
    return std::move(track.curve());
}

/// Frames of the power of two of samples that is nearest (in ratio) to 46 ms, a quarter apart.
[[nodiscard]] inline FrameParams powerOfTwoFrames(double fs) noexcept
{
    const double window = std::exp2(std::round(std::log2(FrameParams{}.window.value * fs)));
    return {Seconds(window / fs), Seconds(window / 4.0 / fs)};
}

/// A dense track as a curve of the clip: Visvalingam and Whyatt's simplification (the thesis's) to the number of points
/// that the sound's active time allows; then nothing after the end of the sound, where the frames of spectra reach. A
/// track that is 0 throughout gives an empty curve.
[[nodiscard]] inline Curve methodCurve(const Curve& dense, const MethodSound& sound, const MethodCurveParams& params)
{
    if (std::all_of(dense.begin(), dense.end(), [](const Breakpoint& p) { return p.value == 0.0; }))
        return {};
    const double allowed = clampedBreakpoints(params) * sound.active.value;
    const auto points = static_cast<std::size_t>(std::max(2.0, std::floor(allowed + 0.5)));
    Curve curve = curveOf(dense, visvalingamToCount(dense, points));
    const Breakpoint last{sound.duration.value, valueAt(curve, sound.duration.value)};
    if (curve.back().time > last.time)
    {
        while (!curve.empty() && curve.back().time >= last.time)
            curve.pop_back();
        curve.push_back(last);
    }
    return curve;
}

} // namespace pacini
