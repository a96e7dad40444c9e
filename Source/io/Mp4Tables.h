#pragma once

// Tables of the sounds of an MP4 or MOV file, which players believe without a word where they contradict each other.

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace pacini
{

/// What a header states of one track of sound.
struct Mp4Track
{
    double seconds = 0.0;            ///< of its media, by the durations of their blocks
    double played = 0.0;             ///< s of these that an edit list plays; `seconds` without one
    double blockSeconds = 0.0;       ///< s of one block of its codec
    bool isUnchecked = false;        ///< it has too many fragments to look at
    int sampleRate = 0;              ///< Hz, by the description of its codec
    int opusGain = 0;                ///< dB / 256 that the description of an Opus adds
    bool isPrimingTold = false;      ///< an edit list or iTunes says what an encoder put in front
    std::vector<std::string> doubts; ///< contradictions, each a sentence about the file
};

/// The tracks of an MP4 or MOV file in their order, those that are no sound with 0 s; in fragments by what these
/// state. None for other files. The film begins at byte `begin`, behind a tag. Moves the stream's position; trusts no
/// number. Source: ISO/IEC 14496-12.
[[nodiscard]] std::vector<Mp4Track> mp4Tracks(std::FILE* file, std::uint64_t begin = 0);

} // namespace pacini
