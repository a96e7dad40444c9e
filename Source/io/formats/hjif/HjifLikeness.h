#pragma once

// Perceptual distance between a clip and its HJIF file.

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

    /// The distance of a file with these waves and events (see hjifEventsOf).
    [[nodiscard]] HjifDistance distanceTo(const Clip& file);

private:
    HtsAnalyzer analyzer;
    HtsFeatures own;
};

} // namespace pacini
