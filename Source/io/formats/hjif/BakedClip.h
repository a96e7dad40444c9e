#pragma once

// Baked clip: all results of its decoder (levelling, pitch, pulse levels) as curves.

#include <pacini/clip/Clip.h>

namespace pacini
{

/// The clip with everything that its decoder works out put into its curves: bands carry the gain that levels their sum
/// to the envelope, sampled every millisecond, and the pitch that they are played at; transients the level that their
/// pulse has beside the bands (0 for masked ones). Envelope and centroid are empty, so decoders play it as it is.
/// Pitches and their times are rounded to a format's steps in Hz and s (0: not) before the gain is worked out: it has
/// to undo the beats of the waves that are really played.
[[nodiscard]] Clip bakedClip(const Clip& clip, double pitchStep = 0.0, double timeStep = 0.0);

} // namespace pacini
