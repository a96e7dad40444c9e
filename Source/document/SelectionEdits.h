#pragma once

// Edits of a selection over several lanes at once.

#include <pacini/clip/edits/Clipboard.h>
#include <pacini/clip/edits/PointEdits.h>
#include <pacini/clip/edits/RangeEdits.h>
#include <pacini/clip/edits/TransientEdits.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

[[nodiscard]] inline bool isEmpty(const Selection& selection) noexcept
{
    return selection.lanes.empty() && selection.transients.empty();
}

[[nodiscard]] inline std::size_t selectedCount(const Selection& selection) noexcept
{
    std::size_t count = selection.transients.size();
    for (const LaneSelection& lane : selection.lanes)
        count += lane.points.size();
    return count;
}

/// The selected points of a lane, or none.
[[nodiscard]] inline Indices selectedIn(const Selection& selection, Lane lane)
{
    for (const LaneSelection& part : selection.lanes)
        if (part.lane == lane)
            return part.points;
    return {};
}

/// The selection with other points of one lane.
[[nodiscard]] inline Selection withPoints(Selection selection, Lane lane, Indices points)
{
    std::erase_if(selection.lanes, [&](const LaneSelection& part) { return part.lane == lane; });
    if (!points.empty())
        selection.lanes.push_back({lane, std::move(points)});
    return selection;
}

/// What of a selection the clip has.
[[nodiscard]] inline Selection withinClip(const Selection& selection, const Clip& clip)
{
    Selection result;
    for (const LaneSelection& part : selection.lanes)
        if (const Curve* curve = curveOf(clip, part.lane))
            if (auto points = detail::existing(part.points, curve->size()); !points.empty())
                result.lanes.push_back({part.lane, std::move(points)});
    result.transients = detail::existing(selection.transients, clip.transients.size());
    return result;
}

/// The time from the first to the last thing selected; none for an empty selection.
[[nodiscard]] inline std::optional<TimeRange> timeOf(const Selection& selection, const Clip& clip)
{
    std::optional<TimeRange> range;
    const auto add = [&](double time)
    {
        range = range ? TimeRange{std::min(range->from, time), std::max(range->to, time)} : TimeRange{time, time};
    };
    for (const LaneSelection& part : withinClip(selection, clip).lanes)
        for (std::size_t i : part.points)
            add((*curveOf(clip, part.lane))[i].time);
    for (std::size_t i : selection.transients)
        if (i < clip.transients.size())
            add(clip.transients[i].time);
    return range;
}

/// Movement of a selection: one shift in time, and each kind of value in its own way.
struct SelectionMove
{
    double time = 0.0; ///< s; limited as a whole
    double amplitudeOffset = 0.0;
    double amplitudeFactor = 1.0;
    double frequencyFactor = 1.0;
    double sharpness = 0.0; ///< added
};

struct EditedClip
{
    Clip clip;
    Selection selection; ///< where what was selected is now
};

namespace detail
{
/// Puts transients in order of time; where the selected ones are now.
[[nodiscard]] inline Indices sortTransients(std::vector<Transient>& events, const Indices& selection)
{
    Indices order = allIndices(events.size());
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return events[a].time < events[b].time; });
    std::vector<Transient> sorted;
    Indices now;
    for (std::size_t i = 0; i < order.size(); ++i)
    {
        sorted.push_back(events[order[i]]);
        if (std::binary_search(selection.begin(), selection.end(), order[i]))
            now.push_back(i);
    }
    events = std::move(sorted);
    return now;
}
} // namespace detail

[[nodiscard]] inline EditedClip moveSelected(Clip clip, const Selection& wanted, const SelectionMove& move)
{
    const Selection selection = withinClip(wanted, clip);
    EditedClip result{std::move(clip), {}};
    const auto range = timeOf(selection, result.clip);
    if (!range)
        return result;
    // Limited here for all lanes together, so that they keep their places to each other.
    const double shift = clampTo(move.time, -range->from, std::max(0.0, result.clip.duration - range->to));
    for (const LaneSelection& part : selection.lanes)
    {
        const bool hertz = isFrequency(part.lane.kind);
        const PointMove pointMove{shift, hertz ? 0.0 : move.amplitudeOffset,
                                  hertz ? move.frequencyFactor : move.amplitudeFactor};
        Curve& curve = *curveOf(result.clip, part.lane);
        EditedCurve moved = movePoints(curve, part.points, pointMove, limitsOf(result.clip, part.lane));
        curve = std::move(moved.curve);
        result.selection.lanes.push_back({part.lane, std::move(moved.selection)});
    }
    if (selection.transients.empty())
        return result;
    for (std::size_t i : selection.transients)
    {
        Transient& event = result.clip.transients[i];
        event = detail::limitedTransient({event.time + shift,
                                          event.amplitude * std::max(0.0, move.amplitudeFactor) + move.amplitudeOffset,
                                          event.sharpness + move.sharpness},
                                         result.clip.duration);
    }
    result.selection.transients = detail::sortTransients(result.clip.transients, selection.transients);
    return result;
}

[[nodiscard]] inline Clip deleteSelected(Clip clip, const Selection& wanted)
{
    const Selection selection = withinClip(wanted, clip);
    for (const LaneSelection& part : selection.lanes)
    {
        Curve& curve = *curveOf(clip, part.lane);
        curve = deletePoints(curve, part.points);
    }
    return deleteTransients(std::move(clip), selection.transients);
}

/// What edits of a stretch work on: the lanes and the time of what is selected; else `range` or the whole clip, over
/// all lanes.
[[nodiscard]] inline EditScope scopeOf(const Selection& selection, const Clip& clip,
                                       const std::optional<TimeRange>& range)
{
    EditScope scope;
    scope.range = {0.0, clip.duration};
    if (const auto selected = timeOf(selection, clip))
    {
        scope.range = *selected;
        scope.allLanes = false;
        for (const LaneSelection& part : selection.lanes)
            scope.lanes.push_back(part.lane);
        scope.transients = !selection.transients.empty();
    }
    else if (range)
        scope.range = *range;
    return scope;
}

} // namespace pacini
