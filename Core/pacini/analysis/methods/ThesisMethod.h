#pragma once

// The thesis's translation, "thesis": six bands on fixed sinusoids, and transients.

#include <pacini/analysis/SpectralCentroid.h>
#include <pacini/analysis/TransientDetector.h>
#include <pacini/analysis/methods/MethodClip.h>
#include <pacini/analysis/methods/MethodCurves.h>
#include <pacini/analysis/methods/MethodSound.h>
#include <pacini/clip/Quantiser.h>
#include <pacini/filters/BandLayout.h>
#include <pacini/filters/FilterBank.h>
#include <pacini/foundation/Clamp.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Parameters of "thesis".
struct ThesisMethodParams
{
    BandLimitParams range;
    BandLayoutParams layout; ///< its kind is one of the three readings
    MethodCurveParams curves;
    TransientDetectorParams transients;
    int quantise = 12; ///< bits of the uniform grids, clamped to 1-31
    bool operator==(const ThesisMethodParams&) const = default;
};

namespace detail
{

/// The grids of the thesis's compressed data (Weber 2020, section 4.3.2): amplitudes 0 to 1, frequencies 0 to 2000 Hz,
/// times in milliseconds. The thesis names the bits only; the ranges hold what its analysis can find.
struct ThesisGrids
{
    UniformQuantiser amplitude;
    UniformQuantiser frequency;
    double lastTick;

    ThesisGrids(int bits, Seconds duration)
        : amplitude(bits, 0.0, 1.0), frequency(bits, 0.0, 2000.0), lastTick(std::floor(duration.value * ticksPerSecond))
    {
    }

    [[nodiscard]] double time(double seconds) const noexcept
    {
        return std::min(std::floor(seconds * ticksPerSecond + 0.5), lastTick) / ticksPerSecond;
    }

    [[nodiscard]] static double onGrid(const UniformQuantiser& grid, double value) noexcept
    {
        return grid.value(grid.code(value));
    }

    [[nodiscard]] Curve onGrid(const UniformQuantiser& grid, Curve curve) const
    {
        for (Breakpoint& point : curve)
            point = {time(point.time), onGrid(grid, point.value)};
        return curve;
    }

private:
    static constexpr double ticksPerSecond = 1000.0;
};

/// The envelopes of all bands of the causal filter bank.
[[nodiscard]] inline std::vector<Curve> bandEnvelopeTracks(const MethodSound& sound, const ThesisMethodParams& params)
{
    FilterBank bank;
    bank.setParams(params.layout);
    bank.prepare({sound.fs, MethodSound::longestPart});
    std::vector<EnvelopeTrack> tracks(bank.bands(), EnvelopeTrack(params.curves, sound.fs));
    std::vector<std::vector<float>> bands(bank.bands(), std::vector<float>(MethodSound::longestPart));
    std::vector<std::span<float>> parts(bank.bands());
    sound.forEachPart(
        [&](std::span<const float> part)
        {
            for (std::size_t k = 0; k < parts.size(); ++k)
                parts[k] = std::span(bands[k]).first(part.size());
            bank.process(part, parts);
            for (std::size_t k = 0; k < parts.size(); ++k)
                tracks[k].push(parts[k]);
        });
    std::vector<Curve> envelopes;
    for (EnvelopeTrack& track : tracks)
        envelopes.push_back(std::move(track.curve()));
    return envelopes;
}

} // namespace detail

/// The translation of M. Weber, "A Framework for Audio-Tactile Signal Translation", TU Berlin 2020, sections 4.3.1 and
/// 4.3.2, read as literally as its text allows: 5-1800 Hz, normalised; envelopes of six bands of a causal filter bank
/// and of the whole; the centroid; |fast - slow| transients; curves simplified by Visvalingam and Whyatt's method to 20
/// points per second of active time, the centroid too; everything on uniform grids. The bank is the Linkwitz-Riley
/// tree, since its parallel band-passes are not specified; envelopes go to the simplifier at 1 kHz, not at the sample
/// rate, which no 2 ms attack needs. Transients have no sharpness (0). Play it with thesisDecoderParams(). `mono` may
/// have any length, fs is 8000 to 768000 Hz.
[[nodiscard]] inline Clip thesisClip(std::span<const float> mono, double fs, const ThesisMethodParams& params = {})
{
    const MethodSound sound = prepareSound(mono, fs, params.range);
    const int bits = clampTo(params.quantise, 1, 31);
    const detail::ThesisGrids grids(bits, sound.duration);
    const auto amplitudeCurve = [&](Curve track)
    {
        for (Breakpoint& point : track)
            point.value = std::min(point.value, 1.0); // filters may overshoot
        return grids.onGrid(grids.amplitude, methodCurve(track, sound, params.curves));
    };

    Clip clip = startMethodClip("thesis", sound, params.curves);
    clip.encoder.push_back({"quantise", static_cast<double>(bits)});
    clip.envelope = amplitudeCurve(envelopeTrack(sound, params.curves));
    SpectralCentroidParams centroid;
    centroid.frames = powerOfTwoFrames(fs);
    clip.centroid =
        grids.onGrid(grids.frequency, methodCurve(spectralCentroid(sound.samples, fs, centroid), sound, params.curves));

    const BandLayout layout = designBandLayout(params.layout);
    clip.encoder.push_back({"bands", static_cast<double>(layout.bands())});
    clip.encoder.push_back({"low", roundedToDigits(layout.centres.front().value, 9)});
    clip.encoder.push_back({"high", roundedToDigits(layout.centres.back().value, 9)});
    const std::vector<Curve> envelopes = detail::bandEnvelopeTracks(sound, params);
    for (std::size_t k = 0; k < layout.bands(); ++k)
        clip.bands.push_back({layout.lowerEdge(k).value,
                              layout.centres[k].value,
                              layout.upperEdge(k).value,
                              0,
                              amplitudeCurve(envelopes[k]),
                              {}});
    rankByEnergy(clip);

    for (const DetectedTransient& event : detectTransients(sound.samples, fs, params.transients))
        clip.transients.push_back({grids.time(static_cast<double>(event.frame) / fs),
                                   detail::ThesisGrids::onGrid(grids.amplitude, event.amplitude), 0.0});
    return clip;
}

} // namespace pacini
