#pragma once

// Copy and paste between lanes, and between clips whose bands are not the same.

#include "document/EditLayer.h"
#include "document/SelectionEdits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// Content of the clipboard, with the frequency that each of its lanes had (0 for envelope and centroid).
struct Copied
{
    Fragment fragment;
    std::vector<double> frequencies;
};

struct Pasted
{
    Clip clip;
    std::optional<EditOperation> extension; ///< what was done to the clip before, where it was too short
    Selection selection;                    ///< what is new
    std::size_t leftOut = 0;                ///< lanes that found no band of their own
};

namespace detail
{
[[nodiscard]] inline double frequencyOf(const Clip& clip, Lane lane)
{
    if ((lane.kind == LaneKind::amplitude || lane.kind == LaneKind::pitch) && lane.index < clip.bands.size())
        return clip.bands[lane.index].centreFrequency;
    if (lane.kind == LaneKind::noise && lane.index < clip.noise.size())
        return std::sqrt(clip.noise[lane.index].lowFrequency * clip.noise[lane.index].highFrequency);
    return 0.0;
}

/// The distance of two frequencies, octaves.
[[nodiscard]] inline double octavesBetween(double a, double b)
{
    return std::abs(std::log2(std::max(a, 1e-3) / std::max(b, 1e-3)));
}

/// The lane of `clip` for each copied lane: bands by frequency, the nearest within an octave. Of several that want one
/// band the nearest has it.
[[nodiscard]] inline std::vector<std::optional<Lane>> placesOf(const Copied& copied, const Clip& clip)
{
    std::vector<std::optional<Lane>> places(copied.fragment.lanes.size());
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        const Lane lane = copied.fragment.lanes[i].lane;
        double nearest = 1.0;
        for (const Lane& candidate : lanesOf(clip))
            if (candidate.kind == lane.kind)
                if (const double distance = octavesBetween(frequencyOf(clip, candidate), copied.frequencies[i]);
                    distance < nearest)
                {
                    nearest = distance;
                    places[i] = candidate;
                }
        if (!places[i])
            continue;
        for (std::size_t k = 0; k < i; ++k)
            if (places[k] == places[i])
            {
                const double other = octavesBetween(frequencyOf(clip, *places[k]), copied.frequencies[k]);
                places[nearest < other ? k : i].reset();
                break;
            }
    }
    return places;
}
} // namespace detail

[[nodiscard]] inline Copied copyOf(const Clip& clip, const EditScope& scope)
{
    Copied copied{copyFragment(clip, scope), {}};
    for (const Fragment::LanePart& part : copied.fragment.lanes)
        copied.frequencies.push_back(detail::frequencyOf(clip, part.lane));
    return copied;
}

/// Silence behind the end of a clip, where what is pasted at `time` would be cut off; none where it fits.
[[nodiscard]] inline std::optional<EditOperation> extensionFor(const Clip& clip, const Copied& copied, double time)
{
    constexpr double negligible = 1e-6; // s
    const double beyond = clampTo(time, 0.0, clip.duration) + copied.fragment.duration - clip.duration;
    if (beyond <= negligible)
        return std::nullopt;
    auto silence = std::make_shared<Clip>();
    silence->duration = beyond;
    return InsertEdit{clip.duration, std::move(silence)};
}

/// Pastes at `time` into a clip that is extended as far as it takes, as pasteCurve() and pasteFragment(): what was one
/// lane goes into the lane `into` where there is one, all else into the lanes that it came from, bands by their
/// frequency. invalidArgument: `into` is not in the clip, or holds frequencies where amplitudes were copied or the
/// other way round; or no copied lane has a place.
[[nodiscard]] inline Result<Pasted> pasteInto(Clip clip, const Copied& copied, double time,
                                              const std::optional<Lane>& into)
{
    const Fragment& fragment = copied.fragment;
    auto places = detail::placesOf(copied, clip);
    if (into && fragment.lanes.size() == 1 && fragment.transients.empty())
        places.front() = *into;
    Pasted result;
    const double at = clampTo(time, 0.0, clip.duration);
    if ((result.extension = extensionFor(clip, copied, at)))
    {
        auto extended = applyEdit(clip, *result.extension);
        if (!extended)
            return extended.error();
        clip = std::move(extended).value();
    }
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        if (!places[i])
        {
            ++result.leftOut;
            continue;
        }
        auto pasted = pasteCurve(std::move(clip), *places[i], fragment.lanes[i], at);
        if (!pasted)
            return pasted.error();
        clip = std::move(pasted).value();
        const double end = at + fragment.lanes[i].curve.back().time;
        result.selection = withPoints(std::move(result.selection), *places[i],
                                      pointsInside(*curveOf(clip, *places[i]), {at, end}, {0.0, limits::frequency}));
    }
    if (result.leftOut > 0 && result.leftOut == places.size() && fragment.transients.empty())
        return Error{ErrorCode::invalidArgument, "", "this clip has no bands near the copied ones"};
    Fragment events;
    events.duration = fragment.duration;
    events.transients = fragment.transients;
    auto pasted = pasteFragment(std::move(clip), events, at);
    if (!pasted)
        return pasted.error();
    result.clip = std::move(pasted).value();
    if (!events.transients.empty())
        result.selection.transients =
            transientsInside(result.clip, {at, at + fragment.duration}, {0.0, limits::amplitude});
    return result;
}

} // namespace pacini
