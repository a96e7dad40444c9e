#pragma once

// Perceptual distance between a clip and its HJIF file.

#include "io/formats/hjif/HjifEvents.h"

#include <pacini/clip/Clip.h>
#include <pacini/evaluate/HtsAnalyzer.h>
#include <pacini/evaluate/HtsFeatures.h>
#include <pacini/synthesis/DecoderParams.h>

#include <vector>

namespace pacini
{

/// Distance of a file from Pacini's own render of the clip.
struct HjifDistance
{
    double value = 0.0;         ///< points; 100 and more for something else altogether
    std::vector<double> events; ///< s, those that are felt in one of both only
};

/// Plays a clip as Pacini does and as a player of its HJIF file does, and compares what is felt: the envelopes, in
/// bands too, the spectrum and the events, by their shares in HTS. Unlike HTS it has no dead zone, since what is hardly
/// felt as a difference between both is one more error against the sound, and asks for events that are as near as the
/// tolerance of HTS leaves them.
class HjifLikeness
{
public:
    HjifLikeness(const Clip& clip, const DecoderParams& decoder);

    /// The distance of a file with these waves and events, which are told as `events` say.
    [[nodiscard]] HjifDistance distanceTo(const Clip& file, const std::vector<HjifEvent>& events);

    /// The part of it that lies around each event of the file, 20 ms before to 60 ms after it. Here the clip's own
    /// events are those to be felt: they know more of the sound than the render does.
    [[nodiscard]] std::vector<double> distancesAround(const Clip& file, const std::vector<HjifEvent>& events);

private:
    [[nodiscard]] HtsFeatures featuresOf(const Clip& file, const std::vector<HjifEvent>& events);

    HtsAnalyzer analyzer;
    HtsFeatures own;
};

} // namespace pacini
