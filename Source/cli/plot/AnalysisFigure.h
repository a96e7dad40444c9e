#pragma once

// Figure of an analysis: what the parameters of an encoding do to a sound, before breakpoints are chosen.

#include "cli/plot/Figure.h"
#include "cli/plot/Waveform.h"

#include <pacini/analysis/methods/MethodChoices.h>

#include <span>
#include <string>

namespace pacini::plot
{

/// Panels of a sound's magnitude with its envelopes, the onset score with its threshold and the events found, and the
/// spectral centroid over time, and the responses of all bands with their sum over frequency (as Weber 2020, Fig. 4.4
/// to 4.7). Score and bands are those of the method, a2vt or thesis. The score is in units of its threshold. `mono` is
/// finite, fs 8000 to 768000 Hz, whole.
[[nodiscard]] Figure makeAnalysisFigure(std::span<const float> mono, double fs, const TranslationParams& translation,
                                        std::string title, TimeRange range, const FigureStyle& style);

} // namespace pacini::plot
