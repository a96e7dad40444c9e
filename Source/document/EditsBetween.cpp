#include "document/EditsBetween.h"

#include "document/EditLayer.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

namespace pacini
{

namespace
{
bool sameHead(const Clip& a, const Clip& b)
{
    if (a.duration != b.duration || a.source != b.source || a.encoder != b.encoder ||
        a.bands.size() != b.bands.size() || a.noise.size() != b.noise.size())
        return false;
    for (std::size_t k = 0; k < a.bands.size(); ++k)
        if (a.bands[k].lowFrequency != b.bands[k].lowFrequency ||
            a.bands[k].centreFrequency != b.bands[k].centreFrequency ||
            a.bands[k].highFrequency != b.bands[k].highFrequency || a.bands[k].priority != b.bands[k].priority ||
            a.bands[k].phase != b.bands[k].phase)
            return false;
    for (std::size_t k = 0; k < a.noise.size(); ++k)
        if (a.noise[k].lowFrequency != b.noise[k].lowFrequency || a.noise[k].highFrequency != b.noise[k].highFrequency)
            return false;
    return true;
}

LanePatch patchBetween(Lane lane, const Curve& before, const Curve& after)
{
    const std::size_t fewer = std::min(before.size(), after.size());
    std::size_t front = 0;
    while (front < fewer && before[front] == after[front])
        ++front;
    std::size_t back = 0;
    while (back < fewer - front && before[before.size() - 1 - back] == after[after.size() - 1 - back])
        ++back;
    LanePatch patch;
    patch.lane = lane;
    const double beginning = 0.0;
    double end = 0.0;
    for (const Curve* curve : {&before, &after})
        if (curve->size() > back)
            end = std::max(end, (*curve)[curve->size() - 1 - back].time);
    patch.range.from = front > 0 ? before[front - 1].time : beginning;
    patch.range.to = back > 0 ? before[before.size() - back].time : end;
    const auto first = std::lower_bound(after.begin(), after.end(), patch.range.from,
                                        [](const Breakpoint& p, double t) { return p.time < t; });
    const auto last =
        std::upper_bound(first, after.end(), patch.range.to, [](double t, const Breakpoint& p) { return t < p.time; });
    patch.points.assign(first, last);
    return patch;
}

/// The transients that only one of two lists has become patches: the i-th that went and the i-th that came belong
/// together when equally many did (a group was moved), else each stands alone.
std::vector<EditOperation> transientsBetween(const std::vector<Transient>& before, const std::vector<Transient>& after)
{
    const auto less = [](const Transient& a, const Transient& b)
    {
        return std::tie(a.time, a.amplitude, a.sharpness) < std::tie(b.time, b.amplitude, b.sharpness);
    };
    auto old = before;
    auto now = after;
    std::sort(old.begin(), old.end(), less);
    std::sort(now.begin(), now.end(), less);
    std::vector<Transient> gone, come;
    std::set_difference(old.begin(), old.end(), now.begin(), now.end(), std::back_inserter(gone), less);
    std::set_difference(now.begin(), now.end(), old.begin(), old.end(), std::back_inserter(come), less);
    std::vector<EditOperation> patches;
    if (gone.size() == come.size())
        for (std::size_t i = 0; i < gone.size(); ++i)
            patches.push_back(TransientPatch{gone[i], come[i]});
    else
    {
        for (const Transient& event : gone)
            patches.push_back(TransientPatch{event, std::nullopt});
        for (const Transient& event : come)
            patches.push_back(TransientPatch{std::nullopt, event});
    }
    return patches;
}
} // namespace

std::vector<EditOperation> editsBetween(const Clip& before, const Clip& after)
{
    if (!sameHead(before, after))
        return {ReplaceEdit{std::make_shared<const Clip>(after)}};
    std::vector<EditOperation> edits;
    if (before.name != after.name)
        edits.push_back(RenameEdit{after.name});
    for (const Lane& lane : lanesOf(before))
        if (const Curve& a = *curveOf(before, lane), &b = *curveOf(after, lane); a != b)
            edits.push_back(patchBetween(lane, a, b));
    if (before.transients != after.transients)
    {
        const auto patches = transientsBetween(before.transients, after.transients);
        Clip check;
        check.duration = before.duration;
        check.transients = before.transients;
        for (const EditOperation& patch : patches)
            check = withTransient(std::move(check), std::get<TransientPatch>(patch));
        // Equal times in another order: patches cannot say that.
        if (check.transients != after.transients)
            return {ReplaceEdit{std::make_shared<const Clip>(after)}};
        edits.insert(edits.end(), patches.begin(), patches.end());
    }
    if (before.markers != after.markers)
        edits.push_back(MarkersEdit{after.markers});
    return edits;
}

} // namespace pacini
