#include "document/KeepShare.h"

#include <pacini/simplify/SimplifyLanes.h>

#include <algorithm>
#include <utility>

namespace pacini
{

Result<SimplifyResult> keepShare(Clip clip, std::span<const Lane> lanes, double share)
{
    // The best method takes the square of a curve's points.
    constexpr std::size_t longCurve = 1500;
    SimplifyResult result{std::move(clip), {}};
    for (const Lane& lane : lanes)
    {
        const Curve* curve = curveOf(result.clip, lane);
        if (curve == nullptr || curve->size() < 3)
            continue;
        SimplifyParams params;
        params.method = curve->size() > longCurve ? SimplifyMethod::douglasPeucker : SimplifyMethod::lagrangian;
        params.count = std::max<std::size_t>(2, static_cast<std::size_t>(share * static_cast<double>(curve->size())));
        if (*params.count >= curve->size())
        {
            result.cost.before += curve->size();
            result.cost.after += curve->size();
            continue;
        }
        auto simplified = simplifyLanes(std::move(result.clip), std::span(&lane, 1), params);
        if (!simplified)
            return simplified.error();
        result.clip = std::move(simplified->clip);
        const SimplifiedLane& report = simplified->lanes.front();
        result.cost.before += report.before;
        result.cost.after += report.after;
        double& worst = isFrequency(lane.kind) ? result.cost.frequencyError : result.cost.amplitudeError;
        worst = std::max(worst, report.error.max);
    }
    return result;
}

} // namespace pacini
