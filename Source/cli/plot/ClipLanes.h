#pragma once

// Chart panels of a clip's bands: amplitudes in lanes, and pitches.

#include "cli/plot/Panel.h"
#include "cli/plot/Waveform.h"

#include <pacini/clip/Clip.h>

namespace pacini::plot
{

/// Amplitude curves with their breakpoints, one lane per band, the lowest at the bottom, noise above them. A lane is as
/// high as its largest value, which stands beside it in decibels; the more it stays below that of the strongest band,
/// the paler it is.
[[nodiscard]] Panel amplitudeLanes(const Clip& clip, TimeRange range, const Look& look);

/// Pitch of each band over time on a logarithmic axis, where there is none its centre. The thickness follows the square
/// root of the amplitude, so that 40 dB below the strongest is a tenth; the colours are those of the lanes. `columns`
/// says how finely. With the clip's centroid.
[[nodiscard]] Panel pitchPanel(const Clip& clip, TimeRange range, int columns, const Look& look);

} // namespace pacini::plot
