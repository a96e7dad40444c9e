#pragma once

// Sounds of films, and of codecs that libsndfile does not know, decoded by the programs ffprobe and ffmpeg.

#include "io/ChildProgram.h"
#include "io/FoundMarkers.h"
#include "io/SpecialChannels.h"

#include <pacini/foundation/Result.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// Whether the file from byte `begin` on is of a kind that ffmpeg reads and libsndfile does not, by its first bytes:
/// MP4, MOV, M4A and 3GP (ISO/IEC 14496-12), Matroska and WebM (RFC 9559), AVI, ASF (WMA, WMV), FLV, MPEG program and
/// transport streams, WavPack, Monkey's Audio, TTA, AMR, or AAC, AC-3 and DTS in frames. Moves the stream's position.
[[nodiscard]] bool isFilm(std::FILE* file, std::uint64_t begin);

/// An open sound of a film. Its time 0 is the time of the first picture, with the starts and edit lists of both tracks:
/// silence stands for what the sound begins later, and what it begins earlier is left out, from 0.1 s on with a
/// warning. Without a picture it is the start of the sound. Of several tracks the default one is read, with a warning.
/// Silence of more than 0.1 s stands for what is missing between the blocks of its codec.
class FilmSound
{
public:
    /// How a file is to be opened.
    struct Options
    {
        bool allowTruncated = false;
        bool toTheEnd = false;   ///< whatever size a WAV states for its sound
        std::uint64_t begin = 0; ///< byte at which the film begins, behind a tag
    };

    /// `file` is what was opened at `path`; the programs open the path themselves unless it is a pipe. Errors:
    /// invalidData (no ffmpeg installed, no sound, damaged header), truncated; io.
    [[nodiscard]] static Result<FilmSound> open(const std::filesystem::path& path, std::FILE* file,
                                                const Options& options);

    [[nodiscard]] int sampleRate() const noexcept { return rate; } ///< Hz
    [[nodiscard]] int channels() const noexcept { return width; }
    [[nodiscard]] const SpecialChannels& specialChannels() const noexcept { return special; }

    /// Frames that the file states; an estimate.
    [[nodiscard]] std::optional<std::uint64_t> frames() const noexcept { return stated; }

    /// Chapters.
    [[nodiscard]] FoundMarkers takeMarkers() noexcept { return std::move(markers); }

    /// Fills `interleaved` with the next frames; returns how many came, fewer than fit only at the end. Errors:
    /// truncated, invalidData.
    [[nodiscard]] Result<std::size_t> read(std::span<float> interleaved);

    /// Those of which the reader has not been told yet, each a sentence about the file.
    [[nodiscard]] std::vector<std::string> takeWarnings() noexcept { return std::exchange(warnings, {}); }

private:
    /// How far what a kind of file states of its duration can be relied on.
    enum class Duration
    {
        exact,    ///< to a block of the codec, whose filling is left out
        atLeast,  ///< less is missing sound
        estimated ///< only for bars of progress
    };

    struct Probe;

    FilmSound() = default;
    [[nodiscard]] Result<void> takeTrack(Probe& probe);
    [[nodiscard]] Result<void> takeTimes(Probe& probe);
    void takeChapters(const Probe& probe);
    [[nodiscard]] std::size_t readFrames(std::span<float> interleaved);
    [[nodiscard]] Result<void> explainEnd();
    [[nodiscard]] Result<void> checkCut(std::FILE* file, const std::string& kind);
    void checkTables(std::FILE* file, std::uint64_t begin, double index, const std::string& codec);
    void checkMatroska(std::FILE* file, const std::string& codec);

    int rate = 0;
    int width = 0;
    SpecialChannels special;
    std::optional<std::uint64_t> stated;
    Duration duration = Duration::estimated;
    double held = 0.0; ///< s that the tables of an MP4 promise at least
    bool hasPicture = false;
    bool statesSound = false; ///< `stated` is of the sound, not of all that the file holds
    bool statesTrack = false; ///< `stated` is counted by the header of its track, though nothing of it is refused
    bool takesTruncated = false;
    double late = 0.0; ///< s by which the sound begins after the picture
    FoundMarkers markers;
    std::string cutOff; ///< what the file as a whole lacks; empty: nothing
    std::vector<std::string> warnings;
    std::unique_ptr<ChildProgram> ffmpeg;
    std::vector<float> behind; ///< what came behind the stated end, until it is known whether it is filling
    std::size_t handedOn = 0;  ///< samples of those
    std::uint64_t delivered = 0;
    bool ended = false;
};

} // namespace pacini
