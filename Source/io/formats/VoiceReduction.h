#pragma once

// Reduction of a clip to one voice, or to a level, for formats without bands, with the losses.

#include "io/formats/ClipFormat.h"
#include "io/formats/EmphasisFit.h"
#include "io/formats/LossList.h"
#include "io/formats/NormalisedFrequency.h"

#include <pacini/actuator/Profile.h>
#include <pacini/clip/Clip.h>
#include <pacini/synthesis/SingleVoice.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pacini
{

/// The clip on one sinusoid (see singleVoiceOf) within the range of `profile`: its frequency is never empty
/// (`otherwise` Hz where the clip says nothing), events that the amplitude covers are gone.
[[nodiscard]] SingleVoice oneVoice(const Clip& clip, const std::optional<Profile>& profile = {},
                                   double otherwise = 150.0);

/// A clip of one band that says the same as `voice`.
[[nodiscard]] Clip clipOfVoice(SingleVoice voice);

/// Returns the duration of event `i` as a burst: `burst` s, or most of the time until the next.
[[nodiscard]] double burstLength(const std::vector<Transient>& events, std::size_t i, double burst);

/// Strength alone, for motors: the amplitude, topped by a burst of `burst` s for every event (shorter when the next is
/// near), sampled in the middle of each `step` s until the duration.
[[nodiscard]] std::vector<double> strengthOf(const SingleVoice& voice, double step, double burst);

/// `curve` with at most `pointsPerSecond`, where it has more; values keep their least squared error.
[[nodiscard]] Curve thinned(const Curve& curve, double pointsPerSecond, double duration);

/// One voice, and the losses of the clip in it.
struct ReducedVoice
{
    SingleVoice voice;
    LossList losses;
};

/// As oneVoice(), with amplitudes of at most 1. Lost are frequencies of others than the strongest band, noise, parts
/// that are too weak to be there, and all texts but the clip's name.
[[nodiscard]] ReducedVoice reducedVoice(const Clip& clip, const ExportParams& params, double otherwise);

/// The same for motors, which have a strength without frequency and sharpness; events are at most 1 too.
[[nodiscard]] ReducedVoice reducedStrength(const Clip& clip, const ExportParams& params, double otherwise);

/// Scale of a format's amplitudes.
enum class LevelScale
{
    amplitude, ///< as they are
    root       ///< as their square roots, since players square them
};

struct VoiceFormat
{
    LevelScale scale = LevelScale::amplitude;
    NormalisedRange range;         ///< without a profile
    EmphasisPlayer events;         ///< how players show events, with a file that is ducked for them
    double amplitudePoints = 40.0; ///< per second, the density of Meta's analysis
    double frequencyPoints = 30.0; ///< per second
    double pointsPerEvent = 0.0;   ///< of amplitude, beside those per second
    double eventLevel = 1.0;       ///< gain of events of which each is a transient, but not below the curve there
};

/// The one voice of a clip for formats whose levels and frequencies are 0 to 1. The curves have two points or more, go
/// from 0 to the duration, and their values and those of the events are 0 to 1.
struct NormalisedVoice
{
    std::string name;
    double duration = 0.0;  ///< s, above 0
    bool wasSingle = false; ///< the clip was one voice already
    Curve level;            ///< has a point at the time of each event
    Curve frequency;
    std::vector<Transient> events; ///< amplitude is a level
    LossList losses;
};

/// The one voice of a valid clip (see singleVoiceOf), fitted to the range of the format (see adaptClip for what a
/// profile changes; frequencies outside become its ends, amplitudes above 1 become 1) and simplified: as few points as
/// keep each level within half a step of 8 bits, at most params.amplitudePoints per second, or else the format's, whose
/// levels then fit best; and likewise for frequencies, where the loud parts count most. A clip that is one voice
/// already keeps its points unless the params ask for a density, and its events their sharpness. Those of other clips
/// mean 100 Hz (dull) to 280 Hz (crisp, see makePulse) and get the sharpness that is played at their frequency. Each is
/// a transient where the voice is ducked (see emphasisOfEach), but of those that are nearer to each other than the
/// player's separation only the stronger; merged (see emphasesOf), those that the voice reaches by itself are left out.
/// A clip without any duration gets 10 ms.
[[nodiscard]] NormalisedVoice normalisedVoice(const Clip& clip, const ExportParams& params, const VoiceFormat& format);

} // namespace pacini
