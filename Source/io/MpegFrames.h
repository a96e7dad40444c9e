#pragma once

// Frames of MPEG audio (MP3), counted one by one, because headers often state a wrong number or none.

#include "io/ByteWindow.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace pacini
{

/// Frames of one kind without a gap, as one encoder run wrote them.
struct MpegRun
{
    std::uint64_t begin = 0;                   ///< bytes: the first frame, or that which counts the others
    std::uint64_t end = 0;                     ///< bytes: behind the last whole frame
    std::uint64_t frames = 0;                  ///< MPEG frames with sound
    std::uint64_t samples = 0;                 ///< of each channel in all of them
    int sampleRate = 0;                        ///< Hz
    std::uint64_t countField = 0;              ///< where a Xing header counts the frames; 0: nowhere
    std::optional<std::uint64_t> statedFrames; ///< content of a header
    std::uint64_t skipped = 0;                 ///< bytes before `begin` that are no frames and no tags
    std::uint64_t rest = 0;                    ///< bytes of a frame behind `end` that is cut off
};

/// Returns all runs between `begin` and `end`; none without MPEG audio. Bytes after the last run that are neither
/// frames nor tags are a run without frames.
[[nodiscard]] std::vector<MpegRun> mpegRuns(ByteWindow& file, std::uint64_t begin, std::uint64_t end);

} // namespace pacini
