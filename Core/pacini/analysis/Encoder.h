#pragma once

// Audio-to-haptic encoder: samples -> Clip by Pacini's own translation, "a2vt".

#include <pacini/analysis/AnalysisInput.h>
#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/ClipFitter.h>
#include <pacini/analysis/EncoderParams.h>
#include <pacini/analysis/EvenTrains.h>
#include <pacini/analysis/HeardBeside.h>
#include <pacini/analysis/HeardInstead.h>
#include <pacini/analysis/HeardLevel.h>
#include <pacini/analysis/HeardSurvey.h>
#include <pacini/analysis/OnsetDetector.h>
#include <pacini/analysis/OnsetFeatures.h>
#include <pacini/analysis/OnsetMeasure.h>
#include <pacini/analysis/SoundPeak.h>
#include <pacini/analysis/SoundScale.h>
#include <pacini/clip/BandPriority.h>
#include <pacini/clip/Clip.h>
#include <pacini/clip/PackedClip.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/SizeInMemory.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// Returns transients for `onsets`, scaled by `gain`, with amplitudes of 0-1. An event is felt as strong as its part in
/// the range of touch, or as half its full band if that is stronger: a bright click has no low part of its own, but
/// must be felt. If that half exceeds full drive, all bright events are scaled down alike, so that they keep their
/// ratios.
[[nodiscard]] inline std::vector<Transient> transientsFrom(std::span<const Onset> onsets, double gain)
{
    constexpr double brightShare = 0.5;
    double strongest = 1.0;
    for (const Onset& onset : onsets)
        strongest = std::max(strongest, brightShare * gain * onset.amplitude);
    std::vector<Transient> transients;
    transients.reserve(onsets.size());
    for (const Onset& onset : onsets)
    {
        const double bright = brightShare * gain * onset.amplitude / strongest;
        transients.push_back(
            {onset.time, std::clamp(std::max(gain * onset.lowAmplitude, bright), 0.0, 1.0), onset.sharpness});
    }
    return transients;
}

/// Separates the hits of even trains. Within `trains`, `envelope` (a frame every `step` s) is held down to its valley
/// between each two `onsets`, and the pulses of the events carry the rest: hits stay apart only when nothing sounds
/// between them. In uneven sequences some hits have no event of their own, and the envelope alone carries these.
inline void holdDownBetween(std::span<const Onset> onsets, std::span<const TrainSpan> trains, double step,
                            std::span<float> envelope)
{
    const auto frameOf = [&](double time)
    {
        return std::min(envelope.size(), sizeInMemory(std::ceil(time / step)));
    };
    auto train = trains.begin();
    for (std::size_t i = 0; i + 1 < onsets.size(); ++i)
    {
        while (train != trains.end() && train->last <= onsets[i].time)
            ++train;
        if (train == trains.end())
            return;
        if (onsets[i].time < train->first)
            continue;
        // The envelope's window of two steps sees an event one step early.
        const std::size_t first = frameOf(onsets[i].time - step);
        const std::size_t end = frameOf(onsets[i + 1].time - step);
        float valley = std::numeric_limits<float>::max();
        for (std::size_t f = first; f < end; ++f)
            valley = std::min(valley, envelope[f]);
        for (std::size_t f = first; f < end; ++f)
            envelope[f] = valley;
    }
}

/// Streaming encoder. Encodes one sound after another; keeps its transforms and filters between them. Use: start, push
/// any number of times, finish.
///
/// The choice of points depends on the loudest moment, which may be the last. Without a SoundScale, the analysis is
/// therefore kept to the end: 20 MB an hour for 12 bands, 35 MB with `audible`. With a scale, curves are fitted in
/// sections of ten minutes, and only the clip is kept. One thread at a time, never the audio thread.
class Encoder
{
public:
    /// `params` must be valid.
    explicit Encoder(const EncoderParams& params)
        : settings(params), analysis({bandsOf(params)}), fitter(params.breakpoints)
    {
    }

    /// The bands of clips.
    [[nodiscard]] static std::vector<BandEdges> bandsOf(const EncoderParams& params)
    {
        return tiledBands(static_cast<std::size_t>(params.bands), params.lowFrequency, params.highFrequency,
                          params.spacing);
    }

    /// Begins a sound of 1-64 channels at 8000 to 768000 Hz. Where its length is known, `expectedFrames` saves memory;
    /// where it is long, so does its `scale` as SoundSurvey finds it. The clip is the same with and without them.
    void start(int sampleRate, int channels, std::uint64_t expectedFrames = 0, std::optional<SoundScale> scale = {})
    {
        fs = sampleRate;
        channelCount = static_cast<std::size_t>(channels);
        frames = 0;
        knownScale = scale;
        sections = 0;
        input.start(fs, channelCount, settings.speech);
        const double expected = static_cast<double>(expectedFrames) / fs;
        const double longest = SoundSection::seconds + SoundSection::secondsAhead + 10.0;
        const double kept = knownScale ? std::min(expected, longest) : expected;
        analysis.reset(channelCount, static_cast<std::uint64_t>(kept * analysisRate));
        fitter.expect(expected);
        features.emplace(fs, channelCount);
        detector.emplace(settings.onsets);
        whole.reset();
        if (settings.speech < 1.0 && !knownScale)
            whole.emplace(bandsOf(settings)).start(fs, channelCount);
        heard.reset();
        if (settings.audible > 0.0)
            heard.emplace(bandsOf(settings), settings);
        clip = {};
        clip.source.sampleRate = fs;
        clip.source.channels = channels;
        for (const BandEdges& edge : bandsOf(settings))
            clip.bands.push_back({edge.low, edge.centre, edge.high, 0, {}, {}});
    }

    /// Takes interleaved samples, whole frames. Those beyond +-1e12 are limited to it, those that are not finite count
    /// as 0: the squares of all others can be computed.
    void push(std::span<const float> interleaved)
    {
        frames += interleaved.size() / channelCount;
        if (whole)
            whole->push(interleaved);
        features->push(input.push(interleaved));
        detectOnsets();
        analysis.push(input.channels());
        while (knownScale && hasSection(analysis.found()))
            addSection(analysis.found(), *knownScale, detector->onsetsSoFar());
    }

    /// Completes the clip. Packing rounds its values to the grids of `quantise` bits.
    [[nodiscard]] Clip finish()
    {
        input.finish();
        analysis.push(input.channels());
        features->finish();
        detectOnsets();
        const std::int64_t values = analysis.envelopeFrames();
        BandAnalysisResult rest = analysis.finish();
        const std::vector<Onset> onsets = detector->finish();
        if (heard)
            heard->level.finish(values);
        const SoundScale scale = knownScale ? *knownScale : scaleOf(rest, onsets);
        while (hasSection(rest))
            addSection(rest, scale, onsets);
        addRest(std::move(rest), scale, onsets);
        complete(onsets, scale.peak);
        return std::exchange(clip, {});
    }

private:
    /// Analysis of the heard sound, if needed.
    struct Heard
    {
        Heard(std::span<const BandEdges> bands, const EncoderParams& params)
            : role(params.heard), beside(bands, params.audible), instead(bands, params.audible)
        {
        }

        /// As next() of HeardBeside and HeardInstead.
        void next(BandAnalysisResult& found, std::span<const HeardFrame> values, std::size_t end,
                  std::span<const TrainSpan> trains, const SoundScale& scale)
        {
            if (role == HeardRole::beside)
                beside.next(found, values, end, scale);
            else
                instead.next(found, values, end, trains, scale);
        }

        HeardLevel level;

    private:
        HeardRole role;
        HeardBeside beside;
        HeardInstead instead;
    };

    void detectOnsets()
    {
        detector->push(features->frames());
        if (heard)
            heard->level.push(features->frames());
        features->drop(features->frames().size());
    }

    [[nodiscard]] double gainFor(double peak) const noexcept
    {
        const double loudest = settings.normalise ? 1.0 : 0.5 * limits::amplitude;
        return peak > (settings.normalise ? silence : loudest) ? loudest / peak : 1.0;
    }

    /// For a sound that is kept as a whole.
    [[nodiscard]] SoundScale scaleOf(const BandAnalysisResult& found, std::span<const Onset> onsets)
    {
        const double peak = whole ? std::max(found.peak, whole->finish()) : found.peak;
        const auto all = heard ? heard->level.found() : std::span<const HeardFrame>();
        return HeardSurvey(settings.audible, settings.heard).finish(all, onsets, peak);
    }

    /// Is all there that a section needs?
    [[nodiscard]] bool hasSection(const BandAnalysisResult& found) const noexcept
    {
        return found.seconds() > SoundSection::seconds + SoundSection::secondsAhead &&
               (!heard || heard->level.found().size() > SoundSection::framesSeen);
    }

    /// Moves the next section from the front of `found` to the clip.
    void addSection(BandAnalysisResult& found, const SoundScale& scale, std::span<const Onset> onsets)
    {
        const auto ahead = onsetsFrom(onsets, sectionStart());
        const auto trains = evenTrains(ahead, trainGapSeconds);
        if (heard)
        {
            heard->next(found, heard->level.found().first(SoundSection::framesSeen), SoundSection::frames + 1, trains,
                        scale);
            heard->level.drop(SoundSection::frames);
        }
        fit(found.takeFirst(SoundSection::seconds), scale.peak, ahead, trains);
        ++sections;
    }

    void addRest(BandAnalysisResult found, const SoundScale& scale, std::span<const Onset> onsets)
    {
        const auto ahead = onsetsFrom(onsets, sectionStart());
        const auto trains = evenTrains(ahead, trainGapSeconds);
        if (heard)
            heard->next(found, heard->level.found(), heard->level.found().size(), trains, scale);
        heard.reset(); // before curves are fitted, which takes memory too
        fit(std::move(found), scale.peak, ahead, trains);
    }

    [[nodiscard]] double sectionStart() const noexcept { return SoundSection::seconds * static_cast<double>(sections); }

    void fit(BandAnalysisResult found, double peak, std::span<const Onset> onsets, std::span<const TrainSpan> trains)
    {
        if (peak <= silence)
            return;
        holdDownBetween(onsets, trains, BandAnalysisResult::envelopeStep, found.envelope);
        fitter.add(clip, found, gainFor(peak), sectionStart());
    }

    void complete(const std::vector<Onset>& onsets, double peak)
    {
        clip.duration = static_cast<double>(frames) / fs;
        clip.encoder = encoderRecord(settings);
        clip.encoder.push_back({"gain", roundedToDigits(gainFor(peak), 3)});
        if (peak <= silence)
            return;
        clip.transients = transientsFrom(onsets, gainFor(peak));
        // The last frame of the analysis can end after the sound.
        for (Band& band : clip.bands)
        {
            cutAfter(band.amplitude, clip.duration);
            cutAfter(band.pitch, clip.duration);
        }
        cutAfter(clip.envelope, clip.duration);
        cutAfter(clip.centroid, clip.duration);
        rankByEnergy(clip);
    }

    static constexpr double silence = 1e-6; // -120 dB: dither and rounding noise

    EncoderParams settings;
    AnalysisInput input;
    BandAnalysis analysis;
    ClipFitter fitter;
    std::optional<OnsetFeatures> features;
    std::optional<OnsetDetector> detector;
    std::optional<Heard> heard;
    std::optional<SoundPeak> whole; // with speech, where that is left out
    int fs = 0;
    std::size_t channelCount = 1;
    std::uint64_t frames = 0;
    std::optional<SoundScale> knownScale;
    int sections = 0; // added to the clip
    Clip clip;
};

} // namespace pacini
