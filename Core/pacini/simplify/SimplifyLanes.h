#pragma once

// Simplification of the lanes of a clip, with its error.

#include <pacini/clip/edits/Lane.h>
#include <pacini/simplify/CurveError.h>
#include <pacini/simplify/Simplify.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Result of simplifying one lane. Errors are in the lane's unit, over time.
struct SimplifiedLane
{
    Lane lane;
    std::size_t before = 0; ///< points
    std::size_t after = 0;  ///< points
    CurveError error;
};

/// A clip after simplification.
struct SimplifiedClip
{
    Clip clip;
    std::vector<SimplifiedLane> lanes;
};

/// Simplifies each of `lanes` by itself: params.count and params.maxError hold for every one (maxError in linear
/// amplitude or Hz). Lanes that the clip does not have are left out; values stay in the lane's range. Errors: those of
/// simplify().
[[nodiscard]] inline Result<SimplifiedClip> simplifyLanes(Clip clip, std::span<const Lane> lanes,
                                                          const SimplifyParams& params)
{
    SimplifiedClip result{std::move(clip), {}};
    for (const Lane& lane : lanes)
    {
        Curve* curve = curveOf(result.clip, lane);
        if (curve == nullptr)
            continue;
        const ValueRange range = laneRange(lane.kind);
        SimplifyParams own = params;
        own.lowest = std::max(own.lowest, range.low);
        auto simplified = simplify(*curve, own);
        if (!simplified)
            return simplified.error();
        for (Breakpoint& p : *simplified)
            p.value = std::clamp(p.value, range.low, range.high);
        result.lanes.push_back(
            {lane, curve->size(), simplified->size(), curveError(*curve, *simplified, ErrorMean::time)});
        *curve = std::move(simplified).value();
    }
    return result;
}

} // namespace pacini
