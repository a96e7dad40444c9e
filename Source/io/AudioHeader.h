#pragma once

// Size of the audio data that a file's header states. libsndfile silently shortens it to the real size.

#include <cstdint>
#include <cstdio>
#include <optional>

namespace pacini
{

/// The audio bytes that a header promises and the bytes that the file has in their place.
struct AudioDataSize
{
    std::uint64_t promised = 0;
    std::uint64_t present = 0;
    bool operator==(const AudioDataSize&) const = default;
};

/// Finds the audio chunk of a WAV (RIFF, RIFX, RF64), AIFF, AIFC, CAF, W64 or AU file. Nothing when the format has no
/// such promise (FLAC, Ogg, MP3), when the writer left the size open (streamed files), or when there is no such chunk.
/// Trusts no number of the file; moves the stream's position.
[[nodiscard]] std::optional<AudioDataSize> audioDataSize(std::FILE* file);

/// Whether an MP3 file starts with a header that counts its frames (Xing or Info). Without one, its length can only be
/// guessed from the bit rate. Moves the stream's position.
[[nodiscard]] bool hasMp3FrameCount(std::FILE* file);

} // namespace pacini
