#pragma once

// Pacini's own encoder on a sound in memory.

#include <pacini/analysis/Encoder.h>

#include <algorithm>
#include <cstddef>
#include <span>

namespace pacini::cli
{

/// Hands the whole frames of a sound to visit(part) in the parts that `pacini encode` reads from a file.
template <typename Visit>
void forEachReadPart(std::span<const float> interleaved, std::size_t channels, Visit&& visit)
{
    const std::size_t longest = channels * std::max<std::size_t>(1, 65536 / channels);
    for (std::size_t i = 0; i < interleaved.size(); i += longest)
        visit(interleaved.subspan(i, std::min(longest, interleaved.size() - i)));
}

/// The clip of a sound, made as `pacini encode` makes it.
[[nodiscard]] inline Clip encoded(Encoder& encoder, std::span<const float> interleaved, int sampleRate, int channels)
{
    encoder.start(sampleRate, channels);
    forEachReadPart(interleaved, static_cast<std::size_t>(channels),
                    [&encoder](std::span<const float> part) { encoder.push(part); });
    return encoder.finish();
}

} // namespace pacini::cli
