#pragma once

// Copy and paste of curves and transients, between lanes and clips.

#include <pacini/clip/edits/CurveSection.h>
#include <pacini/clip/edits/TimeEdits.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

/// Clipboard contents. Times are relative to the start of the copied range.
struct Fragment
{
    struct LanePart
    {
        Lane lane; ///< it was copied from
        Curve curve;
        bool operator==(const LanePart&) const = default;
    };
    double duration = 0.0; ///< s
    std::vector<LanePart> lanes;
    std::vector<Transient> transients;
    bool operator==(const Fragment&) const = default;
};

/// Copies the scope of a clip; empty curves and lanes that the clip does not have are left out.
[[nodiscard]] inline Fragment copyFragment(const Clip& clip, const EditScope& scope)
{
    const TimeRange range = withinClip(scope.range, clip.duration);
    Fragment fragment;
    fragment.duration = range.to - range.from;
    for (const Lane& lane : scope.allLanes ? lanesOf(clip) : scope.lanes)
        if (const Curve* curve = curveOf(clip, lane); curve != nullptr && !curve->empty())
            fragment.lanes.push_back({lane, curveSection(*curve, range)});
    if (scope.transients)
        fragment.transients = detail::eventSection(clip.transients, range, clip.duration);
    return fragment;
}

/// Pastes a copied curve into `lane` at `time` (clamped). It replaces the content over its length and is cut off at the
/// clip's end. invalidArgument: the clip has no such lane, or one of the two holds frequencies and the other
/// amplitudes.
[[nodiscard]] inline Result<Clip> pasteCurve(Clip clip, Lane lane, const Fragment::LanePart& part, double time)
{
    Curve* curve = curveOf(clip, lane);
    if (curve == nullptr)
        return Error{ErrorCode::invalidArgument, "lane", "is not in the clip"};
    if (isFrequency(lane.kind) != isFrequency(part.lane.kind))
        return Error{ErrorCode::invalidArgument, "lane",
                     "frequencies cannot replace amplitudes, nor amplitudes frequencies"};
    if (part.curve.empty())
        return clip;
    const double at = clampTo(time, 0.0, clip.duration);
    const double end = std::min(at + part.curve.back().time, clip.duration);
    Curve result;
    if (!curve->empty())
    {
        result.assign(curve->begin(), std::lower_bound(curve->begin(), curve->end(), at,
                                                       [](const Breakpoint& p, double t) { return p.time < t; }));
        if (at > 0.0)
            appendPoint(result, {at, valueBefore(*curve, at)});
    }
    Curve pasted;
    for (const Breakpoint& p : part.curve)
        pasted.push_back({at + p.time, detail::limitedTo(laneRange(lane.kind), p.value)});
    cutAfter(pasted, end);
    for (const Breakpoint& p : pasted)
        appendPoint(result, p);
    if (!curve->empty() && end < clip.duration)
    {
        appendPoint(result, {end, valueAt(*curve, end)});
        result.insert(result.end(),
                      std::upper_bound(curve->begin(), curve->end(), end,
                                       [](double t, const Breakpoint& p) { return t < p.time; }),
                      curve->end());
    }
    *curve = std::move(result);
    return clip;
}

/// Pastes everything at `time` into the lanes that it came from; lanes that this clip does not have are named in the
/// error (invalidArgument), and then nothing is pasted. Transients over the fragment's length are replaced when it
/// carries any.
[[nodiscard]] inline Result<Clip> pasteFragment(Clip clip, const Fragment& fragment, double time)
{
    const double at = clampTo(time, 0.0, clip.duration);
    for (const Fragment::LanePart& part : fragment.lanes)
    {
        auto pasted = pasteCurve(std::move(clip), part.lane, part, at);
        if (!pasted)
            return pasted;
        clip = std::move(pasted).value();
    }
    if (fragment.transients.empty())
        return clip;
    const double end = std::min(at + fragment.duration, clip.duration);
    std::erase_if(clip.transients, [&](const Transient& event) { return event.time >= at && event.time <= end; });
    for (Transient event : fragment.transients)
        if (event.time += at; event.time <= clip.duration)
            clip.transients.push_back(event);
    detail::sortByTime(clip.transients);
    return clip;
}

} // namespace pacini
