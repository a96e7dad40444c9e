#pragma once

// A clip reduced to what other programs' formats are made of.

#include <pacini/actuator/Profile.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>
#include <pacini/synthesis/SingleVoice.h>

#include <optional>
#include <vector>

namespace pacini
{

/// The clip with everything that its decoder works out put into its curves: bands carry the gain that levels their sum
/// to the envelope, sampled every millisecond, and the pitch that they are played at; transients the level that their
/// pulse has beside the bands (0 for masked ones). Envelope and centroid are empty, so decoders play it as it is.
/// Pitches and their times are rounded to a format's steps in Hz and s (0: not) before the gain is worked out: it has
/// to undo the beats of the waves that are really played.
[[nodiscard]] Clip playedClip(const Clip& clip, double pitchStep = 0.0, double timeStep = 0.0);

/// The clip on one sinusoid (see singleVoiceOf) within the range of `profile`: its frequency is never empty
/// (`otherwise` Hz where the clip says nothing), events that the amplitude covers are gone.
[[nodiscard]] SingleVoice oneVoice(const Clip& clip, const std::optional<Profile>& profile = {},
                                   double otherwise = 150.0);

/// A clip of one band that says the same as `voice`.
[[nodiscard]] Clip clipOfVoice(SingleVoice voice);

/// How long event `i` lasts as a burst: `burst` s, or most of the time until the next.
[[nodiscard]] double burstLength(const std::vector<Transient>& events, std::size_t i, double burst);

/// Strength alone, for motors: the amplitude, topped by a burst of `burst` s for every event (shorter when the next is
/// near), sampled in the middle of each `step` s until the duration.
[[nodiscard]] std::vector<double> strengthOf(const SingleVoice& voice, double step, double burst);

/// `curve` with at most `pointsPerSecond`, where it has more; values keep their least squared error.
[[nodiscard]] Curve thinned(const Curve& curve, double pointsPerSecond, double duration);

/// The drive signal of the clip at `sampleRate` Hz (2000 to 768000), made for `profile` when there is one. Errors:
/// those of compilePlan().
[[nodiscard]] Result<std::vector<float>> driveSignal(const Clip& clip, double sampleRate,
                                                     const std::optional<Profile>& profile);

} // namespace pacini
