#pragma once

// Source sound of a clip at the device's rate, to be played beside the clip.

#include "io/StoredAudio.h"

#include <pacini/filters/Resampler.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace pacini
{

/// A sound at the rate of the device: one or two channels (further ones are left out). It is resampled where it is
/// read, so that it takes no memory beside the sound and is heard at once. Immutable.
class PreviewSource
{
public:
    /// Designs the filter between both rates in Hz. Null of null.
    [[nodiscard]] static std::shared_ptr<const PreviewSource> of(std::shared_ptr<const StoredAudio> audio,
                                                                 int deviceRate)
    {
        if (!audio)
            return nullptr;
        return std::make_shared<const PreviewSource>(std::move(audio), deviceRate);
    }

    PreviewSource(std::shared_ptr<const StoredAudio> audio, int deviceRate)
        : sound(std::move(audio)),
          resampler(std::max(sound->rate(), 1), deviceRate),
          count(resampler.outputFrames(sound->frames()))
    {
    }

    [[nodiscard]] std::size_t channels() const noexcept
    {
        return static_cast<std::size_t>(std::clamp(sound->channels(), 0, 2));
    }
    [[nodiscard]] std::size_t frames() const noexcept { return count; }

    /// Frames from `first` on; 0 where there are none. [audio]
    void read(std::size_t channel, std::size_t first, std::span<float> out) const noexcept
    {
        while (!out.empty())
        {
            if (first >= count)
            {
                std::fill(out.begin(), out.end(), 0.0f);
                return;
            }
            std::size_t n = std::min(out.size(), count - first);
            const std::int64_t from = resampler.firstInput(first);
            const auto inputs = [&]
            {
                return static_cast<std::size_t>(resampler.lastInput(first + n - 1) - from + 1);
            };
            while (n > 1 && inputs() > window)
                n /= 2;
            std::array<float, window> input;
            const auto needed = std::span(input).first(std::min(inputs(), window));
            sound->readChannel(channel, from, needed);
            resampler.process(needed, from, first, out.first(n));
            out = out.subspan(n);
            first += n;
        }
    }

private:
    /// Input frames that are held at a time: at least those of one output, at every pair of rates.
    static constexpr std::size_t window = 8192;
    static_assert(window > std::size_t(21) * (limits::highestSampleRate / lowestResamplerRate + 1));

    std::shared_ptr<const StoredAudio> sound;
    Resampler<float> resampler;
    std::size_t count;
};

} // namespace pacini
