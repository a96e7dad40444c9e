#pragma once

// Source sound of a clip at the device's rate, to be played beside the clip.

#include "io/AudioReader.h"

#include <pacini/filters/Resampler.h>

#include <algorithm>
#include <atomic>
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

    /// Resamples a sound; takes about a hundredth of its duration. Null once `stopped`. [worker]
    [[nodiscard]] static std::shared_ptr<const PreviewSource> of(const AudioData& audio, int sampleRate,
                                                                 const std::atomic<bool>* stopped = nullptr)
    {
        constexpr std::size_t pieceFrames = 1 << 16; // some milliseconds of work
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
            for (std::size_t done = 0; done < converted.size(); done += pieceFrames)
            {
                if (stopped != nullptr && *stopped)
                    return nullptr;
                resampler.process(channel, 0, done,
                                  std::span(converted).subspan(done, std::min(pieceFrames, converted.size() - done)));
            }
            source->channels.push_back(std::move(converted));
        }
        return source;
    }
};

} // namespace pacini
