#pragma once

// Largest magnitude of a whole sound in the range of its bands.

#include <pacini/analysis/AnalysisInput.h>
#include <pacini/analysis/BandAnalysis.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Finds BandAnalysisResult::peak and nothing else: start, push any number of times, finish. A clip from which speech
/// is left out is scaled by the peak of the sound with it, so that what is left is not raised in its stead.
class SoundPeak
{
public:
    explicit SoundPeak(std::vector<BandEdges> bands) : analysis(paramsOf(std::move(bands))) {}

    /// Begins a sound of 1-64 channels at 8000 to 768000 Hz.
    void start(int sampleRate, std::size_t channelCount)
    {
        input.start(sampleRate, channelCount);
        analysis.reset(channelCount);
    }

    /// Takes interleaved samples, whole frames.
    void push(std::span<const float> interleaved)
    {
        input.push(interleaved);
        analysis.push(input.channels());
    }

    [[nodiscard]] double finish()
    {
        input.finish();
        analysis.push(input.channels());
        return analysis.finish().peak;
    }

    /// Of an analysis of these bands that finds the peak alone.
    [[nodiscard]] static BandAnalysisParams paramsOf(std::vector<BandEdges> bands)
    {
        BandAnalysisParams params;
        params.bands = std::move(bands);
        params.onlyPeak = true;
        return params;
    }

private:
    AnalysisInput input;
    BandAnalysis analysis;
};

} // namespace pacini
