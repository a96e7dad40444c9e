#pragma once

// Encoding of a whole sound: samples -> finished clip.

#include <pacini/analysis/Encoder.h>
#include <pacini/clip/PackedClip.h>
#include <pacini/foundation/Result.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace pacini
{

/// Properties of a sound that are known before its samples are read; see Encoder::start().
struct SoundFormat
{
    int sampleRate = 0; ///< Hz
    int channels = 1;
    std::uint64_t expectedFrames = 0;     ///< 0: not known
    std::optional<SoundScale> scale = {}; ///< as SoundSurvey finds it
};

/// Interleaved samples, whole frames; none at the end of the sound.
using SoundPart = Result<std::span<const float>>;

/// Samples of one part, so that parts of every number of channels take about as much memory.
[[nodiscard]] constexpr std::size_t soundPartLength(std::size_t channels) noexcept
{
    return channels * std::max<std::size_t>(1, 65536 / channels);
}

/// A sound in memory, delivered in parts like a sound from a file.
class SoundParts
{
public:
    SoundParts(std::span<const float> interleaved, int channels) noexcept
        : rest(interleaved), length(soundPartLength(static_cast<std::size_t>(channels)))
    {
    }

    [[nodiscard]] SoundPart operator()()
    {
        const auto part = rest.first(std::min(length, rest.size()));
        rest = rest.subspan(part.size());
        return part;
    }

private:
    std::span<const float> rest;
    std::size_t length;
};

/// Hands visit() all parts of a sound. Errors: those of next(), tooLarge beyond 24 hours.
template <typename Next, typename Visit>
[[nodiscard]] Result<void> forEachPart(const SoundFormat& format, Next& next, Visit&& visit)
{
    const double mostSamples = limits::duration * format.sampleRate * format.channels;
    for (double samples = 0.0;;)
    {
        const SoundPart part = next();
        if (!part)
            return part.error();
        if (part->empty())
            return {};
        samples += static_cast<double>(part->size());
        if (samples > mostSamples)
            return Error{ErrorCode::tooLarge, "", "is longer than 24 hours; cut it into parts"};
        visit(*part);
    }
}

/// The clip of the sound that `next()` hands out as SoundPart by SoundPart, as precise as it was found. Errors: those
/// of forEachPart().
template <typename Next>
[[nodiscard]] Result<Clip> encodePrecisely(Encoder& encoder, const SoundFormat& format, Next&& next)
{
    encoder.start(format.sampleRate, format.channels, format.expectedFrames, format.scale);
    if (auto read = forEachPart(format, next, [&](std::span<const float> part) { encoder.push(part); }); !read)
        return read.error();
    return encoder.finish();
}

/// The same clip, rounded to the grids of `quantise` bits as in clip files.
template <typename Next>
[[nodiscard]] Result<Clip> encodeSound(Encoder& encoder, const SoundFormat& format, Next&& next)
{
    auto clip = encodePrecisely(encoder, format, std::forward<Next>(next));
    return clip ? onGrids(std::move(clip).value()) : clip;
}

} // namespace pacini
