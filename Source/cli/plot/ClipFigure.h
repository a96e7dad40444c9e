#pragma once

// Figure of a clip: its curves and transients over a common time axis.

#include "cli/plot/Figure.h"
#include "cli/plot/Waveform.h"

#include <pacini/clip/Clip.h>

#include <string>
#include <vector>

namespace pacini::plot
{

/// A sound or a drive signal to show above the clip's curves.
struct NamedWaveform
{
    std::string title;
    std::vector<Point> points; ///< seconds, value
};

/// One panel each for the waveforms, the total envelope, the transients, the amplitudes of the bands (lanes by centre
/// frequency) and of noise, and the pitches of the bands (as thick as they are strong) with the centroid. What the clip
/// does not have gets no panel. `title` is that of the figure; `clip` is valid.
[[nodiscard]] Figure makeClipFigure(const Clip& clip, std::string title, const std::vector<NamedWaveform>& waveforms,
                                    TimeRange range, const FigureStyle& style);

} // namespace pacini::plot
