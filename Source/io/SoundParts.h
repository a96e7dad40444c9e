#pragma once

// Consecutive sounds in a file, and errors in their headers. The data after the stated end of a sound is a chunk, a
// tag, padding, another sound, or more of it.

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace pacini
{

/// Bytes to be read in place of those that a file has at `offset`.
struct BytePatch
{
    std::uint64_t offset = 0;
    std::string bytes;
};

/// The `count` bytes of a number.
[[nodiscard]] std::string numberBytes(std::uint64_t value, std::size_t count, bool bigEndian);

/// One sound of a file as libsndfile is to see it. Offsets and sizes are bytes of the file.
struct SoundPart
{
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    std::optional<std::uint64_t> outerBegin; ///< of the file of chunks around MPEG audio
    std::vector<BytePatch> patches;
    std::string head;          ///< bytes to be read in front of `begin`
    std::uint64_t silence = 0; ///< frames of silence in front of it, by a list of waves

    std::optional<std::uint64_t> promisedBytes; ///< of audio, where a header is wrong about them
    std::uint64_t presentBytes = 0;             ///< of audio; 0 where it is not known
    std::uint64_t statedFrameBytes = 0;         ///< by a header that states them beside bits and channels; 0: none
    bool hasOtherFormat = false;                ///< a header says twice how its samples look, and differently
    double gain = 1.0;                          ///< that its samples need, see SampleReading
    std::string sampleWarning;                  ///< likewise
    std::string offsetWarning;                  ///< of an AU whose sound begins elsewhere than it states
    bool isWhole = true;                        ///< fewer than promised are there, but nothing is missing
    std::uint64_t leftOutBytes = 0;             ///< unread bytes after the sound
    std::uint64_t skippedBytes = 0;             ///< before it, that are no sound and no tag

    std::optional<std::uint64_t> promisedFrames; ///< length stated by a header, if it may be wrong
    bool isNumbered = false;                     ///< of FLAC: they are by the number of the last block
    std::optional<std::uint64_t> countedFrames;  ///< actual length
    std::uint64_t firstTime = 0;                 ///< of an Ogg stream: the earliest and latest of its pages' times, in
    std::uint64_t lastTime = 0;                  ///< frames, those of Opus at 48 kHz
    std::uint64_t leadFrames = 0;                ///< decoded before its first that are no sound of it
    std::uint64_t preSkip = 0;                   ///< of Opus: frames at 48 kHz that its header leaves out
    std::uint64_t packetFrames = 0;              ///< of an Ogg stream: frames of all packets, those of Opus at 48 kHz
    std::uint64_t lastRightTime = 0;             ///< of an Ogg stream: lastTime of the pages that are not damaged
    std::uint64_t framesLeftOut = 0;             ///< of its packets, left out at the end by its times
    int opusGain = 0;                            ///< of Opus: dB / 256 that its header adds
    std::uint64_t shiftedFrames = 0;             ///< of an Ogg stream, by which its times are too early
    std::uint64_t lostPages = 0;                 ///< of an Ogg stream, which counts them
    std::uint64_t damagedPages = 0;              ///< of an Ogg stream, with wrong checksums, which decoders leave out
    bool endsInFrame = false;                    ///< it ends within a frame of its codec
    bool isContinued = false;                    ///< more audio of the file of chunks that the part before is of
    bool isUnended = false;                      ///< of an Ogg stream: no page says that it ends
    std::uint64_t streamsBeside = 0;             ///< of an Ogg stream: sounds that run at the same time
};

/// Returns the parts of `file` for libsndfile to read, in order; at least one unless the file is empty. Moves the
/// stream's position; trusts no number.
[[nodiscard]] std::vector<SoundPart> soundParts(std::FILE* file);

/// The frames of a FLAC stream that ends at `end`, where only the number of its last block tells (see
/// numberedFlacFrames()).
[[nodiscard]] std::optional<std::uint64_t> flacFrames(std::FILE* file, std::uint64_t begin, std::uint64_t end);

/// The FLAC stream that begins between `offset` and `end`, where the decoder of another lost its way.
[[nodiscard]] std::optional<SoundPart> nextFlac(std::FILE* file, std::uint64_t offset, std::uint64_t end);

} // namespace pacini
