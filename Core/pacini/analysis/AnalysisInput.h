#pragma once

// Input stage of the offline analysis: interleaved samples of any rate -> one signal per channel at its rate, with
// less of speech where that is wanted.

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/VoiceGate.h>
#include <pacini/filters/RationalDecimator.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// Call start, push any number of times, then finish; channels() returns the output of the last call. Keeps its filters
/// between sounds of one rate. One thread at a time; allocates.
class AnalysisInput
{
public:
    /// Begins a sound of 1-64 channels at 8000 to 768000 Hz, of whose speech the share `speech` stays.
    void start(int sampleRate, std::size_t channelCount, double speech = 1.0)
    {
        if (decimators.empty() || decimators.front().inputRate() != sampleRate)
            decimators.assign(channelCount, RationalDecimator(sampleRate, analysisRate));
        decimators.resize(channelCount, decimators.front());
        for (RationalDecimator& decimator : decimators)
            decimator.reset();
        decimated.resize(channelCount);
        gate.reset();
        if (speech < 1.0)
        {
            gate.emplace().prepare(sampleRate, channelCount);
            gate->setParams({speech});
        }
        clear();
    }

    /// Takes whole frames and returns them with samples that can be computed with: those beyond +-1e12 are limited to
    /// it, those that are not finite count as 0, so that all squares are finite. Less of speech, if wanted. Valid until
    /// the next call, and not longer than `interleaved`.
    std::span<const float> push(std::span<const float> interleaved)
    {
        interleaved = gated(withinLimits(interleaved));
        clear();
        const std::size_t channelCount = decimators.size();
        if (channelCount == 1)
            decimators.front().push(interleaved, decimated.front());
        else
            for (std::size_t c = 0; c < channelCount; ++c)
            {
                channel.resize(interleaved.size() / channelCount);
                for (std::size_t i = 0; i < channel.size(); ++i)
                    channel[i] = interleaved[i * channelCount + c];
                decimators[c].push(channel, decimated[c]);
            }
        return interleaved;
    }

    /// Delivers the samples that the filters still hold.
    void finish()
    {
        clear();
        for (std::size_t c = 0; c < decimators.size(); ++c)
            decimators[c].finish(decimated[c]);
    }

    /// Samples at analysisRate, all channels of one length. Valid until the next call of another function.
    [[nodiscard]] std::span<const std::span<const float>> channels()
    {
        views.assign(decimated.begin(), decimated.end());
        return views;
    }

private:
    void clear()
    {
        for (std::vector<float>& samples : decimated)
            samples.clear();
    }

    [[nodiscard]] std::span<const float> withinLimits(std::span<const float> interleaved)
    {
        if (areWithinLimit(interleaved))
            return interleaved;
        limited.resize(interleaved.size());
        std::transform(interleaved.begin(), interleaved.end(), limited.begin(),
                       [](float x) { return std::isfinite(x) ? clampTo(x, -limits::sample, limits::sample) : 0.0f; });
        return limited;
    }

    [[nodiscard]] std::span<const float> gated(std::span<const float> interleaved)
    {
        if (!gate)
            return interleaved;
        limited.resize(interleaved.size());
        gate->process(interleaved, limited);
        return limited;
    }

    std::vector<RationalDecimator> decimators; // one per channel
    std::optional<VoiceGate> gate;
    std::vector<std::vector<float>> decimated;
    std::vector<std::span<const float>> views;
    std::vector<float> channel;
    std::vector<float> limited;
};

} // namespace pacini
