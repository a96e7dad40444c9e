#pragma once

// The sound of a clip, ready to be played beside it.

#include "io/AudioReader.h"

#include <pacini/filters/Resampler.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace pacini
{

/// A sound at the rate of the device: one or two channels (further ones are left out).
struct PreviewSource
{
    std::vector<std::vector<float>> channels;

    /// Resamples a sound; takes about a hundredth of its duration. [worker]
    [[nodiscard]] static std::shared_ptr<const PreviewSource> of(const AudioData& audio, int sampleRate)
    {
        auto source = std::make_shared<PreviewSource>();
        const auto count = static_cast<std::size_t>(std::max(audio.channels, 1));
        const std::size_t frames = audio.samples.size() / count;
        const Resampler<float> resampler(std::max(audio.sampleRate, 1), sampleRate);
        for (std::size_t c = 0; c < std::min<std::size_t>(count, 2); ++c)
        {
            std::vector<float> channel(frames);
            for (std::size_t i = 0; i < frames; ++i)
                channel[i] = audio.samples[i * count + c];
            std::vector<float> converted(resampler.outputFrames(frames));
            resampler.process(channel, 0, 0, converted);
            source->channels.push_back(std::move(converted));
        }
        return source;
    }
};

} // namespace pacini
