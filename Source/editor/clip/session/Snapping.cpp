// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/Snapping.h"

#include "document/view/TimeTicks.h"

#include <algorithm>
#include <vector>

namespace pacini::editor
{

double snapTime(const Session& session, double time, const Snapping& snapping)
{
    const SnapTargets& targets = session.snapTargets();
    const auto shown = session.clip();
    const Clip* clip = snapping.clip != nullptr ? snapping.clip : shown.get();
    if (!targets.on || clip == nullptr)
        return time;
    std::vector<double> candidates;
    if (targets.transients)
        for (std::size_t i = 0; i < clip->transients.size(); ++i)
            if (snapping.moving == nullptr ||
                !std::binary_search(snapping.moving->transients.begin(), snapping.moving->transients.end(), i))
                candidates.push_back(clip->transients[i].time);
    if (targets.markers)
        for (std::size_t i = 0; i < clip->markers.size(); ++i)
            if (snapping.marker != i)
                candidates.push_back(clip->markers[i].time);
    if (targets.playhead && snapping.playhead)
        candidates.push_back(session.playhead());
    std::sort(candidates.begin(), candidates.end());
    std::optional<TimeGrid> lines;
    if (targets.grid)
        lines = rulerGrid(session.axis().secondsPerPixel);
    return snapped(time, session.axis(), snapReach, candidates, lines);
}

} // namespace pacini::editor
