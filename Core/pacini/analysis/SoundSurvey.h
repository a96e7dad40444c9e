#pragma once

// First pass over a sound: properties of the whole sound that fitting its curves piece by piece requires.

#include <pacini/analysis/AnalysisInput.h>
#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/Encoder.h>
#include <pacini/analysis/HeardLevel.h>
#include <pacini/analysis/HeardSurvey.h>
#include <pacini/analysis/OnsetDetector.h>
#include <pacini/analysis/OnsetFeatures.h>
#include <pacini/analysis/SoundPeak.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// Finds the SoundScale of a sound, exactly as the encoder finds it: start, push any number of times, finish. Memory
/// does not grow with the sound but by its events. One thread at a time; allocates.
class SoundSurvey
{
public:
    /// `params` as the encoder has them.
    explicit SoundSurvey(const EncoderParams& params)
        : settings(params), analysis(SoundPeak::paramsOf(Encoder::bandsOf(params)))
    {
    }

    /// Begins a sound of 1-64 channels at 8000 to 768000 Hz.
    void start(int sampleRate, int channels)
    {
        const auto channelCount = static_cast<std::size_t>(channels);
        input.start(sampleRate, channelCount, settings.speech);
        analysis.reset(channelCount);
        whole.reset();
        if (settings.speech < 1.0)
            whole.emplace(Encoder::bandsOf(settings)).start(sampleRate, channelCount);
        heard.reset();
        if (settings.audible > 0.0)
            heard = std::make_unique<Heard>(sampleRate, channelCount, settings);
    }

    /// Takes interleaved samples, whole frames.
    void push(std::span<const float> interleaved)
    {
        if (whole)
            whole->push(interleaved);
        interleaved = input.push(interleaved);
        analysis.push(input.channels());
        if (!heard)
            return;
        heard->features.push(interleaved);
        heard->take();
        if (heard->level.found().size() > SoundSection::framesSeen)
            heard->level.drop(heard->survey.next(heard->level.found(), heard->detector ? heard->detector->onsetsSoFar()
                                                                                       : std::vector<Onset>()));
    }

    [[nodiscard]] SoundScale finish()
    {
        input.finish();
        analysis.push(input.channels());
        const std::int64_t values = analysis.envelopeFrames();
        const double gated = analysis.finish().peak;
        const double peak = whole ? std::max(gated, whole->finish()) : gated;
        if (!heard)
            return {peak, 0.0, 0.0};
        heard->features.finish();
        heard->take();
        heard->level.finish(values);
        return heard->survey.finish(heard->level.found(),
                                    heard->detector ? heard->detector->finish() : std::vector<Onset>(), peak);
    }

private:
    /// Analysis of the heard sound, if needed.
    struct Heard
    {
        Heard(int sampleRate, std::size_t channels, const EncoderParams& params)
            : features(sampleRate, channels), survey(params.audible, params.heard)
        {
            if (params.heard == HeardRole::instead)
                detector.emplace(params.onsets);
        }

        void take()
        {
            if (detector)
                detector->push(features.frames());
            level.push(features.frames());
            features.drop(features.frames().size());
        }

        OnsetFeatures features;
        std::optional<OnsetDetector> detector; // beside the low part no event changes the scale
        HeardLevel level;
        HeardSurvey survey;
    };

    EncoderParams settings;
    AnalysisInput input;
    BandAnalysis analysis;
    std::optional<SoundPeak> whole; // with speech, where that is left out
    std::unique_ptr<Heard> heard;
};

} // namespace pacini
