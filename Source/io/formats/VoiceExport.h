#pragma once

// A clip as the formats with one voice write it: levels and frequencies of 0 to 1, and events.

#include "io/formats/ClipFormat.h"
#include "io/formats/EmphasisFit.h"
#include "io/formats/LossList.h"
#include "io/formats/NormalisedFrequency.h"

#include <pacini/clip/Clip.h>

#include <string>
#include <vector>

namespace pacini
{

/// How a format says amplitudes.
enum class LevelScale
{
    amplitude, ///< as they are
    root       ///< as their square roots, since players square them
};

struct VoiceFormat
{
    LevelScale scale = LevelScale::amplitude;
    NormalisedRange range;         ///< without a profile
    EmphasisPlayer events;         ///< how players show events
    double amplitudePoints = 40.0; ///< per second, the density of Meta's analysis
    double frequencyPoints = 30.0; ///< per second
};

/// What is to be written. The curves have two points or more, go from 0 to the duration, and their values and those of
/// the events are 0 to 1.
struct ExportVoice
{
    std::string name;
    double duration = 0.0; ///< s, above 0
    Curve level;           ///< has a point at the time of each event
    Curve frequency;
    std::vector<Transient> events; ///< amplitude is a level
    LossList losses;
};

/// The one voice of a valid clip (see singleVoiceOf), fitted to the range of the format (see adaptClip for what a
/// profile changes; frequencies outside become its ends, amplitudes above 1 become 1) and simplified: as few points as
/// keep each level within half a step of 8 bits, at most params.amplitudePoints per second, or else the format's, whose
/// levels then fit best; and likewise for frequencies, where the loud parts count most. A clip that is one voice
/// already keeps its points unless the params ask for a density, and its events their sharpness. Those of other clips
/// mean 100 Hz (dull) to 280 Hz (crisp, see makePulse) and get the sharpness that is played at their frequency. Where
/// players play them on top of the voice, those that the voice reaches by itself are left out; where players duck the
/// voice see emphasesOf. A clip without any duration gets 10 ms.
[[nodiscard]] ExportVoice exportVoice(const Clip& clip, const ExportParams& params, const VoiceFormat& format);

} // namespace pacini
