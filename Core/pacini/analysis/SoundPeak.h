#pragma once

// Peak finder of the first pass: what has to be known of a sound before its curves can be fitted piece by piece.

#include <pacini/analysis/AnalysisInput.h>
#include <pacini/analysis/BandAnalysis.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Finds the largest magnitude of the part of a sound that is felt, exactly as the encoder finds it: start, push any
/// number of times, finish. Memory does not grow with the sound. One thread at a time; allocates.
class SoundPeak
{
public:
    /// `bands` as the encoder has them.
    explicit SoundPeak(std::vector<BandEdges> bands) : analysis(peakOf(std::move(bands))) {}

    /// Begins a sound of 1-64 channels at 8000 to 768000 Hz.
    void start(int sampleRate, int channels)
    {
        input.start(sampleRate, static_cast<std::size_t>(channels));
        analysis.reset(static_cast<std::size_t>(channels));
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

private:
    [[nodiscard]] static BandAnalysisParams peakOf(std::vector<BandEdges> bands)
    {
        BandAnalysisParams params;
        params.bands = std::move(bands);
        params.onlyPeak = true;
        return params;
    }

    AnalysisInput input;
    BandAnalysis analysis;
};

} // namespace pacini
