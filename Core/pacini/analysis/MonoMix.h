#pragma once

// Mono downmix: several channels -> one, for methods that need the whole sound at once.

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// The mean of the channels of a whole sound, each with the polarity that adds to the ones before it. Where the plain
/// mean loses channels in antiphase, this one keeps at least the power that the mean of unrelated channels would have:
/// every step from the sum s to s + c or s - c takes the sign for which <s, c> is not negative, so powers at least add
/// up. One polarity holds for the whole of a channel, so the mix is linear in every channel and has no seams, unlike a
/// choice made block by block; the price is that a sound whose polarity turns half way may still lose a part. In phase,
/// it is the plain mean. `interleaved` holds whole frames of `channelCount` (1 or more) finite samples; a trailing part
/// of a frame is an error (asserted). O(samples).
[[nodiscard]] inline std::vector<float> monoMix(std::span<const float> interleaved, std::size_t channelCount)
{
    assert(channelCount > 0 && interleaved.size() % channelCount == 0);
    const std::size_t frames = interleaved.size() / channelCount;
    std::vector<double> sum(frames, 0.0);
    for (std::size_t c = 0; c < channelCount; ++c)
    {
        double product = 0.0;
        for (std::size_t i = 0; i < frames; ++i)
            product += sum[i] * static_cast<double>(interleaved[i * channelCount + c]);
        const double polarity = product < 0.0 ? -1.0 : 1.0;
        for (std::size_t i = 0; i < frames; ++i)
            sum[i] += polarity * static_cast<double>(interleaved[i * channelCount + c]);
    }
    std::vector<float> mono(frames);
    std::transform(sum.begin(), sum.end(), mono.begin(),
                   [n = static_cast<double>(channelCount)](double v) { return static_cast<float>(v / n); });
    return mono;
}

} // namespace pacini
