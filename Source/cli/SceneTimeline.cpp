#include "cli/SceneTimeline.h"

#include <pacini/synthesis/CompilePlan.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace pacini::cli
{

SceneTimeline timelineOf(const Scene& scene)
{
    RenderPlan plan;
    auto timelines = detail::planTimelines(plan, scene);
    SceneTimeline result{plan.duration, {}};
    for (std::size_t i = 0; i < scene.plays.size(); ++i)
    {
        const ScenePlay& play = scene.plays[i];
        TimedPlay timed{i, play.start, play.start, std::numeric_limits<double>::infinity(), 0, std::move(timelines[i])};
        if (play.loop == 0.0 || play.passes > 0)
        {
            const double content =
                play.loop > 0.0 ? play.loop * static_cast<double>(play.passes) : scene.clips[play.clip].duration;
            timed.wanted = play.start + detail::playLength(play, timed.timeline, content);
        }
        timed.end = std::clamp(timed.wanted, play.start, std::max(play.start, plan.duration));
        result.plays.push_back(std::move(timed));
    }
    for (const SceneChange& change : scene.changes)
        ++result.plays[change.play].changes;
    return result;
}

} // namespace pacini::cli
