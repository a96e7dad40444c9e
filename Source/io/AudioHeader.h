#pragma once

// Where a file's header says that its audio is. libsndfile silently shortens it to what the file holds and never looks
// behind it.

#include "io/ByteWindow.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace pacini
{

/// How a chunked format lays its chunks out: an id, then a size, then the content.
struct ChunkLayout
{
    std::string_view fileId;    ///< first four bytes of the file
    std::string_view dataId;    ///< first four bytes of the audio chunk's id
    std::uint64_t firstChunk;   ///< offset in bytes
    std::size_t idBytes;        ///< length of an id
    std::size_t sizeBytes;      ///< length of a size
    bool bigEndian;             ///< byte order of sizes
    bool sizeCountsHeader;      ///< a chunk's size includes its id and size
    std::uint64_t alignment;    ///< chunks start at multiples of it
    std::uint64_t headerOfData; ///< bytes of the audio chunk before the first sample

    [[nodiscard]] bool isWave() const noexcept { return fileId == "RIFF" || fileId == "RF64" || fileId == "BW64"; }
};

/// The audio of a WAV (RIFF, RIFX, RF64, BW64), AIFF, AIFC, CAF, W64 or AU file. Offsets count from the file's start.
struct AudioChunk
{
    const ChunkLayout* layout = nullptr;  ///< none for AU
    std::uint64_t sizeField = 0;          ///< where the size is
    std::uint64_t start = 0;              ///< of the first sample
    std::uint64_t sizeExtra = 0;          ///< what the size counts besides the audio
    std::optional<std::uint64_t> promise; ///< bytes of audio; empty where the writer left them open
    bool isHidden = false;                ///< libsndfile does not find it behind what comes before it
    bool bigEndian = false;               ///< byte order of the size
    std::uint64_t wrongOffset = 0;        ///< of an AIFF or AU: where an offset is that cannot be true
    std::uint64_t rightOffset = 0;        ///< what is to stand there
    std::uint64_t silence = 0;            ///< frames of silence in front of it, by a list of waves

    [[nodiscard]] std::uint64_t present(std::uint64_t end) const noexcept { return end > start ? end - start : 0; }
};

/// A chunk of a WAV, AIFF, CAF or W64 file: where its id and its content are.
struct FileChunk
{
    std::uint64_t offset = 0;
    std::uint64_t content = 0;
    std::uint64_t bytes = 0; ///< of the content, as far as they are there
};

/// Finds the audio chunk of the file that begins at `begin` and may last until `end`. Nothing when the format has none
/// (FLAC, Ogg, MP3), or when there is no such chunk. Trusts no number of the file.
[[nodiscard]] std::optional<AudioChunk> findAudioChunk(ByteWindow& file, std::uint64_t begin, std::uint64_t end);

/// The bits of a sample by the codec that the COMM of an AIFC names at `content`; nothing where its own number counts.
/// QuickTime states 16 bits beside all of these.
[[nodiscard]] std::optional<std::uint64_t> bitsOfAifcCodec(ByteWindow& file, const FileChunk& comm);

/// The bytes of one frame by the header of the file that begins at `begin`; 0 where samples are packed together or
/// nothing tells.
[[nodiscard]] std::uint64_t frameBytesOf(ByteWindow& file, std::uint64_t begin, std::uint64_t end);

/// The next audio chunk of the same file, if chunks and nothing else lie between it and `offset`: a sound may be stored
/// in several. `begin` is where the file begins.
[[nodiscard]] std::optional<AudioChunk> nextAudioChunk(ByteWindow& file, const ChunkLayout& layout, std::uint64_t begin,
                                                       std::uint64_t offset, std::uint64_t end);

/// Whether a file of a known format begins at `offset`.
[[nodiscard]] bool startsSound(ByteWindow& file, std::uint64_t offset);

/// Whether there is nothing but zeros.
[[nodiscard]] bool areZeros(ByteWindow& file, std::uint64_t offset, std::uint64_t end);

/// `end` if chunks and nothing else lie from `offset` to there, zeros behind them apart; where another sound begins
/// behind such chunks; nothing if there is something else. ID3 tags may lie among them; `tag` becomes the place of the
/// first.
[[nodiscard]] std::optional<std::uint64_t> endOfChunks(ByteWindow& file, const ChunkLayout& layout,
                                                       std::uint64_t offset, std::uint64_t end,
                                                       std::optional<std::uint64_t>* tag = nullptr);

/// The chunks of the file that begins at `begin`, before and behind its audio, which lasts until `audioEnd`. As many as
/// can be told; none for other formats.
[[nodiscard]] std::vector<FileChunk> chunksOf(ByteWindow& file, std::uint64_t begin, std::uint64_t end,
                                              std::uint64_t audioEnd);

/// Where the chunks begin that follow an audio chunk of unknown size, up to `end`; `end` where there are none.
[[nodiscard]] std::uint64_t startOfLastChunks(ByteWindow& file, const ChunkLayout& layout, std::uint64_t from,
                                              std::uint64_t end);

} // namespace pacini
