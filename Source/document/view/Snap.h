#pragma once

// Snapping of the pointer to events, markers, the playhead and grid lines.

#include "document/view/TimeAxis.h"

#include <pacini/clip/edits/RangeEdits.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace pacini
{

/// Targets that pointers snap to, while snapping is on.
struct SnapTargets
{
    bool on = true;
    bool grid = false; ///< the lines of the ruler
    bool transients = true;
    bool markers = true;
    bool playhead = true;
    bool operator==(const SnapTargets&) const = default;
};

/// The time that a pointer at `time` means: the nearest of the candidates (ascending: events, markers, the playhead)
/// and of the grid's lines that is at most `reach` pixels away, else `time` itself. Events win over lines at one
/// distance.
[[nodiscard]] inline double snapped(double time, const TimeAxis& axis, double reach, std::span<const double> candidates,
                                    const std::optional<TimeGrid>& grid = {})
{
    double best = time;
    double distance = reach * axis.secondsPerPixel;
    const auto consider = [&](double candidate)
    {
        if (std::abs(candidate - time) > distance)
            return;
        distance = std::abs(candidate - time);
        best = candidate;
    };
    if (grid)
        consider(quantised(time, {grid->step, grid->origin, 1.0}));
    const auto next = std::lower_bound(candidates.begin(), candidates.end(), time);
    if (next != candidates.end())
        consider(*next);
    if (next != candidates.begin())
        consider(*(next - 1));
    return best;
}

} // namespace pacini
