#pragma once

// Streaming writer of WAV and FLAC files that are complete or not there.

#include "io/AtomicFile.h"
#include "io/FileOrigin.h"

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// Encoding of stored samples.
enum class SampleEncoding
{
    float32, ///< as they are, beyond full scale too (WAV only)
    pcm24,
    pcm16,
};

struct AudioWriteParams
{
    int sampleRate = 48000; ///< Hz, 2000 to 768000
    int channels = 1;       ///< 1 to 64 (FLAC: to 8)
    SampleEncoding encoding = SampleEncoding::float32;

    /// PCM only: adds triangular dither of +-1 step from this seed. Decorrelates the rounding error from the signal and
    /// keeps its power constant (Lipshitz, Wannamaker and Vanderkooy, "Quantization and dither", JAES 40, 1992).
    std::optional<std::uint64_t> ditherSeed = std::nullopt;

    /// As far as known, else 0. A WAV that would pass 4 GB becomes an RF64 (EBU Tech 3306).
    std::uint64_t expectedFrames = 0;

    /// Value of expectedFrames for a recording without a known end: a WAV if it ends below 4 GB, else an RF64.
    static constexpr std::uint64_t endless = std::numeric_limits<std::uint64_t>::max();

    /// What the file is made from, for its header (see FileOrigin.h).
    std::optional<FileOrigin> origin = std::nullopt;

    /// WAV only: cues with labels, each at the nearest frame. Those behind the last frame are left out.
    std::vector<Marker> markers = {};

    /// Treatment of a file that is at the target already.
    Existing existing = Existing::replace;

    bool operator==(const AudioWriteParams&) const = default;
};

struct AudioWriteReport
{
    std::uint64_t frames = 0;
    std::uint64_t clippedSamples = 0; ///< PCM: samples beyond full scale, stored as full scale
    std::uint64_t bytes = 0;          ///< size of the file
};

/// An audio file being written; nothing is at the target before finish() has succeeded, an existing target stays until
/// then (see AtomicFile). The same samples and parameters give the same bytes: no time stamps are stored.
class AudioWriter
{
public:
    /// Starts `path`, whose extension decides: .wav or .flac. Errors: invalidArgument (other extension, a parameter out
    /// of range, float32 in FLAC), io as in AtomicFile.
    [[nodiscard]] static Result<AudioWriter> create(const std::filesystem::path& path, const AudioWriteParams& params);

    AudioWriter(AudioWriter&&) noexcept;
    AudioWriter& operator=(AudioWriter&&) = delete;
    ~AudioWriter();

    /// Appends whole frames of `interleaved` samples, full scale 1. PCM stores round(x * 2^(bits-1)), so k / 2^(bits-1)
    /// comes back exactly; exactly 1 is one step too large and stored as the largest value without counting as clipped.
    /// Errors: notFinite (frame and channel counted from 0), io (disk full ...), tooLarge (a WAV passing 4 GB). After
    /// an Error nothing more is written and finish() returns it again.
    [[nodiscard]] Result<void> write(std::span<const float> interleaved);

    /// Completes the file and puts it in place. Errors: io; then nothing was changed. Call once.
    [[nodiscard]] Result<AudioWriteReport> finish();

private:
    struct State;
    explicit AudioWriter(std::unique_ptr<State> opened) noexcept;
    std::unique_ptr<State> state;
};

/// Writes all of `interleaved` to `path`. Errors as in AudioWriter.
[[nodiscard]] Result<AudioWriteReport> writeAudio(const std::filesystem::path& path, std::span<const float> interleaved,
                                                  const AudioWriteParams& params);

} // namespace pacini
