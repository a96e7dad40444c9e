#pragma once

// Codec of a sound inside a container, by the container's header.

#include "io/ByteWindow.h"

#include <cstdint>
#include <optional>
#include <string>

namespace pacini
{

/// Which decoder a sound needs.
enum class SoundCodec
{
    plain,  ///< libsndfile, as far as can be told
    mpeg,   ///< MPEG audio (MP3, MP2) in frames, whatever lies around it
    foreign ///< one of ffmpeg
};

/// The codec of the WAV, W64, AIFF, CAF, AU or Ogg file that begins at `begin`.
[[nodiscard]] SoundCodec soundCodecOf(ByteWindow& file, std::uint64_t begin, std::uint64_t end);

/// Whether an Ogg file lacks the page that ends one of its streams.
[[nodiscard]] bool isCutOgg(ByteWindow& file, std::uint64_t begin, std::uint64_t end);

/// What is said of an Opus whose header makes it much softer or louder, by `gain` dB / 256 (RFC 7845, 5.1).
[[nodiscard]] std::optional<std::string> opusGainWarning(int gain);

/// What is said of a sound that does not tell with how many `frames` its encoder and decoder may have begun it.
[[nodiscard]] std::string primingWarning(int frames, int sampleRate);

} // namespace pacini
