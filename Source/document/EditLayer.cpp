#include "document/EditLayer.h"

#include "document/EditLanes.h"

#include <pacini/clip/edits/TimeEdits.h>
#include <pacini/clip/edits/TransientEdits.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini
{

namespace
{
Result<Clip> withPatch(Clip clip, const LanePatch& patch)
{
    Curve* curve = curveOf(clip, patch.lane);
    if (curve == nullptr)
        return Error{ErrorCode::invalidArgument, "lane", "is not in the clip"};
    *curve = replaceSection(*curve, patch.range, patch.points);
    return clip;
}

Result<Clip> replaced(const std::shared_ptr<const Clip>& clip)
{
    if (!clip)
        return Error{ErrorCode::invalidData, "clip", "is missing"};
    return *clip;
}

struct Applier
{
    const Clip& clip;

    Result<Clip> operator()(const LanePatch& e) const { return withPatch(clip, e); }
    Result<Clip> operator()(const TransientPatch& e) const { return withTransient(clip, e); }
    Result<Clip> operator()(const MarkersEdit& e) const
    {
        Clip result = clip;
        result.markers = e.markers;
        return result;
    }
    Result<Clip> operator()(const RenameEdit& e) const
    {
        Clip result = clip;
        result.name = e.name;
        return result;
    }
    Result<Clip> operator()(const GainEdit& e) const { return amplify(clip, e.scope, e.decibels); }
    Result<Clip> operator()(const FadeEdit& e) const { return fade(clip, e.scope, e.direction, e.shape); }
    Result<Clip> operator()(const InvertEdit& e) const { return invert(clip, e.scope); }
    Result<Clip> operator()(const QuantiseEdit& e) const { return quantiseTimes(clip, e.scope, e.grid); }
    Result<Clip> operator()(const HumaniseEdit& e) const { return humanise(clip, e.scope, e.amount); }
    Result<Clip> operator()(const TransposeEdit& e) const { return transpose(clip, e.semitones); }
    Result<Clip> operator()(const TrimEdit& e) const { return trimClip(clip, e.range); }
    Result<Clip> operator()(const CutEdit& e) const { return cutClip(clip, e.range); }
    Result<Clip> operator()(const InsertEdit& e) const
    {
        return e.part ? insertClip(clip, e.time, *e.part) : Result<Clip>(clip);
    }
    Result<Clip> operator()(const RepeatEdit& e) const { return repeatClip(clip, e.passes); }
    Result<Clip> operator()(const ReverseEdit&) const { return reverseClip(clip); }
    Result<Clip> operator()(const StretchEdit& e) const { return stretchClip(clip, e.ratio); }
    Result<Clip> operator()(const ReplaceEdit& e) const { return replaced(e.clip); }
    Result<Clip> operator()(const ThinEdit& e) const { return thinTransients(clip, e.range, e.gap, e.weakest); }
};
} // namespace

double centreOf(const Clip& clip, Lane lane)
{
    if ((lane.kind == LaneKind::amplitude || lane.kind == LaneKind::pitch) && lane.index < clip.bands.size())
        return clip.bands[lane.index].centreFrequency;
    if (lane.kind == LaneKind::noise && lane.index < clip.noise.size())
        return std::sqrt(clip.noise[lane.index].lowFrequency * clip.noise[lane.index].highFrequency);
    return 0.0;
}

Clip withTransient(Clip clip, const TransientPatch& patch)
{
    const auto same =
        patch.before ? std::find(clip.transients.begin(), clip.transients.end(), *patch.before) : clip.transients.end();
    if (patch.before && same == clip.transients.end())
        return clip;
    if (same != clip.transients.end())
        clip.transients.erase(same);
    return patch.after ? addTransient(std::move(clip), *patch.after) : clip;
}

Edit anchored(EditOperation operation, const Clip& clip)
{
    Edit edit{std::move(operation), {}, clip.duration};
    std::visit(
        [&](auto& op)
        {
            if constexpr (hasScope<std::decay_t<decltype(op)>>)
                std::erase_if(op.scope.lanes, [&](const Lane& lane) { return curveOf(clip, lane) == nullptr; });
        },
        edit.operation);
    forNamedLanes(edit.operation, [&](const Lane& lane) { edit.frequencies.push_back(centreOf(clip, lane)); });
    return edit;
}

Result<Clip> applyEdit(const Clip& clip, const EditOperation& operation)
{
    auto result = std::visit(Applier{clip}, operation);
    if (!result)
        return result;
    if (auto valid = validate(*result); !valid)
        return valid.error();
    return result;
}

} // namespace pacini
