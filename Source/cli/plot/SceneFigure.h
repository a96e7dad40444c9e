#pragma once

// Figure of a scene: its plays, levels and gains over a common time axis.

#include "cli/plot/Figure.h"
#include "cli/plot/Waveform.h"

#include <pacini/synthesis/Scene.h>

#include <string>

namespace pacini::plot
{

/// The plays as bars in lanes, each with the envelope of its clip at the level it plays at, in the colour of its clip;
/// the level of all of them together at each actuator; and the gains of the plays whose gain changes. `title` is that
/// of the figure; `scene` is valid.
[[nodiscard]] Figure makeSceneFigure(const Scene& scene, std::string title, TimeRange range, const FigureStyle& style);

} // namespace pacini::plot
