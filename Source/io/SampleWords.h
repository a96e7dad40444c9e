#pragma once

// How samples lie in the words of an uncompressed file, where its header does not say it or says something else:
// integers at the low end of longer words, floating-point numbers that are called integers, and integers as
// floating-point numbers.

#include "io/ByteWindow.h"
#include "io/SoundParts.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

/// A stretch of a file.
struct ByteRange
{
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
};

/// How the samples of a file are to be read.
struct SampleReading
{
    std::vector<BytePatch> patches{}; ///< of the header, for libsndfile
    double gain = 1.0;                ///< a power of 2
    std::string warning{};            ///< empty: as the header has it
};

/// The reading of the WAV, W64, AIFF, CAF or AU file that begins at `begin` and whose header ends at `headerEnd`, by
/// the header and by all of `audio`. Ordinary files cost a look at their header, those of 32 bits and more one at some
/// pieces of the audio.
[[nodiscard]] SampleReading sampleReading(ByteWindow& file, std::uint64_t begin, std::uint64_t headerEnd,
                                          std::span<const ByteRange> audio);

} // namespace pacini
