#pragma once

// Samples of a sound in memory, as compact as they are exact.

#include "io/AudioReader.h"

#include <pacini/foundation/Result.h>
#include <pacini/foundation/SizeInMemory.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

/// A sound in memory for display and playback: ten minutes of stereo with 16 bits at 48 kHz take 115 MB, half of what
/// floats do. Each piece of it is held with 0, 16, 24 or 32 bits, the fewest that give back every sample bit by bit.
/// Copies share their samples. Reading never waits or allocates. [any]
class StoredAudio
{
public:
    StoredAudio() = default;
    /// `channels` from 1; the rate in Hz.
    StoredAudio(int rate, int channels) : sampleRate(rate), channelCount(channels) {}
    /// All samples of `audio`.
    explicit StoredAudio(const AudioData& audio);

    /// Reads a whole file, or what is there of one that was cut off, with a warning. Errors: those of readAudio().
    [[nodiscard]] static Result<StoredAudio> read(const std::filesystem::path& path);

    [[nodiscard]] int rate() const noexcept { return sampleRate; } ///< Hz
    [[nodiscard]] int channels() const noexcept { return channelCount; }
    [[nodiscard]] std::size_t frames() const noexcept
    {
        return channelCount > 0 ? sizeInMemory(total / static_cast<std::uint64_t>(channelCount)) : 0;
    }
    [[nodiscard]] double duration() const noexcept ///< s
    {
        return sampleRate > 0 ? static_cast<double>(frames()) / sampleRate : 0.0;
    }
    [[nodiscard]] std::size_t bytes() const noexcept; ///< that the samples take
    /// What was let pass when its file was read: see AudioReader::warnings().
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return doubts; }
    /// Those of the file that lie within the sound.
    [[nodiscard]] const std::vector<Marker>& markers() const noexcept { return marked; }

    /// Interleaved samples from frame `first` on, for whole frames that are there.
    void read(std::size_t first, std::span<float> interleaved) const noexcept;
    /// One channel from frame `first` on; 0 before and after the sound.
    void readChannel(std::size_t channel, std::int64_t first, std::span<float> out) const noexcept;
    /// The mean over all channels, likewise.
    void readMean(std::int64_t first, std::span<float> out) const noexcept;

private:
    static constexpr std::size_t pieceSize = std::size_t(1) << 16; ///< samples

    /// Samples with `width` bytes each, in the byte order of this machine; 0 where all are 0.
    struct Piece
    {
        std::size_t width = 0;
        std::vector<std::byte> data;

        void unpack(std::size_t first, std::span<float> samples) const noexcept;
    };

    void append(std::span<const float> interleaved);
    static Piece packed(std::span<const float> samples);
    void close();
    template <typename Reduce>
    void readMono(std::int64_t first, std::span<float> out, Reduce reduce) const noexcept;

    int sampleRate = 0;
    int channelCount = 0;
    std::uint64_t total = 0; ///< samples: those that are 0 take no memory
    std::vector<std::shared_ptr<const Piece>> pieces;
    std::vector<float> open; ///< the last piece, while it is not full
    std::vector<Marker> marked;
    std::vector<std::string> doubts;
};

} // namespace pacini
