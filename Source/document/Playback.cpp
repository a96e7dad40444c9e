#include "document/Playback.h"

#include <pacini/clip/edits/TimeEdits.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pacini
{

namespace
{
constexpr double shortestLoop = 0.005; // s
constexpr double nearLoop = 10.0;      // s that are played unheard at once
constexpr double leadPasses = 20.0;    // s of passes behind a lead: more than enough until the loop takes over
} // namespace

double PlaybackWay::placeOf(double played) const noexcept
{
    const double length = loopTo - loopFrom;
    if (kind == Kind::once || length <= 0.0)
        return played;
    if (kind == Kind::lead)
        return played < loopTo ? played : loopFrom + std::fmod(played - loopTo, length);
    return loopFrom + std::fmod(played + length, length);
}

double PlaybackWay::startOfLoop() const noexcept
{
    return std::min(loopTo, loopFrom + nearLoop);
}

PlaybackWay wayOf(const Playback& playback, double place, double fs)
{
    PlaybackWay way;
    way.end = playback.heard()->duration;
    if (!playback.loop)
        return way;
    const TimeRange loop = withinClip(*playback.loop, way.end);
    const double from = std::round(loop.from * fs), to = std::min(std::round(loop.to * fs), std::floor(way.end * fs));
    if (to - from < shortestLoop * fs || place >= to / fs)
        return way;
    way.loopFrom = from / fs;
    way.loopTo = to / fs;
    way.kind = way.nearStartOfLoop(place) ? PlaybackWay::Kind::loop : PlaybackWay::Kind::lead;
    return way;
}

Result<Clip> playedClip(const Playback& playback, const PlaybackWay& way)
{
    Clip clip = audibleClip(*playback.heard(), playback.audition);
    if (way.kind == PlaybackWay::Kind::once)
        return clip;
    Clip once = trimClip(clip, {way.loopFrom, way.loopTo});
    if (way.kind == PlaybackWay::Kind::loop)
        return once;
    const TimeRange before{0.0, way.loopTo};
    const auto points = static_cast<double>(breakpointCount(once) + once.transients.size() + 1);
    const double most = std::max(2.0, 2e6 / points);
    auto passes = repeatClip(once, static_cast<int>(std::min(std::ceil(leadPasses / once.duration) + 1.0, most)));
    if (!passes)
        return passes.error();
    return joinClips(trimClip(std::move(clip), before), *passes);
}

} // namespace pacini
