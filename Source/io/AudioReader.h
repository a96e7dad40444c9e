#pragma once

// Streaming reader of audio files that may be damaged or hostile.

#include "io/FoundMarkers.h"

#include <pacini/clip/Clip.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

/// Reading options: defects that are accepted instead of reported.
struct AudioReadOptions
{
    bool allowTruncated = false; ///< deliver what is there of a file that was cut off
    bool allowNan = false;       ///< replace NaN, infinite and absurd samples by 0 and count them
    bool keepNan = false;        ///< deliver such samples as they are; they are neither an error nor counted
    int lowestSampleRate = 8000; ///< Hz: limits::lowestSampleRate; slower sounds are delivered at a multiple of theirs
    double lowFrequencyGain = 1.0; ///< of the channel of low-frequency effects, where the file names its channels
    bool withoutCentre = false;    ///< deliver silence in the place of the centre channel, likewise
};

/// Gain of the channel of low-frequency effects against the others: 10 dB, as cinemas and receivers play it (ITU-R
/// BS.775, annex 7). What is to be felt of a film is in it.
inline constexpr double lowFrequencyEffectsGain = 3.1622776601683795;

/// The range of files that are read and written.
namespace limits
{
inline constexpr int channels = 64;
inline constexpr int slowestSound = 1000;        ///< Hz: what is read
inline constexpr int lowestSampleRate = 8000;    ///< Hz: what is encoded
inline constexpr int highestSampleRate = 768000; ///< Hz
inline constexpr int lowestWrittenRate = 2000;   ///< Hz: drive signals may be slower than any sound that is read
} // namespace limits

/// An open audio file: WAV, RF64, BW64, AIFF, CAF, W64, AU, FLAC, Ogg (Vorbis, Opus) and, where libsndfile was built
/// with it, MP3; and what ffmpeg decodes where it is installed (FilmSound). The content decides the format, not the
/// name. Memory does not grow with what a header claims. All of the sound is read, also where a header states less, and
/// sounds of one rate that lie one behind the other in a file.
class AudioReader
{
public:
    /// Opens `path`; what comes from a pipe or standard input (`-`) is taken in first. Errors: io (missing, folder,
    /// device, unreadable), invalidData (empty, no audio, damaged header, channels outside 1-64, rate below
    /// 1 kHz or above 768 kHz), truncated (the header promises more than is there, and not by a
    /// slip; FLAC, Ogg and MP3 show this only at their end, in read()).
    [[nodiscard]] static Result<AudioReader> open(const std::filesystem::path& path, AudioReadOptions options = {});

    AudioReader(AudioReader&&) noexcept;
    AudioReader& operator=(AudioReader&&) noexcept;
    ~AudioReader();

    [[nodiscard]] int sampleRate() const noexcept; ///< Hz
    [[nodiscard]] int channels() const noexcept;

    /// Frames in the whole file as far as the header tells; empty when it does not. An estimate: never size memory by
    /// it.
    [[nodiscard]] std::optional<std::uint64_t> frames() const noexcept;

    /// Fills `interleaved` (channels() samples per frame, full scale 1, float files may go beyond) with the next frames
    /// and returns how many frames came; fewer than fit only at the end, then 0. Precondition: room for whole frames.
    /// Errors: notFinite (also beyond limits::sample) with the first bad frame and channel, both counted from 0;
    /// truncated; invalidData (damaged); io. After an Error the content of `interleaved` is unspecified and reading on
    /// is not possible.
    [[nodiscard]] Result<std::size_t> read(std::span<float> interleaved);

    /// Hands visit(interleaved) all frames that are left, in blocks of at most `frames`, until it says false. Errors:
    /// those of read().
    template <typename Visit>
    [[nodiscard]] Result<void> forEachBlock(std::size_t frames, Visit visit)
    {
        const auto perFrame = static_cast<std::size_t>(channels());
        std::vector<float> block(frames * perFrame);
        for (;;)
        {
            const auto got = read(block);
            if (!got)
                return got.error();
            if (*got == 0 || !visit(std::span<const float>(block).first(*got * perFrame)))
                return {};
        }
    }

    /// The markers of the file, in order, with times in s of its sound (which may end before them); see soundMarkers().
    /// Those of sounds behind the first are there when these are being read.
    [[nodiscard]] const std::vector<Marker>& markers() const noexcept;

    /// Adds markers from elsewhere to those of the file.
    void addMarkers(FoundMarkers found);

    /// Those that a clip of `duration` s takes; the others are told in warnings(), once. For the end of read().
    [[nodiscard]] std::vector<Marker> takeMarkers(double duration);

    /// The factor that the channel of low-frequency effects is delivered with; 1 where the file names none.
    [[nodiscard]] double lowFrequencyGain() const noexcept;

    /// Samples that allowNan has replaced so far.
    [[nodiscard]] std::uint64_t replacedSamples() const noexcept;

    /// What was let pass of a header that is wrong, and what is missing of the sound and how many seconds of it, each a
    /// sentence about the file. Complete when read() has reached the end.
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept;

private:
    struct State;
    explicit AudioReader(std::unique_ptr<State> opened) noexcept;
    std::unique_ptr<State> state;
};

/// A whole audio file in memory.
struct AudioData
{
    int sampleRate = 0; ///< Hz
    int channels = 0;
    std::vector<float> samples; ///< interleaved
    std::uint64_t replacedSamples = 0;
    std::vector<std::string> warnings; ///< those of AudioReader
};

namespace limits
{
inline constexpr std::uint64_t audioFrames = 24ull * 3600 * 48000; ///< in memory: 24 h at 48 kHz
} // namespace limits

/// The Error (tooLarge) for a file that is longer than `maximumFrames`.
[[nodiscard]] Error tooManyFrames(std::uint64_t maximumFrames);

/// Reads a whole file. Errors as in AudioReader, and tooLarge for more than `maximumFrames`.
[[nodiscard]] Result<AudioData> readAudio(const std::filesystem::path& path, AudioReadOptions options = {},
                                          std::uint64_t maximumFrames = limits::audioFrames);

} // namespace pacini
