#pragma once

// The translation "decomposition": partials from the harmonic part of a sound, events from the percussive one, bands of
// noise from the rest.

#include <pacini/analysis/AnalysisInput.h>
#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/ClipFitter.h>
#include <pacini/analysis/Encoder.h>
#include <pacini/analysis/HarmonicPercussive.h>
#include <pacini/analysis/OnsetDetector.h>
#include <pacini/analysis/OnsetFeatures.h>
#include <pacini/analysis/OnsetMeasure.h>
#include <pacini/analysis/OnsetParams.h>
#include <pacini/analysis/PartialBands.h>
#include <pacini/analysis/PartialTracking.h>
#include <pacini/analysis/ResidualNoise.h>
#include <pacini/analysis/methods/MethodClip.h>
#include <pacini/analysis/methods/MethodSound.h>
#include <pacini/clip/BandTiling.h>
#include <pacini/clip/Clip.h>
#include <pacini/clip/Quantiser.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// Parameters of "decomposition".
struct DecompositionParams
{
    SeparationParams separation;
    PartialTrackingParams partials; ///< of the harmonic part; its hop is BandAnalysisResult::bandStep, whatever it says
    OnsetParams onsets;             ///< of the percussive part
    std::size_t bands = 12;         ///< that partials are put in, over their range; clamped to 1-32
    std::size_t noiseBands = 6;     ///< over the same range; clamped to 0-32
    double breakpoints = 20.0;      ///< at most this many per second of sound and band, clamped to 0.5-1000
    int quantise = 6;               ///< bits of the grids, clamped to 4-16

    /// Whether bands of noise carry all that is not harmonic. Pacini's way: a pulse only tops up what the rest of a
    /// clip reaches (see pulseLevel), so the rest must reach it. Else they carry R = S - (H + P) alone (Weber 2020,
    /// Eq. 4.2).
    bool percussiveNoise = true;
    bool operator==(const DecompositionParams&) const = default;
};

namespace detail
{

/// A sound and its parts at analysisRate, as far as touch reaches, and the events of its percussive part.
struct DecomposedSound
{
    std::vector<float> sound, harmonic, percussive;
    std::vector<Onset> onsets;
};

/// Decimates to analysisRate, piece by piece.
class PartDecimator
{
public:
    explicit PartDecimator(double fs) { input.start(static_cast<int>(fs), 1); }

    void push(std::span<const float> samples)
    {
        input.push(samples);
        take();
    }

    [[nodiscard]] std::vector<float> finish()
    {
        input.finish();
        take();
        return std::move(decimated);
    }

private:
    void take()
    {
        const std::span<const float> more = input.channels().front();
        decimated.insert(decimated.end(), more.begin(), more.end());
    }

    AnalysisInput input;
    std::vector<float> decimated;
};

/// `mono` near full scale. The separation sees the whole sound: what is short shows best above the range of touch.
inline DecomposedSound decompose(std::span<const float> mono, double fs, const DecompositionParams& params)
{
    PartDecimator sound(fs), harmonic(fs), percussive(fs);
    OnsetFeatures features(fs, 1);
    OnsetDetector detector(params.onsets);
    const auto detect = [&]
    {
        detector.push(features.frames());
        features.drop(features.frames().size());
    };
    std::size_t done = 0;
    separateHarmonicPercussive(mono, fs, params.separation,
                               [&](std::span<const float> tones, std::span<const float> hits)
                               {
                                   sound.push(mono.subspan(done, tones.size()));
                                   harmonic.push(tones);
                                   percussive.push(hits);
                                   features.push(hits);
                                   detect();
                                   done += tones.size();
                               });
    features.finish();
    detect();
    std::vector<Onset> onsets = detector.finish();
    // Where a sound is cut off, its end is percussive. It is no event; nor would the rest of it have room for a pulse.
    const double last = static_cast<double>(mono.size()) / fs - 0.010;
    std::erase_if(onsets, [last](const Onset& onset) { return onset.time > last; });
    return {sound.finish(), harmonic.finish(), percussive.finish(), std::move(onsets)};
}

/// Levels of the residual in every noise band, a frame every bandStep from the start on.
inline std::vector<NoiseBand> decomposedNoise(const DecomposedSound& parts, const DecompositionParams& params)
{
    if (params.noiseBands == 0)
        return {};
    std::vector<float> modelled = parts.harmonic;
    for (std::size_t i = 0; !params.percussiveNoise && i < modelled.size(); ++i)
        modelled[i] += parts.percussive[i];
    ResidualNoiseParams noise;
    noise.layout = {params.noiseBands, params.partials.low, params.partials.high, BandSpacing::logarithmic,
                    BandLayoutKind::tiled};
    noise.frames.hop = Seconds(BandAnalysisResult::bandStep);
    const FrameGrid grid(noise.frames, analysisRate);
    return residualNoise(withCentredFrames(parts.sound, grid), withCentredFrames(modelled, grid), analysisRate, noise);
}

/// The parts as the dense tracks that ClipFitter takes, for bands and noise bands of `clip`, which it is given.
inline BandAnalysisResult decomposedTracks(Clip& clip, const DecomposedSound& parts, const DecompositionParams& params)
{
    const double low = params.partials.low.value;
    const double high = params.partials.high.value;
    BandAnalysis whole({tiledBands(1, low, high, BandSpacing::logarithmic)});
    whole.reset(1, parts.sound.size());
    whole.push(std::vector<std::span<const float>>{parts.sound});
    BandAnalysisResult found = whole.finish();

    PartialTrackingParams tracking = params.partials;
    tracking.frames.hop = Seconds(BandAnalysisResult::bandStep);
    const std::vector<BandEdges> edges =
        tiledBands(clampTo<std::size_t>(params.bands, 1, maxBands), low, high, BandSpacing::logarithmic);
    const std::size_t frames = found.tracks.front().amplitude.size();
    found.tracks = partialTracks(trackPartials(parts.harmonic, analysisRate, tracking), edges, frames);
    for (const BandEdges& edge : edges)
        clip.bands.push_back({edge.low, edge.centre, edge.high, 0, {}, {}});
    for (const NoiseBand& band : decomposedNoise(parts, params))
    {
        std::vector<float>& levels = found.noise.emplace_back();
        for (const Breakpoint& point : band.amplitude)
            levels.push_back(static_cast<float>(point.value));
        levels.resize(frames);
        // Whole numbers of Hz are short in a packed clip.
        clip.noise.push_back({std::round(band.lowFrequency), std::round(band.highFrequency), {}});
    }
    return found;
}

} // namespace detail

/// The full decomposition of M. Weber, "A Framework for Audio-Tactile Signal Translation", TU Berlin 2020, section
/// 4.2.1 (Fig. 4.2, Eq. 4.1 to 4.3), which the thesis proposes and does not build: harmonic, percussive and residual
/// part by median filtering; partials of the harmonic one with birth and death, on the carriers of as many bands;
/// events of the percussive one; levels of bands of noise for what remains, as in spectral modelling. The envelope of
/// the whole, which the sum is levelled to, is kept too. Levels and pitches cost points where these are worth their
/// price (see ClipFitter). Full drive is the largest magnitude within the range of the partials. `mono` may have any
/// length, fs is 8000 to 768000 Hz, whole; NaN and infinities count as 0.
[[nodiscard]] inline Clip decompositionClip(std::span<const float> mono, double fs,
                                            const DecompositionParams& params = {})
{
    constexpr double silence = 1e-6;
    std::vector<float> normalised(mono.begin(), mono.end());
    const double largest = normalise(normalised);
    const detail::DecomposedSound parts = detail::decompose(normalised, fs, params);
    const double breakpoints = clampTo(params.breakpoints, 0.5, 1000.0);

    Clip clip;
    clip.duration = static_cast<double>(mono.size()) / fs;
    const BandAnalysisResult found = detail::decomposedTracks(clip, parts, params);
    const double gain = found.peak > silence ? 1.0 / found.peak : 1.0;
    clip.encoder = {{"method", std::string("decomposition")},
                    {"breakpoints", breakpoints},
                    {"bands", static_cast<double>(clip.bands.size())},
                    {"noise", static_cast<double>(clip.noise.size())},
                    {"margin", params.separation.margin},
                    {"quantise", static_cast<double>(clampTo(params.quantise, 4, 16))},
                    {"gain", largest > 0.0 ? roundedToDigits(gain / largest, 3) : 1.0}};
    if (found.peak > silence)
    {
        ClipFitter(breakpoints).add(clip, found, gain, 0.0);
        clip.transients = transientsFrom(parts.onsets, gain);
    }
    // The last frame of the analysis can end after the sound.
    for (Band& band : clip.bands)
    {
        cutAfter(band.amplitude, clip.duration);
        cutAfter(band.pitch, clip.duration);
    }
    for (NoiseBand& band : clip.noise)
        cutAfter(band.amplitude, clip.duration);
    cutAfter(clip.envelope, clip.duration);
    cutAfter(clip.centroid, clip.duration);
    std::erase_if(clip.noise, [](const NoiseBand& band) { return band.amplitude.empty(); });
    rankByEnergy(clip);
    return clip;
}

} // namespace pacini
