// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/Snapping.h"

#include "document/view/TimeTicks.h"

#include <algorithm>
#include <vector>

namespace pacini::editor
{

double snapTime(const EditorModel& model, const ViewState& view, const Transport& transport, double time,
                const Snapping& snapping)
{
    const SnapTargets& targets = view.snapTargets();
    const auto shown = model.clip();
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
        candidates.push_back(transport.playhead());
    std::sort(candidates.begin(), candidates.end());
    std::optional<TimeGrid> lines;
    if (targets.grid)
        lines = rulerGrid(view.axis().secondsPerPixel);
    return snapped(time, view.axis(), snapReach, candidates, lines);
}

} // namespace pacini::editor
