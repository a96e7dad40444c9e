#pragma once

// Edits of all kinds, with arguments of all kinds.

#include "support/RandomClip.h"

#include <pacini/clip/edits/Audition.h>
#include <pacini/clip/edits/Clipboard.h>
#include <pacini/clip/edits/PointEdits.h>
#include <pacini/clip/edits/RangeEdits.h>
#include <pacini/clip/edits/TimeEdits.h>
#include <pacini/clip/edits/TransientEdits.h>

#include <cmath>
#include <limits>

namespace pacini::test
{

/// A number that is mostly sensible, sometimes absurd.
inline double anyNumber(Random& random, double low, double high)
{
    switch (random.next() % 24)
    {
    case 0:
        return std::numeric_limits<double>::infinity();
    case 1:
        return -std::numeric_limits<double>::infinity();
    case 2:
        return std::nan("");
    case 3:
        return 1e300;
    case 4:
        return -1e300;
    case 5:
        return 0.0;
    default:
        return random.uniform(low, high);
    }
}

inline Indices anyIndices(Random& random, std::size_t count)
{
    Indices chosen;
    for (std::size_t i = 0; i < count + 2; ++i) // beyond the end too
        if (random.next() % 3 == 0)
            chosen.push_back(i);
    return chosen;
}

inline EditScope anyScope(Random& random, const Clip& clip)
{
    EditScope scope;
    scope.range = {anyNumber(random, -1.0, clip.duration + 1.0), anyNumber(random, -1.0, clip.duration + 1.0)};
    scope.allLanes = random.next() % 2 == 0;
    for (const Lane& lane : lanesOf(clip))
        if (random.next() % 2 == 0)
            scope.lanes.push_back(lane);
    scope.lanes.push_back({LaneKind::pitch, 1000});
    scope.transients = random.next() % 2 == 0;
    return scope;
}

/// One edit with arguments of all kinds.
inline Result<Clip> anyEdit(Random& random, const Clip& clip)
{
    const auto lanes = lanesOf(clip);
    const Lane lane = lanes[random.next() % lanes.size()];
    const CurveLimits limits = limitsOf(clip, lane);
    const Curve& curve = *curveOf(clip, lane);
    const Indices chosen = anyIndices(random, curve.size());
    const double high = isFrequency(lane.kind) ? 1000.0 : 1.5;
    const auto with = [&](Curve edited)
    {
        Clip result = clip;
        *curveOf(result, lane) = std::move(edited);
        return result;
    };
    const auto time = [&]
    {
        return anyNumber(random, -1.0, clip.duration + 1.0);
    };
    switch (random.next() % 20)
    {
    case 0:
        return with(addPoint(curve, {time(), anyNumber(random, -1.0, high)}, limits).curve);
    case 1:
        return with(deletePoints(curve, chosen));
    case 2:
        return with(
            movePoints(curve, chosen, {time() - 0.5, anyNumber(random, -1.0, 1.0), anyNumber(random, 0.0, 2.0)}, limits)
                .curve);
    case 3:
        return amplify(clip, anyScope(random, clip), anyNumber(random, -30.0, 30.0));
    case 4:
        return fade(clip, anyScope(random, clip), random.next() % 2 == 0 ? FadeDirection::in : FadeDirection::out,
                    static_cast<FadeShape>(random.next() % 3));
    case 5:
        return invert(clip, anyScope(random, clip));
    case 6:
        return transpose(clip, anyNumber(random, -24.0, 24.0));
    case 7:
        return quantiseTimes(clip, anyScope(random, clip),
                             {anyNumber(random, 0.01, 1.0), time(), anyNumber(random, 0.0, 1.0)});
    case 8:
        return humanise(
            clip, anyScope(random, clip),
            {anyNumber(random, 0.0, 0.2), anyNumber(random, 0.0, 6.0), anyNumber(random, 0.0, 2.0), random.next()});
    case 9:
        return addTransient(clip, {time(), anyNumber(random, -0.5, 2.0), anyNumber(random, -0.5, 1.5)});
    case 10:
        return deleteTransients(clip, anyIndices(random, clip.transients.size()));
    case 11:
        return thinTransients(clip, {time(), time()}, anyNumber(random, 0.0, 1.0));
    case 12:
        return trimClip(clip, {time(), time()});
    case 13:
        return cutClip(clip, {time(), time()});
    case 14:
        return insertClip(clip, time(), randomFullClip(random.next() % 50, 5));
    case 15:
        return clip.duration < 300.0 ? repeatClip(clip, static_cast<int>(random.next() % 4)) : Result<Clip>(clip);
    case 16:
        return reverseClip(clip);
    case 17:
        return stretchClip(clip, random.uniform(0.5, 2.0));
    case 18:
        return audibleClip(clip, {{random.next() % 4}, {random.next() % 4}, false, true});
    default:
        return pasteFragment(clip, copyFragment(clip, anyScope(random, clip)), time());
    }
}

} // namespace pacini::test
